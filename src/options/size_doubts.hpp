/// Sizes and places of specimens that are hardly what was meant.
#pragma once

#include "options/scene_input.hpp"

namespace tribogel
{

/// A warning where a size in mm looks like one in another unit.
void judge_sizes(SceneInput &input);

/// What is odd about the contact faces of a mesh file: warnings and notes. Faces that touch in part only are
/// marked in the scene.
void judge_faces(SceneInput &input, const SpecimenSizes &sizes);

} // namespace tribogel
