#include "mesh/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace tribogel
{

namespace
{

/// Half the square's edge over the radius: there the cells at the middle of its edges, at its corners and at
/// the rim are about equally wide.
constexpr double square_over_radius = 0.5;

using Plane = std::array<double, 2>;

/// By a quarter of a turn, `quarters` times.
Plane turned(Plane x, int quarters)
{
  for (int q = 0; q < quarters; ++q) x = {-x[1], x[0]};
  return x;
}

/// From the grid's plane to the unit disc; `c` is half the edge of the inner square.
Plane disc_point(Plane x, double c)
{
  const auto inside = [](double a, double b) -> Plane {
    return {a * std::sqrt(1 - b * b / 2), b * std::sqrt(1 - a * a / 2)};
  };
  const double s = std::max(std::abs(x[0]), std::abs(x[1]));
  if (s <= c) return inside(x[0], x[1]);
  int quarters = 0;
  while (x[0] < std::abs(x[1])) { // until the point is in the sector about the first axis
    x = turned(x, 3);
    ++quarters;
  }
  const double tau = x[1] / s, angle = tau * std::numbers::pi / 4, part = (s - c) / (1 - c);
  const Plane inner = inside(c, c * tau), outer{std::cos(angle), std::sin(angle)};
  return turned({(1 - part) * inner[0] + part * outer[0], (1 - part) * inner[1] + part * outer[1]}, quarters);
}

/// One layer of cells in the grid's plane.
struct Disc {
  double c; ///< half the edge of the inner square
  std::vector<Plane> vertex;
  std::vector<std::array<int, 4>> cell; ///< lexicographic
  std::vector<int> rim;                 ///< vertices on the outline, all around
};

Disc disc_of(const std::vector<double> &R)
{
  const double outer = R.back();
  const auto last = R.end() - (R.size() > 2 ? 2 : 1); // at least one ring, unless there is one edge only
  const auto beyond =
      std::find_if(R.begin() + 1, last, [&](double r) { return r >= square_over_radius * outer; });
  const int k = static_cast<int>(beyond - R.begin()), n = 2 * k;
  Disc disc{R[k] / outer, {}, {}, {}};
  std::vector<double> t; // along an edge of the square
  for (int i = 0; i <= n; ++i) t.push_back(i < k ? -R[k - i] / R[k] : R[i - k] / R[k]);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) disc.vertex.push_back({disc.c * t[i], disc.c * t[j]});
  const auto centre = [n](int i, int j) { return i + j * (n + 1); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      disc.cell.push_back({centre(i, j), centre(i + 1, j), centre(i, j + 1), centre(i + 1, j + 1)});

  std::vector<int> ring;
  for (int i = 0; i < n; ++i) ring.push_back(centre(n, i));
  for (int i = 0; i < n; ++i) ring.push_back(centre(n - i, n));
  for (int i = 0; i < n; ++i) ring.push_back(centre(0, n - i));
  for (int i = 0; i < n; ++i) ring.push_back(centre(i, 0));
  for (std::size_t level = k + 1; level < R.size(); ++level) {
    const double s = R[level] / outer;
    std::vector<int> next;
    for (int p = 0; p < 4 * n; ++p) {
      next.push_back(static_cast<int>(disc.vertex.size()));
      disc.vertex.push_back(turned({s, s * t[p % n]}, p / n));
    }
    for (int p = 0; p < 4 * n; ++p) {
      const int q = (p + 1) % (4 * n);
      disc.cell.push_back({ring[p], next[p], ring[q], next[q]});
    }
    ring = next;
  }
  disc.rim = ring;
  return disc;
}

/// From the grid to the reference position. The block's own shape moves each point in its meridian plane.
SerialMesh::Shape shape_of(const MeridianBlock &block, double c)
{
  const double outer = block.R.back();
  return [outer, c, meridian = block.shape](const std::array<double, 3> &X) -> std::array<double, 3> {
    const Plane x = disc_point({X[0], X[1]}, c);
    if (!meridian) return {outer * x[0], outer * x[1], X[2]};
    const double r = std::hypot(x[0], x[1]);
    const auto [R, Z] = meridian(outer * r, X[2]);
    const double scale = r > 0 ? R / r : 0;
    return {scale * x[0], scale * x[1], Z};
  };
}

void extrude(const MeridianBlock &block, const Disc &disc, SerialMesh &mesh)
{
  const int first = static_cast<int>(mesh.vertex.size()), stride = static_cast<int>(disc.vertex.size());
  const int layers = static_cast<int>(block.Z.size()) - 1;
  for (const double z : block.Z)
    for (const Plane &x : disc.vertex) mesh.vertex.push_back({x[0], x[1], z});
  for (int l = 0; l < layers; ++l)
    for (const auto &quadrilateral : disc.cell) {
      SerialMesh::Cell cell{{}, block.body, 0};
      Plane middle{};
      for (int v = 0; v < 4; ++v) {
        cell.vertex[v] = first + l * stride + quadrilateral[v];
        cell.vertex[v + 4] = cell.vertex[v] + stride;
        for (int j = 0; j < 2; ++j) middle[j] += disc.vertex[quadrilateral[v]][j];
      }
      cell.key = std::atan2(middle[1], middle[0]);
      mesh.cell.push_back(cell);
      for (const auto &[layer, above, side] :
           {std::tuple{0, 0, block.lower}, std::tuple{layers - 1, 4, block.upper}})
        if (l == layer)
          mesh.boundary.push_back(
              {{cell.vertex[above], cell.vertex[above + 1], cell.vertex[above + 2], cell.vertex[above + 3]},
               side});
    }
  for (int l = 0; l < layers; ++l)
    for (std::size_t p = 0; p < disc.rim.size(); ++p) {
      const int a = first + l * stride + disc.rim[p],
                b = first + l * stride + disc.rim[(p + 1) % disc.rim.size()];
      mesh.boundary.push_back({{a, b, b + stride, a + stride}, block.outer});
    }
}

} // namespace

SerialMesh revolved_mesh(const std::vector<MeridianBlock> &blocks)
{
  SerialMesh mesh;
  mesh.dim = 3;
  for (const MeridianBlock &block : blocks) {
    const Disc disc = disc_of(block.R);
    extrude(block, disc, mesh);
    mesh.shape[block.body] = shape_of(block, disc.c);
  }
  return mesh;
}

SerialMesh mesh_of(Model model, const std::vector<MeridianBlock> &blocks)
{
  return model == Model::solid ? revolved_mesh(blocks) : serial_mesh(blocks);
}

} // namespace tribogel
