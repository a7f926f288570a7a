/// One gel between two plates, without contact: scenes and meshes for the tests of the bulk.
#pragma once

#include "scenes.hpp"
#include "solver_options.hpp"

#include <cmath>

namespace tribogel::test
{

/// Incompressible as bulk_over_shear grows; [MPa].
inline Viscoelastic<double> neo_hookean(double G, double bulk_over_shear)
{
  return {{{G}, {2}, bulk_over_shear * G}, {}};
}

/// A gel that spans both plates, on a uniform mesh: the edges halve in both directions when `elements`
/// doubles if height/2 is a multiple of radius/elements.
inline Scene cylinder(double radius, double height, const Viscoelastic<double> &material, int order,
                      int elements)
{
  Scene scene;
  scene.arrangement = Arrangement::single_gel;
  scene.plate_contact = false; // of the bulk alone
  scene.bottom = {radius, height, material};
  scene.mesh.element_order = order;
  scene.mesh.elements_radial = elements;
  scene.mesh.grading = 1;
  return scene;
}

/// Moves the inner vertices of a mesh with this edge by `fraction` of it, up or down, left or right or not at
/// all: cells are as skewed on a fine mesh as on a coarse one. Edges stay straight.
inline void distort(Mesh &mesh, double radius, double height, double edge, double fraction)
{
  for (Node &node : mesh.nodes) {
    const double R = node.X[0], Z = node.X[1];
    if (R < 1e-9 * radius || R > (1 - 1e-9) * radius || Z < (-1 + 1e-9) * height || Z > -1e-9 * height)
      continue;
    const long i = std::lround(R / edge), j = std::lround((Z + height) / edge);
    node.X = {R + fraction * edge * static_cast<double>((i + j) % 3 - 1),
              Z + fraction * edge * static_cast<double>((i + 2 * j) % 3 - 1)};
  }
  if (mesh.order == 1) return;
  constexpr int between[5][3] = {{1, 0, 2}, {3, 0, 6}, {5, 2, 8}, {7, 6, 8}, {4, 0, 8}};
  for (const MeshCell &cell : mesh.cells)
    for (const auto &[middle, a, b] : between) {
      const bool centre = middle == 4;
      for (int j = 0; j < 2; ++j) {
        const auto X = [&](int slot) { return mesh.nodes[cell.node[slot]].X[j]; };
        mesh.nodes[cell.node[middle]].X[j] =
            centre ? 0.25 * (X(0) + X(2) + X(6) + X(8)) : 0.5 * (X(a) + X(b));
      }
    }
}

} // namespace tribogel::test
