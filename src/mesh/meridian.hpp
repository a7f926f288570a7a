/// The bodies in the (R, Z) half plane before DMPlex sees them: structured blocks of quadrilaterals with
/// named sides.
#pragma once

#include "mesh/blocks.hpp"
#include "tribogel/scene/scene.hpp"

#include <array>
#include <functional>
#include <vector>

namespace tribogel
{

/// One body: the tensor grid R x Z with a name for each of its four sides, deformed if it has a shape. The
/// two contact sides must run outwards (R grows along them), and an axis must stay at R = 0. In the half
/// plane the corner of the lower and the outer side can be split (mesh/split_corner.hpp).
struct MeridianBlock {
  int body;
  std::vector<double> R, Z; ///< increasing [mm]
  Side inner, outer, lower, upper;
  std::function<std::array<double, 2>(double R, double Z)> shape =
      {}; ///< smooth, position [mm]; empty: (R, Z) itself
  int split =
      0; ///< so many cells in each direction give way at that corner; at most half of the columns and rows

  long cells() const
  {
    return static_cast<long>(R.size() - 1) * static_cast<long>(Z.size() - 1) - long{split} * split;
  }
};

/// Meshes of the scene's specimens. Stress is singular where the bonded ends and the contact meet the side
/// walls: from these lines the edges grow linearly with the distance, from the smallest to `grading` times
/// that, and stay there. `elements_radial` edges lie on the top (or only) specimen's radius; the rest follows
/// from the same sizes, so meshes of equal grading differ in scale only (up to whole numbers of edges).
/// `refinements` keeps these numbers and every node.
std::vector<MeridianBlock> meridian_blocks(const Scene &scene);

/// The blocks, one a body, as one mesh; ranks get bands of equal cell count in R through both bodies.
SerialMesh serial_mesh(const std::vector<MeridianBlock> &blocks);

} // namespace tribogel
