// A side wall that rolls onto the master in space: the crease, the facets that may touch.
#include "solid_scene.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

using namespace tribogel;

namespace
{

/// A wall with its crease along y at x = 0, 6 facets of length 0.3 up and 3 of width 0.8 along the crease: it
/// lies on z = lift for a length, then rises on a cylinder. Its outside is below.
QuadReference rolled_wall(int order, double lying, double radius, double lift)
{
  return quad_grid(6, 3, 1.8, 2.4, order, false, [=](double x, double y) {
    const double s = x + 0.9, angle = std::max(0.0, s - lying) / radius;
    return Vector3<double>(std::min(s, lying) + radius * std::sin(angle), y,
                           lift + radius * (1 - std::cos(angle)));
  });
}

QuadReference plane_master(int order)
{
  return quad_grid(5, 5, 5.5, 5, order, true,
                   [](double x, double y) { return Vector3<double>(x + 0.6, y + 0.05 * x, 0); });
}

std::vector<bool> crease_of(const QuadReference &wall)
{
  std::vector<bool> crease;
  for (const auto &X : wall.X) crease.push_back(X[0] < 1e-12);
  return crease;
}

/// The facets whose centres are within `length` of the crease along the wall can touch.
SolidScene wall_scene(int order, int rows)
{
  QuadReference wall = rolled_wall(order, 1.2, 1.5, 0.01);
  SurfaceParameters parameters{.order = order, .softer_modulus = 0.7};
  for (std::size_t f = 0; f < wall.facets.size(); ++f)
    parameters.left_out.push_back(static_cast<int>(f) % 6 >= rows);
  parameters.on_crease = crease_of(wall);
  return {wall, plane_master(order), parameters};
}

} // namespace

/// The neighbours' multipliers are extended to the crease, so a constant one loads every node of a lying
/// wall, crease included, as a uniform pressure does: int N_b dS.
TEST(SolidWall, ConstantMultiplierIsAUniformPressureUpToTheCrease)
{
  const PolynomialFriction<double> law{{0.3}, {0}, 1};
  for (int order : {1, 2}) {
    SolidScene scene = wall_scene(order, 4);
    scene.state.multiplier.assign(scene.slaves(), {0, 0, 1.3});
    SurfaceContact contact(scene.geometry);
    const auto pairs = contact.candidate_pairs(scene.state, 0);
    ASSERT_EQ(contact.update(scene.state, pairs, false).status, MortarStatus::ok);
    const Eigen::VectorXd F = scene.residual(law, pairs);
    Eigen::VectorXd area = Eigen::VectorXd::Zero(scene.slaves());
    const auto &surface = scene.geometry.slave_surface;
    const double share[2][3] = {{0.5, 0.5, 0}, {1.0 / 6, 4.0 / 6, 1.0 / 6}};
    for (int f = 0; f < surface.facet_count(); ++f)
      for (int b = 0; surface.takes_part(f) && b < surface.facet_nodes(); ++b)
        area[surface.facets[f][b]] +=
            0.3 * 0.8 * share[order - 1][b % (order + 1)] * share[order - 1][b / (order + 1)];
    double slave = 0, master = 0;
    for (int a = 0; a < scene.slaves(); ++a) {
      EXPECT_NEAR(F[3 * a + 2], -1.3 * area[a], 1e-12) << "order " << order << ", node " << a;
      slave += F[3 * a + 2];
    }
    for (int m = 0; m < scene.masters(); ++m) master += F[3 * (scene.slaves() + m) + 2];
    EXPECT_NEAR(slave, -1.3 * 1.2 * 2.4, 1e-12);
    EXPECT_NEAR(master, -slave, 1e-12);
  }
}

TEST(SolidWall, NodesOfFacetsThatCannotTouchAreHeldAtZero)
{
  for (int order : {1, 2}) {
    const SolidScene scene = wall_scene(order, 2);
    for (int a = 0; a < scene.slaves(); ++a) {
      const double s = scene.geometry.slave.X[a][0];
      const SlaveNode &node = scene.geometry.nodes[a];
      EXPECT_EQ(node.carries, s > 1e-12 && s < 0.6 + 1e-12) << "order " << order << ", node " << a;
      EXPECT_EQ(node.tied >= 0, s > 1e-12 && s < (order == 1 ? 0.3 : 0.15) + 1e-12);
      EXPECT_GT(node.extent, 0); // the scale of its row lambda = 0
    }
  }
}

/// The Jacobian with nodes tied to a crease, and with a law that depends on the current area.
TEST(SolidWall, JacobianIsTheDerivative)
{
  for (int order : {1, 2})
    for (const PolynomialFriction<double> &law : {PolynomialFriction<double>{{0.3, 0.2}, {0, 1}, 1},
                                                  PolynomialFriction<double>{{0.4, 0.1}, {0, 1}, 0.6, 0.01}})
      for (double load : {-2.0, 1.0, 50.0}) {
        SolidScene scene = wall_scene(order, 4);
        make_general(scene, load, 3);
        EXPECT_LT(jacobian_error(scene, law, order == 1 ? 5 : 31), 1e-8)
            << "order " << order << ", load " << load;
      }
}

TEST(SolidWall, FacetsThatLeanOverTheMasterAndAreNearMayTouch)
{
  for (int order : {1, 2}) {
    const QuadReference master = plane_master(order);
    const auto rows = [&](const QuadReference &wall) {
      const SolidScene scene(wall, master, order);
      const auto may = SurfaceContact(scene.geometry).rolling_facets(scene.state, crease_of(wall)).touch;
      const auto count = static_cast<int>(std::count(may.begin(), may.end(), true));
      EXPECT_EQ(count % 3, 0);
      return count / 3;
    };
    EXPECT_EQ(
        rows(quad_grid(6, 3, 1.8, 2.4, order, false,
                       [](double x, double y) { return Vector3<double>(0.1 * (x + 0.9), y, x + 0.9); })),
        0);                                          // upright
    EXPECT_EQ(rows(rolled_wall(order, 9, 1, 0)), 6); // lies down
    EXPECT_EQ(rows(rolled_wall(order, 9, 1, 0.29)), 6);
    EXPECT_EQ(rows(rolled_wall(order, 9, 1, 0.31)), 0);
    EXPECT_EQ(rows(rolled_wall(order, 0.9, 0.6, 0)), 5); // three lie, two lean by 14 and 43 degrees, then 72
  }
}

TEST(SolidWall, AFacetCutOffFromTheCreaseCannotTouch)
{
  const QuadReference wall = rolled_wall(1, 9, 1, 0);
  const QuadSurface surface(wall.facets, 1, static_cast<int>(wall.X.size()));
  std::vector<bool> marked(wall.facets.size(), true); // rows of 6 away from the crease
  marked[2] = marked[8] = marked[14] = false;
  const auto connected = connected_to_crease(surface, crease_of(wall), marked);
  for (std::size_t f = 0; f < connected.size(); ++f) EXPECT_EQ(connected[f], f % 6 < 2) << f;
  marked[8] = true; // a bridge
  EXPECT_EQ(std::count(marked.begin(), marked.end(), true), [&] {
    const auto all = connected_to_crease(surface, crease_of(wall), marked);
    return std::count(all.begin(), all.end(), true);
  }());
}
