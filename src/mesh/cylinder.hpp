/// Solids of revolution as hexahedra: a disc of quadrilaterals without degenerate cells on the axis, extruded
/// along z.
#pragma once

#include "mesh/meridian.hpp"

#include <vector>

namespace tribogel
{

/// The blocks, one a body and each from the axis R = 0 on, turned about the axis. Where the radii pass about
/// the middle of the block's outer radius, with k edges from there to the axis, begins a square of 2 k x 2 k
/// cells; around it lie rings of 8 k cells, one an edge of R. The sides are the blocks'. Ranks get sectors
/// through both bodies.
///
/// The grid's plane is the square [-1, 1]^2: a tensor grid within |a|, |b| <= c, outside that rings of
/// squares max(|a|, |b|) = s, where s is the radius over the outer radius. The means of its vertices are the
/// right places for midside nodes, and those on the outline lie on the circle.
SerialMesh revolved_mesh(const std::vector<MeridianBlock> &blocks);

/// The blocks as the model takes them: in the half plane, or turned about the axis.
SerialMesh mesh_of(Model model, const std::vector<MeridianBlock> &blocks);

} // namespace tribogel
