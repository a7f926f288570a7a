#include "gmsh/tables.hpp"

#include "support/user_error.hpp"

#include <map>
#include <string_view>
#include <utility>

namespace tribogel
{

GmshElementType gmsh_element_type(long number, const std::string &where)
{
  static const std::map<long, GmshElementType> taken{{15, {0, 1}},  {1, {1, 2}},  {8, {1, 3}},  {26, {1, 4}},
                                                     {3, {2, 4}},   {16, {2, 8}}, {10, {2, 9}}, {5, {3, 8}},
                                                     {17, {3, 20}}, {12, {3, 27}}};
  static const std::map<long, const char *> others{{2, "triangle"},
                                                   {9, "triangle"},
                                                   {4, "tetrahedron"},
                                                   {11, "tetrahedron"},
                                                   {6, "prism"},
                                                   {13, "prism"},
                                                   {18, "prism"},
                                                   {7, "pyramid"},
                                                   {14, "pyramid"},
                                                   {19, "pyramid"},
                                                   {92, "hexahedron of order 3"},
                                                   {36, "quadrangle of order 3"}};
  if (const auto found = taken.find(number); found != taken.end()) return found->second;
  const auto other = others.find(number);
  throw UserError{where + "an element of type " + std::to_string(number) +
                  (other == others.end() ? "" : std::string(" (") + other->second + ")") +
                  "; allowed: hexahedra of 8, 20 or 27 nodes and their faces"};
}

std::string foreign_head(const std::string &line)
{
  static const std::pair<const char *, const char *> heads[] = {
      {"(", " (as in meshes of ANSYS Fluent, which meshio writes unless it is told file_format=\"gmsh22\", "
            "binary=False)"},
      {"*", " (as in input of Abaqus)"},
      {"$ ", " (as in input of Nastran)"},
      {"MeshVersionFormatted", " (as in meshes of Medit)"},
      {"# vtk", " (as in files of VTK)"},
      {"<", " (as in XML)"},
      {"solid", " (as in STL, which holds surfaces only)"},
      {"\x89HDF", " (an HDF5 file: MED, CGNS or Exodus)"},
      {"CDF", " (a netCDF file: Exodus)"}};
  const std::size_t text = line.find_first_not_of(" \t");
  for (const auto &[head, program] : heads)
    if (text != std::string::npos && line.compare(text, std::string_view(head).size(), head) == 0)
      return program;
  return {};
}

} // namespace tribogel
