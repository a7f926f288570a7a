/// Solids for tests, and meshes whose inner nodes are moved.
#pragma once

#include "boxes.hpp"
#include "bulk_scenes.hpp"

#include "tribogel/element/cell.hpp"
#include "tribogel/kinematics/solid.hpp"

#include <array>
#include <cmath>
#include <random>

namespace tribogel::test
{

/// A single gel as a solid.
inline Scene solid_cylinder(double radius, double height, const Viscoelastic<double> &material, int order,
                            int elements)
{
  Scene scene = cylinder(radius, height, material, order, elements);
  scene.model = Model::solid;
  return scene;
}

/// Moves every node for which `inner` holds by up to `distance` in each direction, midside nodes too: edges
/// and faces are curved.
template <class Inner> void jostle(Mesh &mesh, double distance, const Inner &inner)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> in(-distance, distance);
  for (Node &node : mesh.nodes) {
    if (!inner(node.X)) continue;
    for (double &x : node.X) x += in(random);
  }
}

} // namespace tribogel::test
