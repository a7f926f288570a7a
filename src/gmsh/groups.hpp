/// Words about the groups of a Gmsh file.
#pragma once

#include "gmsh/file.hpp"

#include <string>

namespace tribogel
{

/// That no element of this dimension is in a group of this name, which one may be meant, and which groups
/// there are.
std::string no_such_group(const GmshFile &file, int dim, const std::string &name);

} // namespace tribogel
