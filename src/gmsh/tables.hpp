/// What numbers in Gmsh files and first lines of other files stand for.
#pragma once

#include <cstddef>
#include <string>

namespace tribogel
{

struct GmshElementType {
  int dim;
  std::size_t nodes;
};

/// Of Gmsh's number of a type; those with dim 0 or 1 are passed over. Throws UserError, which begins with
/// `where`, if it is none of ours.
GmshElementType gmsh_element_type(long number, const std::string &where);

/// What a file that begins with this line, and with no section, may be, in brackets after a blank; empty if
/// it is not known: several programs share the ending .msh.
std::string foreign_head(const std::string &line);

} // namespace tribogel
