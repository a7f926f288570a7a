/// The top gel's lower edge where friction holds it: the mesh that can open there to a flat angle
/// (mesh/split_corner.hpp), and a scene in which it does.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <cmath>
#include <map>
#include <set>

namespace tribogel::test
{

namespace
{

using Point = std::array<double, 2>;

/// At each of a cell's corners: twice the area of the triangle with its neighbours, positive where the cell
/// is sound.
std::array<double, 4> corner_areas(const SerialMesh::Cell &cell, const std::vector<Point> &x)
{
  constexpr int around[4] = {0, 1, 3, 2}; // counter-clockwise
  std::array<double, 4> areas;
  for (int k = 0; k < 4; ++k) {
    const Point &a = x[cell.vertex[around[k]]], &next = x[cell.vertex[around[(k + 1) % 4]]],
                &before = x[cell.vertex[around[(k + 3) % 4]]];
    areas[k] = (next[0] - a[0]) * (before[1] - a[1]) - (next[1] - a[1]) * (before[0] - a[0]);
  }
  return areas;
}

double smallest_corner(const SerialMesh &mesh, const std::vector<Point> &x)
{
  double smallest = 1;
  for (const auto &cell : mesh.cell)
    for (const double area : corner_areas(cell, x)) smallest = std::min(smallest, area);
  return smallest;
}

std::vector<Point> places(const SerialMesh &mesh)
{
  std::vector<Point> x;
  for (const auto &vertex : mesh.vertex) x.push_back({vertex[0], vertex[1]});
  return x;
}

MeridianBlock block_of(int split)
{
  return {top_body,
          {0, 1, 1.8, 2.4, 2.8, 3},
          {0, 0.1, 0.3, 0.7, 1.2, 2},
          Side::axis,
          Side::wall,
          Side::slave,
          Side::top_plate,
          {},
          split};
}

/// Friction of that coefficient at any speed on the paper's rheometer.
Scene held(double mu, int elements, double grading)
{
  Scene scene = paper_scene(elements);
  scene.friction = PolynomialFriction<double>{{mu}, {0}};
  scene.mesh.grading = grading;
  return scene;
}

} // namespace

/// The cells fill the rectangle, each inner edge has two of them, each outer one has one and its side's name.
TEST(lower_edge, SplitMeshIsWhole)
{
  for (const int split : {0, 1, 2}) {
    const MeridianBlock block = block_of(split);
    const SerialMesh mesh = serial_mesh({block});
    const std::vector<Point> x = places(mesh);
    EXPECT_EQ(static_cast<long>(mesh.cell.size()), 25 - split * split);
    EXPECT_EQ(static_cast<long>(mesh.cell.size()), block.cells());
    EXPECT_GT(smallest_corner(mesh, x), 0);
    double area = 0;
    std::map<std::set<int>, int> cells; // by edge
    for (const auto &cell : mesh.cell) {
      const auto corners = corner_areas(cell, x);
      area += (corners[0] + corners[2]) / 2;
      for (const auto &[a, b] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}})
        ++cells[{cell.vertex[a], cell.vertex[b]}];
    }
    EXPECT_NEAR(area, 3 * 2, 1e-14);
    double length[side_count] = {};
    for (const auto &facet : mesh.boundary) {
      const std::set<int> edge{facet.vertex[0], facet.vertex[1]};
      ASSERT_EQ(cells.count(edge), 1u);
      EXPECT_EQ(cells[edge], 1);
      cells.erase(edge);
      const Point &a = x[facet.vertex[0]], &b = x[facet.vertex[1]];
      length[static_cast<int>(facet.side)] += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    for (const auto &[edge, count] : cells) EXPECT_EQ(count, 2);
    for (const auto &[side, exact] :
         {std::pair{Side::slave, 3}, {Side::top_plate, 3}, {Side::axis, 2}, {Side::wall, 2}})
      EXPECT_NEAR(length[static_cast<int>(side)], exact, 1e-14);
  }
}

/// Rolled over the edge: angles about it are doubled, from a quarter to half a turn, distances divided by
/// sqrt 2, so that areas stay. The grid has a cell that is flat at the edge, the split one none.
TEST(lower_edge, SplitMeshRollsOver)
{
  for (const int split : {0, 1, 2}) {
    const SerialMesh mesh = serial_mesh({block_of(split)});
    std::vector<Point> x = places(mesh);
    for (Point &p : x) {
      const double r = std::hypot(3 - p[0], p[1]) / std::numbers::sqrt2,
                   angle = 2 * std::atan2(p[1], 3 - p[0]);
      p = {-r * std::cos(angle), r * std::sin(angle)};
    }
    EXPECT_EQ(smallest_corner(mesh, x) > 1e-12, split > 0) << split;
  }
}

/// Where friction holds the edge and the mesh is fine enough there, and nowhere else.
TEST(lower_edge, WhereItIsSplit)
{
  const auto split = [](const Scene &scene) { return meridian_blocks(scene).back().split; };
  Scene paper = paper_scene(12);
  paper.mesh.grading = 30;
  EXPECT_EQ(split(paper), 0); // mu = 0.008 at most
  EXPECT_EQ(split(held(0.3, 12, 30)), 1);
  EXPECT_EQ(split(held(0.3, 8, 60)), 1);
  EXPECT_EQ(split(held(0.05, 12, 30)), 0);
  EXPECT_EQ(split(held(0.3, 12, 4)), 0);
  paper.friction = PolynomialFriction<double>{{0.02}, {1}}; // mu = 0.2 at the rim at 1 rad/s
  EXPECT_EQ(split(paper), 1);
  paper.model = Model::solid;
  EXPECT_EQ(split(paper), 0);
}

TEST(lower_edge, RefinedSplitMeshesAreNested)
{
  Scene scene = held(0.3, 12, 30);
  const SerialMesh coarse = serial_mesh(meridian_blocks(scene));
  scene.mesh.refinements = 1;
  const SerialMesh fine = serial_mesh(meridian_blocks(scene));
  EXPECT_EQ(fine.cell.size(), 4 * coarse.cell.size());
  EXPECT_GT(smallest_corner(fine, places(fine)), 0);
  for (const auto &a : coarse.vertex) {
    double nearest = 1;
    for (const auto &b : fine.vertex) nearest = std::min(nearest, std::hypot(a[0] - b[0], a[1] - b[1]));
    EXPECT_LT(nearest, 1e-12) << a[0] << " " << a[1];
  }
}

/// Elastic gels, pressed and turned by 0.12 rad with mu = 0.3: the edge rolls over. T and N of other grids,
/// whose edges are too long to show it (8 elements of grading 30, not split): 373.3 N mm, 301.9 N.
TEST(lower_edge, RollsOverAndTurns)
{
  Scene scene = held(0.3, 8, 60);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.time.rule = TimeRule::exponential_euler;
  scene.schedule = schedule_from_rates({27, 39}, {0.79, 0.79}, {0, 0.01});
  const SolverOptions options(OptionList{{"-ts_max_steps", "200"}});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  ASSERT_EQ(recorder.phases.size(), 2u);
  EXPECT_NEAR(recorder.phases[1].measurement.torque / 373.3, 1, 0.005);
  EXPECT_NEAR(recorder.phases[1].measurement.normal_force / 301.9, 1, 0.002);
}

} // namespace tribogel::test
