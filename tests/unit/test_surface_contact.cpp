// The contact operator in space: mortar integrals, balance, frames, Jacobian.
#include "solid_scene.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

using namespace tribogel;

namespace
{

const PolynomialFriction<double> viscous{{0.3, 0.2}, {0, 1}, 1};

/// int N_m over each node of a flat surface.
Eigen::VectorXd nodal_areas(const QuadReference &surface, int order)
{
  Eigen::VectorXd area = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(surface.X.size()));
  const auto add = [&]<int k>() {
    for (const auto &facet : surface.facets) {
      QuadPoints<k> X;
      for (std::size_t a = 0; a < X.size(); ++a) X[a] = surface.X[facet[a]];
      const auto measure = quad_measure<k>(X);
      for (std::size_t a = 0; a < X.size(); ++a) area[facet[a]] += measure.basis.D[a];
    }
  };
  order == 1 ? add.operator()<1>() : add.operator()<2>();
  return area;
}

/// Along z on each master node.
Eigen::VectorXd axial_forces(const SurfaceContact &contact, const SolidScene &scene)
{
  Eigen::VectorXd force = Eigen::VectorXd::Zero(scene.masters());
  for (int a = 0; a < scene.slaves(); ++a) {
    NodeBlock block;
    contact.node(a, viscous, block);
    for (std::size_t k = 0; k < block.master_nodes.size(); ++k)
      force[block.master_nodes[k]] += block.residual[3 + 3 * static_cast<Eigen::Index>(k) + 2];
  }
  return force;
}

TEST(SurfaceContact, RowSumsOfTheMortarMatrixAreItsDiagonal)
{
  for (const auto &[order, exact_cells] : {std::pair{1, true}, {1, false}, {2, true}, {2, false}}) {
    SolidScene scene = general_solid_scene(order, 1, 7, exact_cells);
    SurfaceContact contact(scene.geometry);
    const auto pairs = contact.candidate_pairs(scene.state, 0);
    ASSERT_EQ(contact.update(scene.state, pairs, false).status, MortarStatus::ok) << order;
    for (int a = 0; a < scene.slaves(); ++a) {
      NodeBlock block;
      contact.node(a, viscous, block);
      Vector3<double> sum = Vector3<double>::Zero();
      for (std::size_t k = 0; k < block.master_nodes.size(); ++k) sum += block.residual.segment<3>(3 + 3 * k);
      EXPECT_NEAR(sum.norm(), block.residual.head<3>().norm(), 1e-13) << order << ' ' << a;
    }
  }
}

/// Uniform pressure on non-matching rectangles, one turned against the other, is what the master's shape
/// functions make of a uniform pressure.
TEST(SurfaceContact, UniformPressurePassesThePatchTest)
{
  for (int order : {1, 2})
    for (const double turn : {0.0, 0.3}) {
      const auto flat = [](double x, double y) { return Vector3<double>(x, y, 0); };
      SolidScene scene(quad_grid(5, 7, 4, 4.2, order, false, flat),
                       quad_grid(5, 4, 2, 1.5, order, true, flat), order);
      scene.state.slave.rotation = turn;
      const double p = 0.8; // the smaller surface as master: it is wholly covered, the slave hangs over
      for (auto &lambda : scene.state.multiplier) lambda = {0, 0, p};
      SurfaceContact contact(scene.geometry);
      contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false);
      // The extension beyond the edges carries force too: compare the inner node only, all of whose facets
      // are inside.
      const Eigen::VectorXd force = axial_forces(contact, scene);
      const Eigen::VectorXd area = nodal_areas(scene.geometry.master, order);
      int compared = 0;
      for (int m = 0; m < scene.masters(); ++m) {
        bool inner = true;
        for (const auto &at : scene.geometry.master_surface.neighbours[m])
          for (bool edge : scene.geometry.master_surface.on_edge[at.facet]) inner = inner && !edge;
        if (!inner) continue;
        ++compared;
        EXPECT_NEAR(force[m], p * area[m], 1e-13) << order << ' ' << turn;
      }
      EXPECT_GE(compared, 2);
    }
}

/// Gauss points of the slave do not see the kinks at the master's facet borders: uniform pressure is passed
/// on to a few hundredths of a facet's force, and exactly where facets match.
TEST(SurfaceContact, AtElementsUniformPressureIsExactOnMatchingFacetsOnly)
{
  for (int order : {1, 2})
    for (const bool matching : {true, false}) {
      const auto flat = [](double x, double y) { return Vector3<double>(x, y, 0); };
      const int n = matching ? 4 : 5;
      SolidScene scene(quad_grid(n, n, 2, 2, order, false, flat), quad_grid(4, 4, 2, 2, order, true, flat),
                       order, false);
      for (auto &lambda : scene.state.multiplier) lambda = {0, 0, 1};
      SurfaceContact contact(scene.geometry);
      ASSERT_EQ(contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false).status,
                MortarStatus::ok);
      const Eigen::VectorXd force = axial_forces(contact, scene);
      const Eigen::VectorXd area = nodal_areas(scene.geometry.master, order);
      const double facet = 4.0 / 16, error = (force - area).lpNorm<Eigen::Infinity>() / facet;
      std::printf("order %d, %s facets: largest error of a nodal force %.2g of a facet's\n", order,
                  matching ? "matching" : "5 on 4", error);
      EXPECT_NEAR(force.sum(), 4, 1e-13);
      if (matching)
        EXPECT_LT(error, 1e-12);
      else {
        EXPECT_LT(error, 0.05);
        EXPECT_GT(error, 1e-6);
      }
    }
}

/// The same where the slave lies inside the master: total force, first moments.
TEST(SurfaceContact, ForceAndTorqueBalanceOnAFlatInterface)
{
  for (int order : {1, 2}) {
    const auto flat = [](double x, double y) { return Vector3<double>(x, y, 0); };
    SolidScene scene(quad_grid(2, 3, 1.1, 1.3, order, false, flat),
                     quad_grid(4, 3, 2.6, 2.4, order, true, flat), order);
    scene.state = [&] {
      ContactState<double> state = scene.state;
      state.slave.rotation = 0.7;
      state.slave_axis = {0.1, -0.05};
      for (std::size_t a = 0; a < state.multiplier.size(); ++a)
        state.multiplier[a] = {0.1 * static_cast<double>(a % 3), -0.2 + 0.05 * static_cast<double>(a % 4),
                               1.0};
      return state;
    }();
    SurfaceContact contact(scene.geometry);
    ASSERT_EQ(contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false).status,
              MortarStatus::ok);
    const double c = std::cos(0.7), s = std::sin(0.7);
    Matrix3<double> Q;
    Q << c, -s, 0, s, c, 0, 0, 0, 1;
    const Vector3<double> axis(0.1, -0.05, 0);
    Vector3<double> force = Vector3<double>::Zero(), moment = force;
    double size = 0;
    for (int a = 0; a < scene.slaves(); ++a) {
      NodeBlock block;
      contact.node(a, viscous, block);
      const Vector3<double> f = Q * block.residual.head<3>();
      force += f;
      moment += (Q * scene.geometry.slave.X[a] + axis).cross(f);
      size += f.norm();
      for (std::size_t k = 0; k < block.master_nodes.size(); ++k) {
        const Vector3<double> g = block.residual.segment<3>(3 + 3 * k);
        force += g;
        moment += scene.geometry.master.X[block.master_nodes[k]].cross(g);
      }
    }
    EXPECT_LT(force.norm(), 1e-13 * size);
    EXPECT_LT(moment.norm(), 1e-12 * size);
  }
}

/// On curved surfaces the forces balance to round-off, and what is left of the moment is the gap
/// between the two interpolants of one surface times the traction: it falls as they approach each other.
TEST(SurfaceContact, TorqueBalanceOnCurvedFacetsFallsWithTheFacets)
{
  const auto wavy = [](double x, double y) {
    return Vector3<double>(x, y, 0.15 * std::cos(1.1 * x + 0.3) * std::cos(0.9 * y - 0.2));
  };
  for (int order : {1, 2}) {
    double before = 0;
    for (const int n : {2, 4, 8}) {
      SolidScene scene(quad_grid(n, n, 1.1, 1.3, order, false, wavy),
                       quad_grid(2 * n + 1, 2 * n + 1, 2.6, 2.4, order, true, wavy), order);
      for (int a = 0; a < scene.slaves(); ++a) {
        const Vector3<double> &X = scene.geometry.slave.X[a];
        scene.state.multiplier[a] = {0.3 * X[1], -0.2 + 0.1 * X[0], 1.0 - X[0] * X[0]};
      }
      SurfaceContact contact(scene.geometry);
      ASSERT_EQ(contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false).status,
                MortarStatus::ok);
      Vector3<double> force = Vector3<double>::Zero(), moments = force;
      double size = 0;
      for (int a = 0; a < scene.slaves(); ++a) {
        NodeBlock block;
        contact.node(a, viscous, block);
        const Vector3<double> f = block.residual.head<3>();
        force += f;
        moments += scene.geometry.slave.X[a].cross(f);
        size += f.norm();
        for (std::size_t k = 0; k < block.master_nodes.size(); ++k) {
          const Vector3<double> g = block.residual.segment<3>(3 + 3 * k);
          force += g;
          moments += scene.geometry.master.X[block.master_nodes[k]].cross(g);
        }
      }
      const double moment = moments.norm();
      std::printf("order %d, %d facets a side: moment %.3e, about z %.3e, of %.3e N mm\n", order, n, moment,
                  moments[2], size);
      EXPECT_LT(force.norm(), 1e-13 * size);
      if (before > 0) {
        EXPECT_GT(before / moment, order == 1 ? 3.5 : 7) << "order " << order << ", " << n;
      }
      before = moment;
    }
    EXPECT_LT(before, order == 1 ? 1e-3 : 1e-5);
  }
}

/// Both plates turn together, any number of times; and turning against each other is omega x r at every
/// node.
TEST(SurfaceContact, CommonRotationIsNoSlidingAndTheRestIsExact)
{
  for (int order : {1, 2}) {
    SolidScene scene = general_solid_scene(order, 1, 3);
    ContactState<double> &state = scene.state;
    for (auto *rates : {&state.slave.rate, &state.master.rate})
      for (auto &v : *rates) v.setZero();
    state.slave.travel_rate = 0;
    state.slave_axis = {0, 0};
    state.slave.rotation = state.master.rotation = 1000.5;
    state.slave.rotation_rate = state.master.rotation_rate = 3;
    SurfaceContact contact(scene.geometry);
    ASSERT_EQ(contact.update(state, contact.candidate_pairs(state, 0), false).status, MortarStatus::ok);
    for (int a = 0; a < scene.slaves(); ++a) EXPECT_EQ(contact.result(a, viscous).velocity.norm(), 0);

    state.slave.rotation_rate = 3.25;
    ASSERT_EQ(contact.update(state, contact.candidate_pairs(state, 0), false).status, MortarStatus::ok);
    for (int a = 0; a < scene.slaves(); ++a) {
      const NodeResult result = contact.result(a, viscous);
      const Vector3<double> x = scene.geometry.slave.X[a] + state.slave.u[a],
                            v = 0.25 * Vector3<double>(-x[1], x[0], 0);
      const double angle = std::atan2(x[1], x[0]), c = std::cos(angle), s = std::sin(angle);
      const Vector3<double> own(c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]); // (r, theta, z)
      EXPECT_LT((result.velocity - own + own.dot(result.normal) * result.normal).norm(), 1e-14);
    }
  }
}

/// Against central differences, with all nodes open, sticking, slipping, and with a mixture.
TEST(SurfaceContact, JacobianIsTheDerivativeInEveryState)
{
  struct Case {
    double load;
    PolynomialFriction<double> law;
  };
  const Case cases[] = {{-2, viscous},   {1, {{50.0}, {0}, 1}},        {1, viscous},
                        {0.05, viscous}, {1, {{0.4, 0.1}, {1, 2}, 1}}, {1, {{0.4, 0.1}, {0, 1}, 0.6, 0.01}}};
  for (const auto &[order, exact_cells] : {std::pair{1, true}, {2, true}, {1, false}, {2, false}})
    for (const Case &c : cases) {
      const Eigen::Index stride = order == 1 ? 1 : 7; // of order 2 a part, in all components
      EXPECT_LT(jacobian_error(general_solid_scene(order, c.load, 11, exact_cells), c.law, stride), 1e-8)
          << "order " << order << ", load " << c.load;
    }
}

/// What the triangles' rule misses does not depend on where the numbering of the master facet begins, so that
/// it does not jump when a corner of a cell leaves the slave facet and another one is the first.
TEST(SurfaceContact, IntegralsDoNotDependOnWhereAFacetBegins)
{
  const auto compare = []<int order>() {
    const SolidScene scene = general_solid_scene(order, 1, 7);
    constexpr int nodes = tensor_nodes<2, order>;
    int compared = 0;
    for (const auto &slave : scene.geometry.slave.facets)
      for (const auto &master : scene.geometry.master.facets) {
        QuadPair<order> pair, turned;
        QuadPoints<order> X;
        for (int a = 0; a < nodes; ++a) {
          const int column = a % (order + 1), row = a / (order + 1);
          X[a] = scene.geometry.slave.X[slave[a]];
          turned.x[a] = pair.x[a] = 1.3 * (X[a] + scene.state.slave.u[slave[a]]);
          turned.n[a] = pair.n[a] = {0.1 * X[a][0], -0.05 * X[a][1], -1};
          pair.y[a] = scene.geometry.master.X[master[a]];
          turned.y[row + (order - column) * (order + 1)] = pair.y[a]; // by a quarter
        }
        const auto measure = quad_measure<order>(X);
        const auto M = quad_pair_mortar<order>(measure, pair, false),
                   other = quad_pair_mortar<order>(measure, turned, false);
        if (M.covered == 0) continue;
        ++compared;
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b) {
            const int column = b % (order + 1), row = b / (order + 1);
            EXPECT_NEAR(M.M(a, b), other.M(a, row + (order - column) * (order + 1)), 1e-14) << order;
          }
      }
    EXPECT_GT(compared, 8);
  };
  compare.operator()<1>();
  compare.operator()<2>();
}

/// Nothing jumps where a facet, from a state in which the lines of both surfaces coincide, begins to grow or
/// to shrink.
TEST(SurfaceContact, NothingJumpsAtTheReferenceState)
{
  const auto shape = [](double x, double y) {
    return Vector3<double>(x + 0.05 * y * y, y + 0.04 * x * y, 0.1 * x * x - 0.05 * x * y);
  };
  for (int order : {1, 2}) {
    const SolidScene rest(quad_grid(2, 2, 1.6, 1.6, order, false, shape),
                          quad_grid(3, 4, 2.4, 3.2, order, true, shape), order);
    const auto at = [&](double t) {
      SolidScene scene = rest;
      for (int a = 0; a < rest.slaves(); ++a) {
        scene.state.slave.u[a] = t * rest.geometry.slave.X[a];
        scene.state.multiplier[a] = {0.2, 0.1 * (a % 3), 1 - 0.1 * (a % 4)};
      }
      return scene.residual(viscous, SurfaceContact(scene.geometry).candidate_pairs(scene.state, 0.3));
    };
    const Eigen::VectorXd smaller = at(-1e-13), larger = at(1e-13);
    const double jump = (larger - smaller).lpNorm<Eigen::Infinity>() / larger.lpNorm<Eigen::Infinity>();
    std::printf("order %d: %.2g of the largest force\n", order, jump);
    EXPECT_LT(jump, 1e-11) << "order " << order;
  }
}

} // namespace
