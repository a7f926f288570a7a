/// Bodies of hexahedra from the named groups of a Gmsh file.
#pragma once

#include "mesh/blocks.hpp"

#include <istream>

namespace tribogel
{

/// A group of faces that the file must name; what else is boundary is wall.
struct SurfaceGroup {
  const char *name;
  Side side;
  int body;
};
std::vector<SurfaceGroup> surface_groups(bool has_top);

/// The key of SerialMesh::middle.
std::array<int, 8> middle_key(const std::vector<int> &vertices);

/// The volumes `top` and `bottom`, or `bottom` alone, with these surfaces. Order 2 takes the middles of edges, faces
/// and cells from hexahedra of second order; else they are means of the corners. Ranks get sectors about the z axis,
/// the axis of the plates. Throws UserError, without the file's name, if this is not what the file holds.
SerialMesh mesh_of_gmsh(std::istream &stream, bool has_top, int order);

} // namespace tribogel
