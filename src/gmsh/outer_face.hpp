/// What the checks of a file's bodies know of one outer face. Its edges are straight.
#pragma once

#include "gmsh/bodies.hpp"
#include "gmsh/hexahedron.hpp"

#include <string>

namespace tribogel
{

Place plus(const Place &a, double by, const Place &b);
double length(const Place &a);

/// The normal of a flat quadrilateral, outwards, as long as its area [mm^2]: half the product of the
/// diagonals.
Place area_vector(const SerialMesh &mesh, const OuterFace &face);

/// On the face between its corners, xi and eta from 0 to 1.
Place on_face(const SerialMesh &mesh, const OuterFace &face, double xi, double eta);

/// "that of element 7 at (1, 2, 3)".
std::string example(const GmshBodies &bodies, const OuterFace &face);

} // namespace tribogel
