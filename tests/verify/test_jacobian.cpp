/// The assembled matrix dF/dU + shift dF/dUdot (bulk with history, contact open, sticking, slipping and over
/// the master's edge, friction, plates in motion) against five-point central differences of the assembled
/// residual F(t, U, shift (U - U_n)), along random directions, a column group at a time (three displacement,
/// three traction components). States are random perturbations of solved ones with random tractions: a solved
/// state hides terms that vanish there. Each row i is held against sum_j |J_ij w_j|, so that rows of small
/// weight (the axis) count like others. Tolerance: 1e-8 relative, plus the round-off of the difference
/// itself, (64 eps x sum of absolute forces + 16 x round-off of the unloaded body) / h.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/rate_and_state.hpp"
#include "wall_scenes.hpp"

#include <limits>

namespace tribogel::test
{

namespace
{

constexpr double relative_tolerance = 1e-8;

struct Case {
  int order;
  double bottom_radius, gap;
  std::vector<double> coefficients, exponents;
  double traction; ///< largest random traction [MPa]
  bool wanted[3];  ///< open, stick, slip must occur
  double pressure_exponent = 1;
  Friction other = {}; ///< in place of the polynomial law
};

Scene scene_of(const Case &c)
{
  Scene scene = paper_scene(c.order == 1 ? 8 : 5, c.order); // as many nodes
  scene.bottom.radius = c.bottom_radius;
  scene.bottom.material = hyperelastic_gel(); // history on one side of the contact only
  scene.top.material.branches[0].deviatoric_viscosity = 2.7;
  scene.initial_gap = c.gap;
  scene.friction = PolynomialFriction<double>{c.coefficients, c.exponents, c.pressure_exponent,
                                              0.3}; // pressures on both sides of the floor
  if (c.other.law()) scene.friction = c.other;
  scene.schedule = schedule_from_rates({2.3, 4.1}, {0.31, 0.37}, {0.013, 0.17});
  scene.bottom_plate_rate = 0.021;
  scene.mesh.grading = 2;
  // Where nodes of the two surfaces meet, the mortar integrals have a kink in their slope and differences a
  // larger error.
  scene.mesh.bottom_elements_radial = scene.mesh.elements_radial + 1;
  return scene;
}

/// Random displacements of a fraction of the element size, random tractions.
Values perturbed(const Probe &probe, double traction, std::mt19937 &random)
{
  std::uniform_real_distribution<double> in(-1, 1);
  Values U = probe.committed();
  for (std::size_t k = 0; k < U.size(); ++k)
    U[k] += (probe.problem.system.rows.group[k] < 3 ? 0.011 : traction) * in(random);
  return U;
}

/// Largest relative error of each row group over the directions.
std::array<double, residual_groups> errors(Probe &probe, const Values &U, std::mt19937 &random)
{
  constexpr double h = 3e-5; // mm or MPa
  const Values floor = Probe::values(probe.problem.system.rows.round_off);
  const std::vector<Values> J = probe.jacobian(U);
  const auto &group = probe.problem.system.rows.group;
  Values size;
  probe.residual(U, &size);
  std::array<double, residual_groups> worst{};
  std::uniform_real_distribution<double> in(-1, 1);
  for (int column_group = 0; column_group < residual_groups; ++column_group)
    for (int repeat = 0; repeat < 3; ++repeat) {
      Values w(U.size(), 0.0), slope(U.size(), 0.0);
      for (std::size_t k = 0; k < U.size(); ++k)
        if (group[k] == column_group) w[k] = in(random);
      for (const auto &[at, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
        Values moved = U;
        for (std::size_t k = 0; k < U.size(); ++k) moved[k] += at * h * w[k];
        const Values F = probe.residual(moved);
        for (std::size_t k = 0; k < U.size(); ++k) slope[k] += weight * F[k] / (12 * h);
      }
      for (std::size_t i = 0; i < U.size(); ++i) {
        double product = 0, scale = 0;
        for (std::size_t j = 0; j < U.size(); ++j) {
          product += J[i][j] * w[j];
          scale += std::abs(J[i][j] * w[j]);
        }
        const double noise = (64 * std::numeric_limits<double>::epsilon() * size[i] + 16 * floor[i]) / h;
        const double error = std::max(std::abs(product - slope[i]) - noise, 0.0);
        double &largest = worst[static_cast<std::size_t>(group[i])];
        largest = std::max(largest, error == 0 ? 0 : error / scale);
      }
    }
  return worst;
}

void check_matrix(Probe &probe, const Values &U, std::mt19937 &random)
{
  const auto worst = errors(probe, U, random);
  for (int g = 0; g < residual_groups; ++g) {
    EXPECT_LE(worst[g], relative_tolerance)
        << group_names(probe.problem.system.mesh.dim)[g] << ", order " << probe.problem.system.mesh.order;
  }
}

void check(const Case &c, double step, Arrangement arrangement = Arrangement::gel_on_gel)
{
  Problem problem;
  Recorder recorder("");
  const SolverOptions equal_steps({{"-ts_adapt_type", "none"}, {"-ts_dt", "0.5"}});
  Scene scene = scene_of(c);
  scene.arrangement = arrangement;
  run(scene, problem, recorder);
  Probe probe(problem, step);
  std::mt19937 random(20);
  const Values U = perturbed(probe, c.traction, random);
  check_matrix(probe, U, random);
  probe.residual(U);
  const auto count = probe.statuses();
  for (std::size_t s = 0; s < 3; ++s) EXPECT_GE(count[s], c.wanted[s] ? 1 : 0) << "status " << s;
}

} // namespace

class jacobian : public ::testing::TestWithParam<int>
{
};

TEST_P(jacobian, OfOpenGels)
{
  check({GetParam(), 12.5, 0.9, {0.23, 0.07}, {0, 1}, 0.013, {true, false, false}}, 0.37);
}

TEST_P(jacobian, OfViscousFriction)
{
  check({GetParam(), 12.5, 0.03, {0, 0.07, 0.011}, {0, 1, 2}, 1.3, {true, false, true}}, 0.37);
}

TEST_P(jacobian, OfOpenStickingAndSlippingNodes)
{
  check({GetParam(), 12.5, 0.03, {0.83, 0.07}, {0, 1}, 1.3, {true, true, true}}, 0.37);
}

TEST_P(jacobian, OfALongStep)
{
  check({GetParam(), 12.5, 0.03, {0.83, 0.07}, {0, 1}, 1.9, {true, false, true}}, 23);
}

TEST_P(jacobian, OfAFaceThatHangsOverTheEdge)
{
  check({GetParam(), 9.7, 0.03, {0.83, 0.07}, {0, 1}, 1.5, {true, true, true}}, 0.37);
}

TEST_P(jacobian, OfASquareRootLaw)
{
  check({GetParam(), 12.5, 0.03, {0.3}, {0.5}, 1.3, {true, false, true}}, 0.37);
}

TEST_P(jacobian, OfExponentsBelowAndAboveOne)
{
  check({GetParam(), 12.5, 0.03, {0.83, 0.3, 0.07, 0.011}, {0, 0.5, 1, 2}, 1.3, {true, true, true}}, 0.37);
}

TEST_P(jacobian, OfAPressureExponent)
{
  check({GetParam(), 12.5, 0.03, {0.83, 0.07}, {0, 1}, 1.3, {true, true, true}, 0.4}, 0.37);
}

TEST_P(jacobian, OfKagatasLawOverTheEdge)
{
  check({GetParam(), 9.7, 0.03, {0.3}, {0.7}, 1.3, {true, false, true}, 0.5}, 0.37);
}

/// What it remembers depends on the speed in the solve at hand; long solves weaken.
TEST_P(jacobian, OfALawWithMemory)
{
  RateAndStateFriction<double> law;
  law.set({{0.5}, {0.17}, {0.21}, {0.11}, {0.3}, {0.7}});
  check({GetParam(), 12.5, 0.03, {}, {}, 1.3, {true, false, true}, 1, law}, 0.37);
  check({GetParam(), 12.5, 0.03, {}, {}, 1.9, {true, false, true}, 1, law}, 23);
}

TEST_P(jacobian, OfWallsThatTouchTheirPlateAndRollOntoTheOtherGel)
{
  Problem problem;
  Recorder recorder("");
  run(mushroom(GetParam()), problem, recorder);
  Probe probe(problem, 0.37);
  std::mt19937 random(20);
  std::uniform_real_distribution<double> in(-1, 1);
  Values U = probe.committed(); // near the state: the wall must keep lying on the other gel
  for (std::size_t k = 0; k < U.size(); ++k)
    U[k] += (problem.system.rows.group[k] < 3 ? 1e-4 : 0.1) * in(random);
  check_matrix(probe, U, random);
  const auto rolled =
      std::count_if(recorder.last_profile.begin(), recorder.last_profile.end(), [](const auto &row) {
        return std::string(row.surface) == "top" && row.reference_z > 0 && row.pressure > 0;
      });
  EXPECT_GE(rolled, 2);
}

TEST_P(jacobian, OfAGelOnARigidPlane)
{
  check({GetParam(), 12.5, 0.2, {0.83, 0.07}, {0, 1}, 1.3, {true, true, true}, 0.4}, 0.37,
        Arrangement::gel_on_rigid);
}

INSTANTIATE_TEST_SUITE_P(order, jacobian, ::testing::Values(1, 2));

/// The bulk has an incremental potential: its part of the matrix is symmetric, with mean dilatation and
/// history.
TEST(jacobian_bulk, IsSymmetric)
{
  for (int order : {1, 2}) {
    Problem problem;
    Recorder recorder("");
    run(scene_of({order, 12.5, 0.9, {0.23}, {0}, 0, {}}), problem, recorder);
    Probe probe(problem, 0.37);
    std::mt19937 random(7);
    const auto J = probe.jacobian(perturbed(probe, 0, random));
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < J.size(); ++i)
      for (std::size_t j = 0; j < J.size(); ++j) {
        if (problem.system.rows.group[i] > 2 || problem.system.rows.group[j] > 2) continue;
        largest = std::max(largest, std::abs(J[i][j]));
        difference = std::max(difference, std::abs(J[i][j] - J[j][i]));
      }
    EXPECT_GT(largest, 1);
    EXPECT_LE(difference, 1e-12 * largest) << "order " << order;
  }
}

} // namespace tribogel::test
