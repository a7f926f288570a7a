#include "mesh/meridian.hpp"

#include "mesh/split_corner.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

/// Width of the zone in which edges grow, over the smallest dimension of the specimens. Measured on the paper
/// scene, see MeshParameters.
constexpr double zone_over_size = 0.25;

/// Edges in the band of the bottom gel over which the top's rim slides, against the largest.
constexpr double band_refinement = 8;

/// Wanted edge length at a distance d from a line of singular stress: it grows linearly from `smallest` to
/// `largest` over the width of a zone.
struct SizeField {
  double smallest, largest, zone;
  int halves; ///< each edge is cut into so many

  /// Number of edges between a fine end and the distance d from it, int_0^d dx / h(x).
  double edges(double d) const
  {
    const double growth = (largest - smallest) / zone, inside = std::min(d, zone);
    const double graded = growth > 0 ? std::log1p(growth * inside / smallest) / growth : inside / smallest;
    return graded + (d - inside) / largest;
  }

  /// Its inverse.
  double distance(double count) const
  {
    const double growth = (largest - smallest) / zone, in_zone = edges(zone);
    if (count > in_zone) return zone + (count - in_zone) * largest;
    return growth > 0 ? smallest * std::expm1(growth * count) / growth : count * smallest;
  }
};

/// The field that puts `elements` edges on a radius whose outer end is fine.
SizeField size_field(double radius, int elements, const MeshParameters &mesh, double zone)
{
  const SizeField shape{1 / mesh.grading, 1, zone, 1};
  const double unit = shape.edges(radius) / elements;
  return {unit / mesh.grading, unit, zone, 1 << mesh.refinements};
}

/// Distances from a fine end at 0 to `length`, about edges(length) of them, at least one; then cut. What is
/// cut keeps the nodes it had, and the edges go on growing linearly.
std::vector<double> graded_distances(double length, const SizeField &field)
{
  const double total = field.edges(length);
  const auto count = std::max(1L, std::lround(total)) * field.halves;
  std::vector<double> points;
  for (long k = 0; k < count; ++k)
    points.push_back(field.distance(total * static_cast<double>(k) / static_cast<double>(count)));
  points.push_back(length);
  return points;
}

std::vector<double> points_between(double a, double b, bool fine_at_a, bool fine_at_b, const SizeField &field)
{
  std::vector<double> points;
  if (fine_at_a) {
    const double part = fine_at_b ? 0.5 * (b - a) : b - a;
    for (const double d : graded_distances(part, field)) points.push_back(a + d);
  } else if (fine_at_b)
    points.push_back(a);
  else
    for (const double d : graded_distances(b - a, {field.largest, field.largest, field.zone, field.halves}))
      points.push_back(a + d);
  if (fine_at_b) {
    std::vector<double> distances = graded_distances(b - points.back(), field);
    for (auto d = distances.rbegin() + 1; d != distances.rend(); ++d) points.push_back(b - *d);
  }
  points.back() = b;
  return points;
}

} // namespace

namespace
{

/// Radii of the bottom body: fine at the outer wall and where the top's rim rests. While the gels are pressed
/// the rim slides outwards over the softer-held bottom gel, by 0.4 mm on the paper scene (approach 0.79 mm):
/// a band as wide as the approach gets edges of one size. With edges fine at the top's radius only, the
/// pressure at the rim wiggled by 25
/// %.
///
/// Neither the band nor what is left of the radius beyond it is cut into anything narrower than the band's
/// refined edges. In space a ring that is narrower than the arc of one of its cells is high has facets bent
/// like a hoop, and what their chords miss is wider than they are.
std::vector<double> radii_under_rim(const Scene &scene, const SizeField &field)
{
  const double rim = std::min(scene.top.radius, scene.bottom.radius), outer = scene.bottom.radius;
  const double narrowest = field.largest / band_refinement;
  if (outer - rim < narrowest)
    return points_between(0, outer, false, true, field); // fine at the rim as it is
  double travel = 0;
  for (const Phase &phase : scene.schedule)
    travel = std::max({travel, phase.start_approach, phase.end_approach});
  SizeField in_band = field;
  in_band.smallest = std::max(field.smallest, narrowest);
  const auto append = [](std::vector<double> &points, const std::vector<double> &more) {
    points.insert(points.end(), more.begin() + 1, more.end());
  };
  std::vector<double> R = points_between(0, rim, false, true, in_band);
  double end = rim; // of the band
  if (0.5 * (outer - rim) >= narrowest) {
    end = std::min(rim + std::max(narrowest, travel - scene.initial_gap), 0.5 * (rim + outer));
    append(R, points_between(rim, end, false, false,
                             {in_band.smallest, in_band.smallest, field.zone, field.halves}));
  }
  double middle = end;
  if (0.5 * (outer - end) >= narrowest) {
    middle = 0.5 * (end + outer);
    append(R, points_between(end, middle, true, false, in_band));
  }
  append(R, points_between(middle, outer, false, true, field));
  return R;
}

} // namespace

std::vector<MeridianBlock> meridian_blocks(const Scene &scene)
{
  const MeshParameters &mesh = scene.mesh;
  const Specimen &leading = scene.upper_gel();
  double smallest = leading.radius;
  for (const Specimen *gel : scene.gels()) smallest = std::min(smallest, gel->height);
  const double zone = zone_over_size * smallest;
  const SizeField s = size_field(leading.radius, mesh.elements_radial, mesh, zone);
  std::vector<MeridianBlock> blocks;

  if (scene.has_bottom()) {
    SizeField bottom_spacing = s;
    if (mesh.bottom_elements_radial > 0)
      bottom_spacing = size_field(leading.radius, mesh.bottom_elements_radial, mesh, zone);
    const Specimen &bottom = scene.bottom;
    blocks.push_back({bottom_body,
                      scene.has_top() ? radii_under_rim(scene, bottom_spacing)
                                      : points_between(0, bottom.radius, false, true, bottom_spacing),
                      points_between(-bottom.height, 0, true, true, bottom_spacing), Side::axis, Side::wall,
                      Side::bottom_plate, scene.has_top() ? Side::master : Side::top_plate});
  }
  if (scene.has_top()) {
    blocks.push_back({top_body, points_between(0, scene.top.radius, false, true, s),
                      points_between(scene.initial_gap, scene.initial_gap + scene.top.height, true, true, s),
                      Side::axis, Side::wall, Side::slave, Side::top_plate});
    blocks.back().split = split_of_lower_edge(scene, blocks.back(), zone);
  }
  return blocks;
}

namespace
{

/// Numbers of the grid's points in the mesh, row by row.
class GridNumbers
{
public:
  /// Appends the grid's points to the mesh.
  GridNumbers(const BlockGrid &of, SerialMesh &mesh) : grid(of)
  {
    numbers.resize(static_cast<std::size_t>(grid.columns()) * grid.rows(), -1);
    for (int j = 0; j < grid.rows(); ++j)
      for (int i = 0; i < grid.columns(); ++i) {
        if (!grid.has_point(i, j)) continue;
        const auto [r, z] = grid.position(i, j);
        numbers[i + j * grid.columns()] = static_cast<int>(mesh.vertex.size());
        mesh.vertex.push_back({r, z, 0});
      }
  }

  int operator()(int i, int j) const
  {
    const BlockGrid::Point point = grid.joined(i, j);
    return numbers[point.i + point.j * grid.columns()];
  }

private:
  const BlockGrid &grid;
  std::vector<int> numbers;
};

/// The outline's edges, in the order of the four sides.
void name_sides(const MeridianBlock &block, const BlockGrid &grid, const GridNumbers &number,
                SerialMesh &mesh)
{
  const int right = grid.columns() - 1, top = grid.rows() - 1;
  const auto edge = [&](int a, int b, Side side) { mesh.boundary.push_back({{a, b, -1, -1}, side}); };
  for (int i = 0; i < right; ++i) {
    if (grid.has_cell(i, 0)) edge(number(i, 0), number(i + 1, 0), block.lower);
    edge(number(i, top), number(i + 1, top), block.upper);
  }
  for (int j = 0; j < top; ++j) {
    edge(number(0, j), number(0, j + 1), block.inner);
    if (grid.has_cell(right - 1, j)) edge(number(right, j), number(right, j + 1), block.outer);
  }
}

} // namespace

SerialMesh serial_mesh(const std::vector<MeridianBlock> &blocks)
{
  SerialMesh mesh;
  for (const MeridianBlock &block : blocks) {
    const BlockGrid grid(block);
    const GridNumbers number(grid, mesh);
    for (int j = 0; j + 1 < grid.rows(); ++j)
      for (int i = 0; i + 1 < grid.columns(); ++i)
        if (grid.has_cell(i, j))
          mesh.cell.push_back(
              {{number(i, j), number(i + 1, j), number(i, j + 1), number(i + 1, j + 1), -1, -1, -1, -1},
               block.body,
               0.5 * (block.R[i] + block.R[i + 1])});
    name_sides(block, grid, number, mesh);
    if (const auto shape = block.shape)
      mesh.shape[block.body] = [shape](const std::array<double, 3> &X) {
        const auto [R, Z] = shape(X[0], X[1]);
        return std::array<double, 3>{R, Z, 0};
      };
  }
  return mesh;
}

} // namespace tribogel
