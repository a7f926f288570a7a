/// How large a mesh the options of the discretisation ask for.
#pragma once

#include "tribogel/scene/scene.hpp"

namespace tribogel
{

/// Elements that a uniform mesh of this scene has at -elements_radial [1]. Grading does not reduce it below.
double estimated_elements(const Scene &scene);

/// More elements than this are refused: matrix positions are 32-bit numbers, and a row of hexahedra of order
/// 2 has about 200 entries.
inline double most_elements(const Scene &scene)
{
  return scene.model == Model::solid && scene.mesh.element_order == 2 ? 4e5 : 2e6;
}

} // namespace tribogel
