/// Sizes of specimens: those that stand for a mesh file, what they leave to the approach, and which are
/// hardly what was meant.
#pragma once

#include "options/scene_input.hpp"

#include <array>

namespace tribogel
{

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

/// What stands between the plates must keep a height > 0. Throws UserError; adds a note where the specimens
/// are never pressed together.
void check_approach(SceneInput &input);

/// A warning where a size in mm looks like one in another unit.
void judge_sizes(SceneInput &input);

} // namespace tribogel
