/// One plain description of a serial mesh, which every model produces before DMPlex sees it.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace tribogel
{

/// What a part of a body's boundary is. On `fixed_x` and `fixed_y` that component of the displacement is 0:
/// planes of symmetry.
enum class Side { axis, wall, top_plate, bottom_plate, slave, master, fixed_x, fixed_y };
inline constexpr int side_count = 8;
inline constexpr const char *side_names[side_count] = {"axis",  "wall",   "top_plate", "bottom_plate",
                                                       "slave", "master", "fixed_x",   "fixed_y"};

inline constexpr int bottom_body = 0, top_body = 1;

/// Both bodies on one process: quadrilaterals in the (R, Z) half plane (dim 2) or hexahedra (dim 3), in a
/// grid of their own that `shape` maps to the reference position.
struct SerialMesh {
  /// Smooth; from a place in the grid to the reference position [mm], (R, Z, 0) or (x, y, z); applied to all
  /// nodes, midside ones too.
  using Shape = std::function<std::array<double, 3>(const std::array<double, 3> &)>;

  struct Cell {
    std::array<int, 8> vertex; ///< lexicographic, a quadrilateral's are the first four; right-handed
    int body;
    double key; ///< the cells are cut by it into parts of equal number, one a rank
  };
  struct Facet {
    std::array<int, 4> vertex; ///< in any order, an edge's are the first two
    Side side;
  };

  int dim = 2;
  std::vector<std::array<double, 3>> vertex; ///< in the grid; the third is 0 in the half plane
  std::vector<Cell> cell;
  std::vector<Facet> boundary;
  std::array<Shape, 2> shape; ///< of each body; empty: the grid itself

  /// Reference positions [mm] of the middles of edges, faces and cells that do not lie at the means of their
  /// vertices, which are the keys: decreasing, then -1.
  std::map<std::array<int, 8>, std::array<double, 3>> middle;

  int corners() const { return 1 << dim; }             ///< of a cell
  int facet_corners() const { return 1 << (dim - 1); } ///< of a facet
};

/// Turns the top body about y, by `angle` [rad], about the centre of its plate's face, which then moves along
/// z such that the body's lowest vertex is as high as before: at +x for an angle > 0.
void tilt_top(SerialMesh &mesh, double angle);

} // namespace tribogel
