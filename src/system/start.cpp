/// What can be known of a scene before anything deforms.
#include "system/system.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace tribogel
{

namespace
{

constexpr double worth_saying = 0.01; ///< of the top gel's face, beyond the bottom gel's edge
constexpr int scanned = 24;           ///< angles that are tried

} // namespace

PetscErrorCode System::JudgeStart(PlateFrames standing, std::string &objection,
                                  std::vector<std::string> &doubts)
{
  double lowest = 0, highest = 0, share = 0;
  PetscFunctionBeginUser;
  if (!contact || !contact->between_gels() || mesh.dim == 2) PetscFunctionReturn(0);
  PetscCall(contact->AtRest(standing, share, objection));
  if (objection.empty() && share > worth_saying) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.1g", 100 * share);
    doubts.push_back(std::string("the top gel hangs over the edge of the bottom gel with about ") + percent +
                     " % of its face, which presses on the bottom gel's extension");
  }
  if (!objection.empty() || scene.round) PetscFunctionReturn(0);
  for (const Phase &phase : scene.schedule) {
    lowest = std::min({lowest, phase.start_rotation, phase.end_rotation()});
    highest = std::max({highest, phase.start_rotation, phase.end_rotation()});
  }
  highest = std::min(highest, lowest + 2 * std::numbers::pi);
  for (int k = 0; k <= scanned && highest > lowest; ++k) {
    std::string fault;
    standing.top_rotation = lowest + (highest - lowest) * k / scanned;
    PetscCall(contact->AtRest(standing, share, fault));
    if (fault.empty()) continue;
    char angle[32];
    std::snprintf(angle, sizeof angle, "%.3g", standing.top_rotation);
    doubts.push_back(std::string("when the top plate has turned by ") + angle + " rad, " + fault +
                     " (undeformed); the run is likely to end before");
    break;
  }
  PetscFunctionReturn(0);
}

} // namespace tribogel
