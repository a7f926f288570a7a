/// Whether a mesh is the one that it was.
#pragma once

#include "mesh/blocks.hpp"

#include <string>

namespace tribogel
{

/// 16 hexadecimal digits of the cells, their vertices and bodies, and the named boundary, in their order.
/// With `places` also of the nodes' positions, to the bit: for meshes of a file. Those of the program's own
/// meshes are computed, and a processor's mathematical functions may differ from another's in the last bit;
/// their numbers of cells do not.
std::string digest_of(const SerialMesh &mesh, bool places);

} // namespace tribogel
