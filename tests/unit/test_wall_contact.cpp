/// Side walls: the node at a rigid plate, the curve that starts at a crease, the facets that may roll on.
#include "contact_scene.hpp"

#include "tribogel/contact/curve/rolling.hpp"
#include "tribogel/contact/node/plate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tribogel
{

using testing::assemble;
using testing::breaks;
using testing::ContactScene;
using testing::curve;
using testing::flat;
using testing::Law;
using testing::moving;
using testing::whole_residual;

const Vector3<double> up(0, 0, 1), down(0, 0, -1);

TEST(WallOnPlate, AnOpenNodeCarriesNothingAndAClosedOneIsHeldAtThePlate)
{
  const Vector3<double> lambda(0.3, -0.2, -1.7); // pressed down by a plate above
  const PlateNodeBlock closed = plate_node(-0.01, up, lambda, 0.7, 5);
  EXPECT_NE(closed.status, ContactStatus::open);
  EXPECT_DOUBLE_EQ(closed.force[2], 0.7 * 1.7); // internal minus external
  EXPECT_EQ(closed.force.head<2>().norm(), 0);
  EXPECT_NEAR(closed.condition[2], 0.7 * 5 * 0.01, 1e-13); // c_N times the penetration
  EXPECT_DOUBLE_EQ(closed.condition[0], 0.7 * 0.3);        // no friction
  EXPECT_DOUBLE_EQ(closed.condition[1], -0.7 * 0.2);
  const PlateNodeBlock open = plate_node(0.5, up, lambda, 0.7, 5); // c_N g = 2.5 > 1.7
  EXPECT_EQ(open.status, ContactStatus::open);
  EXPECT_DOUBLE_EQ(open.condition[2], -0.7 * 1.7);
  const PlateNodeBlock below = plate_node(-0.01, down, {0, 0, 1.7}, 0.7, 5);
  EXPECT_NE(below.status, ContactStatus::open);
  EXPECT_NEAR(below.condition[2], -0.7 * 5 * 0.01, 1e-13);
}

TEST(WallOnPlate, AnInclinedPlateIsTheLevelOneTurned)
{
  const double angle = 0.3;
  Matrix3<double> Q = Matrix3<double>::Identity();
  Q(0, 0) = Q(2, 2) = std::cos(angle);
  Q(0, 2) = std::sin(angle);
  Q(2, 0) = -Q(0, 2);
  const Vector3<double> lambda(0.3, -0.2, -1.7);
  for (double gap : {-0.01, 0.5}) {
    const PlateNodeBlock level = plate_node(gap, up, lambda, 0.7, 5),
                         turned = plate_node(gap, Q * up, Q * lambda, 0.7, 5);
    EXPECT_EQ(turned.status, level.status);
    EXPECT_LE((turned.force - Q * level.force).norm(), 1e-15);
    EXPECT_LE((turned.condition - Q * level.condition).norm(), 1e-15);
    EXPECT_LE((turned.d_gap - Q * level.d_gap * Q.transpose()).norm(), 1e-14);
    EXPECT_LE((turned.d_force - Q * level.d_force * Q.transpose()).norm(), 1e-14);
    EXPECT_LE((turned.d_traction - Q * level.d_traction * Q.transpose()).norm(), 1e-14);
  }
}

TEST(WallOnPlate, DerivativesAreThoseOfTheRows)
{
  constexpr double h = 1e-6;
  for (const Vector3<double> &outward : {up, down, Vector3<double>(0.6, 0, 0.8)})
    for (double gap : {-0.01, 0.5}) {
      const Vector3<double> lambda = -1.7 * outward + Vector3<double>(0.3, -0.2, 0),
                            none = Vector3<double>::Zero();
      const auto at = [&](const Vector3<double> &du, const Vector3<double> &dl) {
        return plate_node(gap - outward.dot(du), outward, lambda + dl, 0.7, 5);
      };
      const PlateNodeBlock block = at(none, none);
      for (int j = 0; j < 3; ++j) {
        const Vector3<double> d = h * Vector3<double>::Unit(j);
        const auto slope = [&](auto member, bool of_gap) {
          const PlateNodeBlock ahead = of_gap ? at(d, none) : at(none, d),
                               behind = of_gap ? at(-d, none) : at(none, -d);
          return Vector3<double>((ahead.*member - behind.*member) / (2 * h));
        };
        EXPECT_LE((slope(&PlateNodeBlock::condition, true) - block.d_gap.col(j)).norm(), 1e-8);
        EXPECT_LE((slope(&PlateNodeBlock::condition, false) - block.d_traction.col(j)).norm(), 1e-8);
        EXPECT_LE((slope(&PlateNodeBlock::force, false) - block.d_force.col(j)).norm(), 1e-8);
      }
    }
}

namespace
{

/// A wall from a crease at R = 5 that lies on Z = lift for a length, then rises on a circle.
SurfaceReference rolled_wall(int order, const std::vector<double> &s, double lying, double radius,
                             double lift)
{
  return curve(order, s, [=](double at) {
    const double angle = std::max(0.0, at - lying) / radius;
    return PlanePoint<double>{5 + std::min(at, lying) + radius * std::sin(angle),
                              lift + radius * (1 - std::cos(angle))};
  });
}

ContactScene wall_scene(int order, int facets, double disorder)
{
  const CurveParameters parameters{.order = order,
                                   .twist_length = 7.3,
                                   .softer_modulus = 1.7,
                                   .carries_multiplier = {},
                                   .facets_in_contact = facets,
                                   .starts_at_crease = true};
  return {rolled_wall(order, breaks(6, 0, 2.1, disorder, 3), 1.5, 0.8, 0.02),
          flat(order, breaks(11, 3, 8, 0.6, 5), 0), parameters};
}

} // namespace

/// The neighbour's multiplier is extended to the crease, so a constant one loads every node of a lying wall,
/// crease included, as a uniform pressure does: int N_b 2 pi R dR.
TEST(Crease, ConstantMultiplierIsAUniformPressureUpToTheEdge)
{
  for (int order : {1, 2}) {
    ContactScene scene = wall_scene(order, 4, 0);
    for (auto &lambda : scene.state.multiplier) lambda = {0, 0, 1.3};
    scene.state.multiplier[0] = {0, 0, 77}; // not its own
    const auto assembled = assemble(scene, pairs_of_scene(scene), Law{}, false);
    ASSERT_EQ(assembled.report.status, MortarStatus::ok);
    const double h = 2.1 / 6;
    const double R0 = 5, R1 = 5 + h, ring = 2 * std::numbers::pi * h / 6;
    EXPECT_NEAR(assembled.residual[2], -1.3 * ring * (order == 1 ? 2 * R0 + R1 : R0), 1e-12)
        << "order " << order;
    if (order == 2) {
      EXPECT_NEAR(assembled.residual[5], -1.3 * ring * 2 * (R0 + R1), 1e-12);
    }
    double slave = 0, master = 0;
    for (int a = 0; a < scene.slave_nodes(); ++a) slave += assembled.residual[3 * a + 2];
    for (int m = 0; m < scene.master_nodes(); ++m)
      master += assembled.residual[3 * (scene.slave_nodes() + m) + 2];
    EXPECT_NEAR(slave, -1.3 * std::numbers::pi * (6.4 * 6.4 - 25), 1e-11); // four lying facets
    EXPECT_NEAR(master, -slave, 1e-11);
  }
}

TEST(Crease, NodesBeyondTheTouchingFacetsAreHeldAtZero)
{
  const ContactScene scene = wall_scene(2, 2, 0);
  const auto &nodes = scene.geometry.nodes;
  EXPECT_FALSE(nodes[0].carries);
  EXPECT_EQ(nodes[1].tied, 0);
  for (int a = 1; a <= 4; ++a) EXPECT_TRUE(nodes[a].carries) << a;
  for (std::size_t a = 5; a < nodes.size(); ++a) {
    EXPECT_FALSE(nodes[a].carries) << a;
    EXPECT_GT(nodes[a].extent, 0) << a; // the scale of its row lambda = 0
  }
}

/// The operator's Jacobian against dual numbers through the whole residual.
TEST(Crease, JacobianIsExact)
{
  const Law law{{0.3, 0.21, 0.13}, {0, 1, 2.5}}, kagata{{0.3, 0.2}, {0, 0.5}, 0.4, 1e-5};
  for (int order : {1, 2})
    for (const Law &friction : {law, kagata})
      for (double pressure : {0.9, -0.9}) {
        ContactScene scene = wall_scene(order, 5, 0.5);
        scene.disturb(0.01, 0.3, pressure, 0.2, 20);
        scene.state.shift = 3.1;
        scene.state.stick_rate = 2.7;
        scene.state.slave.rotation_rate = 0.03;
        const auto pairs = pairs_of_scene(scene);
        const auto assembled = assemble(scene, pairs, friction, true);
        ASSERT_EQ(assembled.report.status, MortarStatus::ok);
        const Eigen::VectorXd plain = whole_residual<double>(scene, scene.state, pairs, friction);
        EXPECT_LE((plain - assembled.residual).norm(), 1e-13 * plain.norm());
        std::mt19937 random(9);
        std::uniform_real_distribution<double> number(-1, 1);
        for (int repeat = 0; repeat < 4; ++repeat) {
          Eigen::VectorXd w(scene.unknowns());
          for (auto &x : w) x = number(random);
          const auto exact = whole_residual<Dual<1>>(scene, moving(scene, w), pairs, friction);
          const Eigen::VectorXd product = assembled.jacobian * w,
                                scale = assembled.jacobian.cwiseAbs() * w.cwiseAbs();
          for (int i = 0; i < scene.unknowns(); ++i)
            EXPECT_LE(std::abs(product[i] - exact[i].d[0]), 1e-12 * scale[i])
                << "order " << order << ", row " << i;
        }
      }
}

TEST(Rolling, CountsTheFacetsThatLeanOverTheMasterAndAreNear)
{
  const SurfaceReference master = flat(1, breaks(11, 3, 8), 0);
  const LineChain on(master.facets, 2, static_cast<int>(master.X.size()));
  const auto count = [&](const SurfaceReference &wall) {
    return rolling_facets(LineChain(wall.facets, 2, static_cast<int>(wall.X.size())), wall.X, on, master.X);
  };
  const std::vector<double> s = breaks(8, 0, 2.4);                                       // facets of 0.3
  EXPECT_EQ(count(curve(1, s, [](double at) { return PlanePoint<double>{5, at}; })), 0); // upright
  EXPECT_EQ(count(rolled_wall(1, s, 9, 1, 0)), 8);                                       // lies down
  EXPECT_EQ(count(rolled_wall(1, s, 9, 1, 0.29)), 8);                                    // near
  EXPECT_EQ(count(rolled_wall(1, s, 9, 1, 0.31)), 0);                                    // far
  EXPECT_EQ(count(rolled_wall(1, s, 0.9, 0.6, 0)), 5); // three lie, two lean by 14 and 43 degrees, then 72
}

} // namespace tribogel
