/// The rows of the residual by kind, and how large each may be.
#pragma once

#include "support/petsc_handles.hpp"

#include <array>
#include <vector>

namespace tribogel
{

/// Residuals are judged by group: three displacement and three traction components, each against the sum of
/// the absolute forces that meet in it.
inline constexpr int residual_groups = 6;
using GroupNames = std::array<const char *, residual_groups>;
inline constexpr GroupNames group_names_of[2] = {
    {"radial force", "circumferential force", "axial force", "radial contact condition",
     "circumferential contact condition", "axial contact condition"},
    {"force along x", "force along y", "force along z", "contact condition along x",
     "contact condition along y", "contact condition along z"}};
constexpr const GroupNames &group_names(int dim)
{
  return group_names_of[dim - 2];
}

struct ResidualRows {
  std::vector<char> group;        ///< of each owned unknown
  std::vector<int> node;          ///< index into Mesh::nodes of each owned unknown
  VecHandle magnitude, round_off; ///< global: sum of absolute forces in the last evaluation; floor of their
                                  ///< round-off
};

/// Where Newton stopped: the largest residual relative to its tolerance.
struct WorstResidual {
  double ratio = 0; ///< group norm over its tolerance
  int group = -1;
  std::array<double, 3> X{}; ///< of the node of the group's largest entry [mm]
  int body = 0;
};

} // namespace tribogel
