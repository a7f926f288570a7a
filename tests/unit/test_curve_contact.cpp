/// The axisymmetric contact operator: patch test, co-rotation, balances, torque under uniform pressure,
/// Jacobian, units.
#include "contact_scene.hpp"

#include <gtest/gtest.h>

namespace tribogel
{
namespace
{

using testing::assemble;
using testing::breaks;
using testing::ContactScene;
using testing::curve;
using testing::flat;
using testing::Law;
using testing::moving;
using testing::whole_residual;

constexpr double pi = std::numbers::pi;
const Law mixed{{0.3, 0.21, 0.13}, {0, 1, 2.5}};

ContactScene wavy(int order, double inner_radius, double master_radius, unsigned seed)
{
  const auto wave = [](double Z, double amplitude, double frequency) {
    return [=](double R) { return PlanePoint<double>{R, Z + amplitude * std::cos(frequency * R)}; };
  };
  ContactScene scene(
      curve(order, breaks(7, inner_radius, 10, 0.6, seed), wave(0.02, 0.15, 0.5)),
      curve(order, breaks(9, 0.8 * inner_radius, master_radius, 0.6, seed + 10), wave(0, 0.2, 0.45)),
      {.order = order, .twist_length = 7.3, .softer_modulus = 1.7});
  scene.disturb(0.05, 0.3, 0.9, 0.2, seed + 20);
  scene.state.shift = 3.1;
  scene.state.stick_rate = 2.7;
  scene.state.slave.rotation_rate = 0.03;
  scene.state.slave.travel_rate = -0.2;
  scene.state.master.rotation_rate = -0.011;
  return scene;
}

/// int N_b 2 pi R dR of every node of a flat curve: linear h (2 R_b + R_other) / 6, quadratic h (R_in, R_out,
/// 2 (R_in + R_out)) / 6.
std::vector<double> nodal_areas(const SurfaceReference &surface, int order)
{
  std::vector<double> area(surface.X.size());
  for (const auto &f : surface.facets) {
    const double R0 = surface.X[f[0]].r, R1 = surface.X[f[1]].r, h = 2 * pi * (R1 - R0) / 6;
    area[f[0]] += order == 1 ? h * (2 * R0 + R1) : h * R0;
    area[f[1]] += order == 1 ? h * (R0 + 2 * R1) : h * R1;
    if (order == 2) area[f[2]] += 2 * h * (R0 + R1);
  }
  return area;
}

/// A constant multiplier loads both surfaces as a uniform pressure does.
TEST(CurveContact, UniformPressurePassesThePatchTest)
{
  const double p = 0.83;
  for (int order : {1, 2})
    for (bool matching : {false, true}) {
      const auto slave_radii = breaks(6, 0, 10, 0.7, 3),
                 master_radii = matching ? slave_radii : breaks(9, 0, 10, 0.7, 4);
      ContactScene scene(flat(order, slave_radii, 0.1), flat(order, master_radii, 0.1), {.order = order});
      for (auto &lambda : scene.state.multiplier) lambda = {0, 0, p}; // up, on the upper body
      const auto out = assemble(scene, pairs_of_scene(scene), mixed, false);
      EXPECT_EQ(out.report.status, MortarStatus::ok);
      const auto slave = nodal_areas(scene.geometry.slave, order),
                 master = nodal_areas(scene.geometry.master, order);
      const double whole = pi * 100 * p;
      for (int a = 0; a < scene.slave_nodes(); ++a)
        EXPECT_NEAR(out.residual[3 * a + 2], -p * slave[a], 1e-14 * whole);
      for (int m = 0; m < scene.master_nodes(); ++m)
        EXPECT_NEAR(out.residual[3 * (scene.slave_nodes() + m) + 2], p * master[m], 1e-14 * whole);
      // the surfaces coincide and rest: the conditions hold as well, where a multiplier is carried
      for (int a = 0; a < scene.slave_nodes(); ++a) {
        if (!scene.geometry.nodes[a].carries) continue;
        EXPECT_LT(out.residual.segment<3>(3 * (scene.slave_nodes() + scene.master_nodes() + a)).norm(),
                  1e-13 * whole);
      }
    }
}

/// An inclined interface under hydrostatic stress: nodal forces of a pressure p on both cones, lambda = -p n.
TEST(CurveContact, InclinedInterfacePassesThePatchTestUnderHydrostaticStress)
{
  const double p = 0.83, slope = 0.31;
  for (int order : {1, 2}) {
    const auto cone = [&](double R) { return PlanePoint<double>{R, slope * R}; };
    ContactScene scene(curve(order, breaks(6, 2, 10, 0.7, 3), cone),
                       curve(order, breaks(9, 2, 10, 0.7, 4), cone), {.order = order});
    const Vector3<double> n = Vector3<double>(slope, 0, -1).normalized();
    for (auto &lambda : scene.state.multiplier) lambda = -p * n;
    const auto out = assemble(scene, pairs_of_scene(scene), mixed, false);
    const auto master = nodal_areas(scene.geometry.master, order);
    const double stretch = std::hypot(1, slope);
    for (int m = 0; m < scene.master_nodes(); ++m)
      EXPECT_LT((out.residual.segment<3>(3 * (scene.slave_nodes() + m)) + p * stretch * master[m] * n).norm(),
                1e-12);
  }
}

/// Both plates turn together by any rate, one of them partly through its specimen's twist rate.
TEST(CurveContact, CommonRotationIsNoSliding)
{
  for (int order : {1, 2})
    for (double rate : {0.013, 71.0}) {
      ContactScene scene = wavy(order, 0, 12.5, 2);
      auto &slave = scene.state.slave, &master = scene.state.master;
      const double L = scene.geometry.twist_length;
      for (auto *surface : {&slave, &master})
        for (auto &v : surface->rate) v = Vector3<double>::Zero();
      slave.travel_rate = master.travel_rate = 0;
      slave.rotation_rate = master.rotation_rate = rate;
      CurveContact contact(scene.geometry);
      contact.update(scene.state, pairs_of_scene(scene), false);
      for (int a = 0; a < scene.slave_nodes(); ++a)
        if (scene.geometry.nodes[a].carries) {
          EXPECT_EQ(contact.result(a, mixed).velocity.norm(), 0);
        }
      slave.rotation_rate = 0.37 * rate;
      for (auto &v : slave.rate) v[1] = 0.8 * rate * L;
      for (auto &v : master.rate) v[1] = 0.17 * rate * L;
      for (auto &w : slave.u) w[1] = 4711 * L; // many turns
      contact.update(scene.state, pairs_of_scene(scene), false);
      for (int a = 0; a < scene.slave_nodes(); ++a)
        if (scene.geometry.nodes[a].carries) {
          EXPECT_LT(contact.result(a, mixed).velocity.norm(), 1e-14 * rate * 10);
        }
    }
}

/// Whatever the surfaces and tractions are, force along z and torque about it balance.
TEST(CurveContact, ForceAndTorqueBalance)
{
  for (int order : {1, 2})
    for (double master_radius : {12.5, 9.6})
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const ContactScene scene = wavy(order, 0, master_radius, seed);
        const auto out = assemble(scene, pairs_of_scene(scene), mixed, false);
        Vector3<double> sum = Vector3<double>::Zero(), scale = sum;
        for (int k = 0; k < scene.slave_nodes() + scene.master_nodes(); ++k) {
          sum += out.residual.segment<3>(3 * k);
          scale += out.residual.segment<3>(3 * k).cwiseAbs();
        }
        EXPECT_LT(std::abs(sum[1]), 1e-14 * scale[1]); // rows of w: torque over L
        EXPECT_LT(std::abs(sum[2]), 1e-14 * scale[2]);
        CurveContact contact(scene.geometry);
        contact.update(scene.state, pairs_of_scene(scene), false);
        double force = 0, torque = 0;
        for (int a = 0; a < scene.slave_nodes(); ++a) {
          const auto [F, T] = contact.resultant(a);
          force += F, torque += T;
          if (!scene.geometry.nodes[a].carries) continue;
          force += out.residual[3 * a + 2];
          torque += out.residual[3 * a + 1] * scene.geometry.twist_length;
        }
        EXPECT_NEAR(force, 0, 1e-12);
        EXPECT_NEAR(torque, 0, 1e-12);
      }
}

/// Torque of the operator when the nodes slide at omega r under p: every node's traction solves its
/// condition.
double sliding_torque(int order, int facets, double inner, double outer, const Law &law, double p,
                      double omega)
{
  ContactScene scene(flat(order, breaks(facets, inner, outer, 0.3, 5), 0),
                     flat(order, breaks(facets + 3, inner, outer), 0),
                     {.order = order, .twist_length = 7.3, .softer_modulus = 1.7});
  scene.state.slave.rotation_rate = 0.4 * omega;
  scene.state.master.rotation_rate = -0.6 * omega;
  for (int a = 0; a < scene.slave_nodes(); ++a) {
    const double v = omega * scene.geometry.slave.X[a].r;
    scene.state.multiplier[a] = {0, v == 0 ? 0 : -law.coefficient(v, p) * p, p};
  }
  CurveContact contact(scene.geometry);
  EXPECT_EQ(contact.update(scene.state, pairs_of_scene(scene), false).status, MortarStatus::ok);
  NodeBlock block;
  double torque = 0;
  for (int a = 0; a < scene.slave_nodes(); ++a) {
    if (!scene.geometry.nodes[a].carries) continue;
    contact.node(a, law, block);
    EXPECT_LT(block.residual.tail<3>().norm(), 1e-12);
    EXPECT_EQ(block.status, scene.geometry.nodes[a].on_axis ? ContactStatus::stick : ContactStatus::slip);
    torque -= contact.resultant(a).second;
  }
  return torque;
}

/// T = 2 pi p sum b_m omega^m (R_o^(m+3) - R_i^(m+3)) / (m + 3).
TEST(CurveContact, TorqueUnderUniformPressureConverges)
{
  const double p = 0.83, omega = 0.21;
  const Law law{{0.3, 0.21, 0.13, 0.08}, {0, 1, 2, 2.5}};
  for (double inner : {0.0, 3.0}) {
    double exact = 0;
    for (int i = 0; i < 4; ++i) {
      const double m = law.exponents[i];
      exact += 2 * pi * p * law.coefficients[i] * std::pow(omega, m) *
               (std::pow(10, m + 3) - std::pow(inner, m + 3)) / (m + 3);
    }
    for (int order : {1, 2}) {
      double last = 0, error = 0, rate = 0;
      for (int facets : {8, 16, 32, 64}) {
        error = std::abs(sliding_torque(order, facets, inner, 10, law, p, omega) / exact - 1);
        if (last > 0) rate = std::log2(last / error);
        last = error;
      }
      EXPECT_GT(rate, order == 1 ? 1.9 : 3.5);
      EXPECT_LT(error, order == 1 ? 3e-4 : 2e-7);
      RecordProperty("rate_" + std::to_string(order) + (inner > 0 ? "_ring" : "_disc"), std::to_string(rate));
      RecordProperty("error_" + std::to_string(order) + (inner > 0 ? "_ring" : "_disc"),
                     std::to_string(error * 1e9));
    }
  }
  // exact for a constant coefficient (order 1) and for one linear in v (order 2)
  EXPECT_NEAR(sliding_torque(1, 5, 0, 10, {{0.3}, {0}}, p, omega) / (2 * pi * p * 0.3 * 1000 / 3), 1, 1e-14);
  EXPECT_NEAR(sliding_torque(2, 5, 0, 10, {{0.21}, {1}}, p, omega) / (2 * pi * p * 0.21 * omega * 1e4 / 4), 1,
              1e-14);
}

struct Case {
  const char *name;
  double inner_radius, master_radius, travel, speed; // speed scales all rates
  Law law;
};

/// The Jacobian in every state: exact derivative of the generic residual to 1e-12, differences to 1e-8.
TEST(CurveContact, JacobianIsExactInEveryState)
{
  const Case cases[] = {{"open", 0, 12.5, 2.3, 1, mixed},
                        {"stick", 0, 12.5, -0.1, 0.02, {{5.0}, {0}}},
                        {"slip", 0, 12.5, -0.1, 3, {{0.02, 0.05, 0.01}, {0, 1, 2.5}}},
                        {"viscous", 0, 12.5, -0.1, 1, {{0.4}, {1}}},
                        {"frictionless", 0, 12.5, -0.1, 1, {}},
                        {"square root", 0, 12.5, -0.1, 1, {{0.3}, {0.5}}},
                        {"square root from rest", 0, 12.5, -0.1, 1e-9, {{0.3}, {0.5}}},
                        {"all exponents", 0, 12.5, 0.7, 1, {{0.03, 0.05, 0.01, 0.02}, {0, 0.3, 1, 2.5}}},
                        {"pressure exponent", 0, 12.5, -0.1, 1, {{0.03, 0.05}, {0, 1}, 0.4, 0.3}},
                        {"Kagata", 0, 9.6, 0.2, 1, {{0.2}, {0.5}, 0.5, 1e-3}},
                        {"adhesion", 0, 12.5, -0.1, 1, {{0.2, 0.1}, {0, 0.7}, 0, 0.4}},
                        {"overhang", 0, 9.6, -0.1, 1, mixed},
                        {"ring with overhang", 3, 9.6, 0.2, 1, mixed},
                        {"mixture", 0, 12.5, 0.7, 1, mixed}};
  int seen[3] = {};
  double worst_exact = 0, worst_difference = 0;
  for (int order : {1, 2})
    for (const Case &now : cases)
      for (unsigned seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(std::string(now.name) + ", order " + std::to_string(order) + ", seed " +
                     std::to_string(seed));
        ContactScene scene = wavy(order, now.inner_radius, now.master_radius, seed);
        scene.state.slave.travel = now.travel;
        for (auto *surface : {&scene.state.slave, &scene.state.master}) {
          for (auto &v : surface->rate) v *= now.speed;
          surface->travel_rate *= now.speed, surface->rotation_rate *= now.speed;
        }
        const auto pairs = pairs_of_scene(scene);
        const auto out = assemble(scene, pairs, now.law, true);
        ASSERT_EQ(out.report.status, MortarStatus::ok);
        EXPECT_EQ(out.report.overhang > 0, now.master_radius < 10);
        for (int a = 0; a < scene.slave_nodes(); ++a)
          if (scene.geometry.nodes[a].carries) ++seen[static_cast<int>(out.status[a])];
        // the same sums, but the compiler may contract them differently
        EXPECT_LE((out.residual - whole_residual<double>(scene, scene.state, pairs, now.law)).norm(),
                  1e-14 * out.residual.norm());

        const int n = scene.unknowns();
        for (int j = 0; j < n; ++j) {
          const auto dual = whole_residual(scene, moving(scene, Eigen::VectorXd::Unit(n, j)), pairs, now.law);
          const Eigen::VectorXd column = derivative(dual, 0);
          const double scale = std::max(column.lpNorm<Eigen::Infinity>(), 1e-3);
          worst_exact =
              std::max(worst_exact, (column - out.jacobian.col(j)).lpNorm<Eigen::Infinity>() / scale);
        }

        std::mt19937 random(seed);
        std::uniform_real_distribution<double> number(-1, 1);
        for (int trial = 0; trial < 5; ++trial) {
          Eigen::VectorXd direction = Eigen::VectorXd::NullaryExpr(n, [&] { return number(random); });
          if (now.inner_radius == 0)
            direction[0] = direction[3 * scene.slave_nodes()] = 0; // the axis stays an axis
          const double h = 1e-5;
          const auto moved = [&](double by) {
            ContactScene other = scene;
            const auto target = moving(scene, by * direction);
            const auto move = [](auto &x, const auto &with) {
              for (std::size_t k = 0; k < x.size(); ++k) x[k] += derivative(with[k], 0);
            };
            move(other.state.slave.u, target.slave.u), move(other.state.slave.rate, target.slave.rate);
            move(other.state.master.u, target.master.u), move(other.state.master.rate, target.master.rate);
            move(other.state.multiplier, target.multiplier);
            const auto result = assemble(other, pairs, now.law, false);
            EXPECT_EQ(result.status, out.status);
            return result.residual;
          };
          const Eigen::VectorXd exact = out.jacobian * direction, // against differences of fourth order
              difference = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
          worst_difference = std::max(worst_difference, (difference - exact).norm() / exact.norm());
        }
      }
  EXPECT_LT(worst_exact, 1e-12);
  EXPECT_LT(worst_difference, 1e-8);
  RecordProperty("worst_exact_1e-18", std::to_string(worst_exact * 1e18));
  RecordProperty("worst_difference_1e-15", std::to_string(worst_difference * 1e15));
  for (int count : seen) EXPECT_GT(count, 20); // open, stick, slip have all been there
}

/// Lengths x 2^5, time x 2^2, moduli x 2^-3. Every number scales by its power of two, bit for bit.
TEST(CurveContact, ChangeOfUnitsScalesExactly)
{
  const double length = 32, time = 4, modulus = 0.125, force = modulus * length * length;
  for (int order : {1, 2}) {
    const ContactScene scene = wavy(order, 0, 12.5, 3);
    const Law law{{0.3, 0.21, 0.13}, {0, 1, 2}}, other_law{{0.3, 0.21 / 8, 0.13 / 64}, {0, 1, 2}};
    SurfaceReference slave = scene.geometry.slave, master = scene.geometry.master;
    for (auto *surface : {&slave, &master})
      for (auto &X : surface->X) X = {length * X.r, length * X.z};
    ContactScene other(slave, master,
                       {.order = order, .twist_length = 7.3 * length, .softer_modulus = 1.7 * modulus});
    other.state = scene.state;
    for (auto *surface : {&other.state.slave, &other.state.master}) {
      for (auto &u : surface->u) u *= length;
      for (auto &v : surface->rate) v *= length / time;
      surface->travel *= length, surface->travel_rate *= length / time, surface->rotation_rate /= time;
    }
    for (auto &lambda : other.state.multiplier) lambda *= modulus;
    other.state.shift /= time;
    other.state.stick_rate /= time;
    ASSERT_EQ(pairs_of_scene(scene), pairs_of_scene(other));
    const auto a = assemble(scene, pairs_of_scene(scene), law, true);
    const auto b = assemble(other, pairs_of_scene(other), other_law, true);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.residual * force, b.residual);
    const int displacements = 3 * (scene.slave_nodes() + scene.master_nodes());
    EXPECT_EQ(a.jacobian.leftCols(displacements) * (force / length), b.jacobian.leftCols(displacements));
  }
}

TEST(CurveContact, AnySplitOfTheNodesGivesTheSameBlocks)
{
  for (int order : {1, 2}) {
    const ContactScene scene = wavy(order, 0, 9.6, 3);
    const auto pairs = pairs_of_scene(scene);
    CurveContact whole(scene.geometry);
    const auto report = whole.update(scene.state, pairs, true);
    double overhang = 0;
    for (int first = 0, last; first < scene.slave_nodes(); first = last) {
      last = std::min(first + 3, scene.slave_nodes());
      CurveContact part(scene.geometry);
      overhang += part.update(scene.state, pairs, true, first, last).overhang;
      for (int a = first; a < last; ++a) {
        NodeBlock from_whole, from_part;
        whole.node(a, mixed, from_whole);
        part.node(a, mixed, from_part);
        EXPECT_EQ(from_whole.slave_nodes, from_part.slave_nodes);
        EXPECT_EQ(from_whole.master_nodes, from_part.master_nodes);
        EXPECT_EQ(from_whole.residual, from_part.residual);
        EXPECT_EQ(from_whole.jacobian, from_part.jacobian);
        const NodeBlock pattern = part.pattern(a, pairs);
        EXPECT_EQ(pattern.slave_nodes, from_part.slave_nodes);
        for (int m : from_part.master_nodes)
          EXPECT_NE(std::find(pattern.master_nodes.begin(), pattern.master_nodes.end(), m),
                    pattern.master_nodes.end());
      }
    }
    EXPECT_DOUBLE_EQ(overhang, report.overhang);
  }
}

TEST(CurveContact, NodesWithoutMultiplierAreHeldAtZero)
{
  const auto radii = breaks(4, 0, 10);
  std::vector<bool> carries(9, true);
  carries[8] = false; // glued at the rim
  ContactScene scene(flat(2, radii, 0), flat(2, radii, 0), {.order = 2, .carries_multiplier = carries});
  EXPECT_FALSE(scene.geometry.nodes[0].carries); // the axis node of order 2 never does
  EXPECT_EQ(scene.geometry.nodes[0].D, 0);
  scene.state.multiplier[8] = {0.1, 0.2, 0.3};
  CurveContact contact(scene.geometry);
  contact.update(scene.state, pairs_of_scene(scene), true);
  for (int a : {0, 8}) {
    NodeBlock block;
    contact.node(a, mixed, block);
    EXPECT_TRUE(block.master_nodes.empty());
    EXPECT_EQ(block.residual.head<3>().norm(), 0);
    EXPECT_EQ(Vector3<double>(block.residual.tail<3>()),
              scene.geometry.nodes[a].extent * scene.state.multiplier[a]);
    EXPECT_GT(block.jacobian(3, 3), 0);
    EXPECT_TRUE(std::isnan(contact.result(a, mixed).pressure));
    EXPECT_EQ(contact.resultant(a), std::pair(0.0, 0.0));
  }
}

TEST(CurveContact, CauchyPressureFollowsTheCurrentArea)
{
  for (int order : {1, 2}) {
    ContactScene scene(flat(order, breaks(6, 0, 10, 0.7, 3), 0), flat(order, breaks(9, 0, 12.5), 0),
                       {.order = order});
    const double p = 0.83, stretch = 1.13;
    for (int a = 0; a < scene.slave_nodes(); ++a) {
      scene.state.slave.u[a][0] = (stretch - 1) * scene.geometry.slave.X[a].r;
      scene.state.multiplier[a] = {0.02, 0.03, p};
    }
    CurveContact contact(scene.geometry);
    contact.update(scene.state, pairs_of_scene(scene), false);
    for (int a = 0; a < scene.slave_nodes(); ++a) {
      if (!scene.geometry.nodes[a].carries) continue;
      const NodeResult result = contact.result(a, mixed);
      EXPECT_NEAR(result.pressure, p / (stretch * stretch), 1e-14);
      EXPECT_NEAR(result.cauchy[1], 0.03 / (stretch * stretch), 1e-15);
      EXPECT_EQ(result.nominal[2], p);
      EXPECT_NEAR(result.gap, 0, 1e-14);
    }
  }
}

/// At t = 0 the surfaces just touch, nothing moves, no traction: closed, and every condition row is alive.
TEST(CurveContact, TheFirstStateHasARegularConditionBlock)
{
  for (int order : {1, 2}) {
    ContactScene scene(flat(order, breaks(6, 0, 10), 0), flat(order, breaks(9, 0, 12.5), 0),
                       {.order = order});
    const auto out = assemble(scene, pairs_of_scene(scene), mixed, true);
    EXPECT_EQ(out.residual.norm(), 0);
    EXPECT_TRUE(out.jacobian.allFinite());
    const Eigen::MatrixXd conditions = out.jacobian.bottomRows(3 * scene.slave_nodes());
    EXPECT_EQ(conditions.fullPivLu().rank(), conditions.rows());
  }
}

TEST(CurveContact, ReportsWhereItFails)
{
  ContactScene scene = wavy(1, 0, 12.5, 3);
  scene.state.slave.u[4][0] = -3; // behind its inner neighbour
  CurveContact contact(scene.geometry);
  const auto report = contact.update(scene.state, pairs_of_scene(scene), false);
  EXPECT_NE(report.status, MortarStatus::ok);
  EXPECT_GE(report.failed.front(), 2);
  EXPECT_LE(report.failed.front(), 5);
}

} // namespace
} // namespace tribogel
