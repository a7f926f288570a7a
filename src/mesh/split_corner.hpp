/// A block's grid whose lower outer corner can open to a flat angle.
///
/// At a body's edge of 90 degrees a grid has one quadrilateral, with a right angle there. Where the body
/// rolls over that edge, its two outer sides come to lie in one line, and the quadrilateral turns inside out,
/// whatever the gel can bear. So the corner's cells are taken out and the two sides that they leave are
/// joined to one diagonal. At the edge now two quadrilaterals meet, with half of the angle each, and they are
/// sound until the angle is 360 degrees:
///
///     +---+---+---+           +---+---+---+
///     |   |   |   |           |   |   |   |
///     +---+---+---+           +---+---+   |
///     |   |   |   |    -->    |   |    \  |
///     +---+---+---+           +---+-----\-+
#pragma once

#include "mesh/meridian.hpp"

namespace tribogel
{

/// Points and cells of a block's grid by column i and row j, the corner split as the block says.
class BlockGrid
{
public:
  struct Point {
    int i, j;
    bool operator==(const Point &) const = default;
  };

  explicit BlockGrid(const MeridianBlock &block);

  int columns() const { return static_cast<int>(R.size()); } ///< of points
  int rows() const { return static_cast<int>(Z.size()); }

  /// Whether the cell between the columns i, i + 1 and the rows j, j + 1 is one of the mesh.
  bool has_cell(int i, int j) const { return i < first || j >= split; }

  /// The point that stands for (i, j): itself, or one of the diagonal. Not for points within the corner.
  Point joined(int i, int j) const;

  /// Whether (i, j) is a point of the mesh that stands for itself.
  bool has_point(int i, int j) const;

  /// In the block's grid, (R, Z) [mm]. The cells beside the diagonal are stretched towards it.
  std::array<double, 2> position(int i, int j) const;

private:
  const std::vector<double> &R, &Z;
  int split, first; ///< cells of the corner in each direction; its first column
};

/// How many cells of the top gel's lower edge to give way, in each direction; 0: the grid is left as it is.
///
/// The edge rolls where friction holds it against the plates' motion: with mu = 0.3 the paper's scene,
/// pressed and turned by 0.08 rad, opens it to 180 degrees over 0.05 mm, and a grid of 12 elements stops
/// there. With mu < 0.1 the edge slides, and longer edges do not follow it: both do without. A real edge is
/// round. Elastic gels, mu = 0.5, 10 elements, edges rounded over `radius` by the block's shape and sharp
/// ones on the same grid: N and T after 0.1 and 1.2 rad
///
///     radius [mm]  0.2               0.1               0.025
///     round        302.94   347.09   303.33   347.67   303.57   347.73   N [N] and T [N mm] at 0.1 rad
///     sharp        303.56   347.65   303.51   347.42
///     round        320.74  1016.00   320.74  1016.61   320.79  1017.08   at 1.2 rad
///     sharp        320.75  1016.83   320.75  1016.86
///
/// The round and the sharp edge differ by 0.2 % while stuck, by 0.1 % in full slip: the sharp one stays.
/// Meshes with edges of 0.025 mm there may fold all the same: with the radius 0.05 mm the round edge at 0.16
/// rad and the sharp one at 0.11; the default grid with 24 elements at 0.12 rad, which with a grading of 13
/// does not.
int split_of_lower_edge(const Scene &scene, const MeridianBlock &top, double zone);

} // namespace tribogel
