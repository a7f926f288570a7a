/// Integrals over faces of hexahedra.
#pragma once

#include "mesh/mesh.hpp"
#include "tribogel/friction/torque.hpp"

#include <array>
#include <vector>

namespace tribogel
{

/// A point of a surface and the area that it stands for in a sum that is an integral.
struct FaceSample {
  std::array<double, 3> X; ///< [mm]
  double area;             ///< [mm^2]
};

/// Adds the Gauss points of a facet of nine nodes, lexicographic.
void add_samples(const std::array<std::array<double, 3>, 9> &nodes, std::vector<FaceSample> &samples);

/// A contact face in space, about the axis x = y = 0 of its plate.
ContactFace contact_face(const Mesh &mesh, const Surface &surface);

} // namespace tribogel
