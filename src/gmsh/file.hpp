/// What is in a Gmsh file: nodes, elements and the names of their groups, before they mean anything. ASCII,
/// formats 2.2 and 4.1.
///
/// PETSc's own reader (DMPlexCreateGmsh) is not used: it takes the names of groups only if an option in its
/// database says so, names neither file nor line when it cannot read one, and trusts the numbers in it.
#pragma once

#include <array>
#include <istream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tribogel
{

/// A quadrilateral of 4, 8 or 9 nodes or a hexahedron of 8, 20 or 27.
struct GmshElement {
  long tag;
  int dim;                         ///< 2 or 3
  std::vector<long> nodes;         ///< tags, in Gmsh's order: corners, edges, faces, middle
  std::vector<std::string> groups; ///< names of its physical groups; empty if it has none with a name
};

/// A physical group that the file names or that its elements are in.
struct GmshGroup {
  std::string name; ///< empty: it has a number only
  long elements = 0;
};

struct GmshFile {
  std::map<long, std::array<double, 3>> nodes;      ///< positions by tag
  std::vector<GmshElement> elements;                ///< without points and lines
  std::map<std::pair<int, long>, GmshGroup> groups; ///< by dimension (2 or 3) and number
};

/// Sections may stand in any order behind the first, save that the entities of format 4.1 come before their
/// elements. Throws UserError that says where and what is wrong and what is allowed, without the file's name.
GmshFile read_gmsh(std::istream &stream);

} // namespace tribogel
