/// Bodies of hexahedra from the named groups of a Gmsh file.
#pragma once

#include "mesh/blocks.hpp"
#include "tribogel/scene/scene.hpp"

#include <istream>
#include <string>
#include <vector>

namespace tribogel
{

/// A group of faces that the file must name; what else is boundary is wall.
struct SurfaceGroup {
  const char *name;
  Side side;
  int body;
};
std::vector<SurfaceGroup> surface_groups(Arrangement arrangement);

/// Bodies whose volumes the file must name, from below.
std::vector<int> bodies_of(Arrangement arrangement);

/// The volumes' names.
inline constexpr const char *body_names[2] = {"bottom", "top"};

/// A face that one cell alone has.
struct OuterFace {
  std::array<int, 4> around; ///< its vertices, counter-clockwise seen from outside
  int cell;                  ///< index into SerialMesh::cell
  Side side;
  std::string other_group; ///< a physical surface that means nothing here; empty without
  bool named;              ///< stands in one of surface_groups
};

/// Bodies with what messages about them need.
struct GmshBodies {
  SerialMesh mesh;
  std::vector<long> element; ///< number in the file of each cell
  std::vector<int> part;     ///< of each cell: the same for cells that are joined through faces
  std::vector<OuterFace> outer;
  std::vector<std::string> warnings;
};

/// Two places are one if they are nearer than this part of the edges there: files have few digits.
inline constexpr double same_place = 1e-4;

/// The key of SerialMesh::middle.
std::array<int, 8> middle_key(const std::vector<int> &vertices);

/// The volumes that the arrangement has, with its surfaces. Order 2 takes the middles of
/// edges, faces and cells from hexahedra of second order; else they are means of the corners. Ranks get
/// sectors about the z axis, the axis of the plates. Throws UserError, without the file's name, if this is
/// not what the file holds; whether the bodies are sound is for gmsh/checks.hpp to say.
GmshBodies bodies_of_gmsh(std::istream &stream, Arrangement arrangement, int order);

/// Their mesh alone.
SerialMesh mesh_of_gmsh(std::istream &stream, Arrangement arrangement, int order);

} // namespace tribogel
