/// Option texts -> Scene, with all checks. Pure: no PETSc, no MPI, no files; what PETSc read is handed in as
/// text.
#pragma once

#include "support/user_error.hpp"
#include "tribogel/scene/scene.hpp"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tribogel
{

/// What the user gave: option name with its dash -> text, empty where the value is missing.
using GivenOptions = std::map<std::string, std::string>;

struct SceneInput {
  Scene scene;
  std::string mesh_file; ///< -mesh_file; empty: the cylinders of the scene
  std::vector<std::pair<std::string, std::string>>
      options;                       ///< every option as resolved: name without the dash, text
  GivenOptions given;                ///< as they came in
  std::vector<std::string> warnings; ///< runs, but is hardly what was meant
  std::vector<std::string> notes;    ///< worth knowing, e.g. an option without effect here
};

/// Throws UserError at the first option that is wrong.
SceneInput scene_from_options(const GivenOptions &given);

/// What stands for the sizes of specimens that a file describes; [0] is the bottom one. Lengths in mm.
struct SpecimenSizes {
  std::array<double, 2>
      radius{}; ///< of the circle with the area of the contact face, or of the top plate's face
  std::array<double, 2> height{}; ///< from the plate to z = 0, and from the gap's end to the plate
  double gap = 0;                 ///< from z = 0 to the lowest point of the top gel
  double unevenness = 0;          ///< by how much the two contact faces together are not plane
  std::array<std::array<double, 2>, 2> centroid{}; ///< x, y of those faces
  std::array<bool, 2> around_axis{true, true};     ///< whether x = y = 0 lies in their convex hull
};

/// Puts these sizes into the scene and its resolved options, and judges the approach by them. Throws
/// UserError.
void take_sizes(SceneInput &input, const SpecimenSizes &sizes);

/// Elements that a uniform mesh of this scene has at -elements_radial [1]. Grading does not reduce it below.
double estimated_elements(const Scene &scene);

/// More elements than this are refused: matrix positions are 32-bit numbers, and a row of hexahedra of order
/// 2 has about 200 entries.
inline double most_elements(const Scene &scene)
{
  return scene.model == Model::solid && scene.mesh.element_order == 2 ? 4e5 : 2e6;
}

} // namespace tribogel
