/// Two equal rings on lubricated plates: uniform pressure as under discs (a ring of inner radius A and
/// outer radius R keeps A/R and presses by the same scalar equation), and in steady rotation the difference
/// of two integrals of uniform pressure (test_uniform_pressure.cpp),
///
///     T/N = 2 sum_m b_m omega^m (R^(m+3) - A^(m+3))/((m+3) (R^2 - A^2)),    N = p pi (R^2 - A^2).
///
/// The inner side is a wall and not the axis: the inner end of a contact curve is an edge like the outer one.
#include "outlines.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "uniform_compression.hpp"

namespace tribogel::test
{

namespace
{

constexpr double A = 4, R = 10, omega = 0.3;
const std::vector<double> exponents{0, 1, 2};

/// Relative error of T, of a law with b_0, b_1, b_2.
double torque_error(int order, int elements, const std::vector<double> &b)
{
  const double compression = 0.03;
  const UniaxialState state = uniaxial_state(hyperelastic_gel().equilibrium, 1 - compression);
  Scene scene = lubricated_discs(R / state.lateral, 4.4, 4, order);
  scene.friction = PolynomialFriction<double>{b, exponents};
  scene.plate_contact = false;
  const double approach = compression * (scene.top.height + scene.bottom.height);
  scene.schedule = schedule_from_rates({2.5, 12.5}, {approach, approach}, {0, omega});
  scene.mesh.elements_radial = elements;
  std::vector<MeridianBlock> rings = meridian_blocks(scene);
  for (MeridianBlock &ring : rings) {
    const double edge = (R - A) / state.lateral / (ring.body == top_body ? elements : elements + 1);
    ring.R = equal_points(A / state.lateral, scene.top.radius, edge);
    ring.inner = Side::wall;
  }
  const SolverOptions options(fixed_steps(1.25, 1e-11));
  Problem problem;
  Recorder recorder("");
  run(scene, rings, problem, recorder);
  const Measurement &m = recorder.rows.back().measurement;
  const double face = std::numbers::pi * (R * R - A * A);
  EXPECT_NEAR(m.normal_force / (state.pressure * face), 1, 1e-7);
  EXPECT_NEAR(m.contact_force / m.normal_force, 1, 1e-9);
  EXPECT_NEAR(m.contact_torque / m.torque, 1, 1e-7);
  double exact = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    exact += 2 * b[k] * std::pow(omega, exponents[k]) *
             (std::pow(R, exponents[k] + 3) - std::pow(A, exponents[k] + 3)) /
             ((exponents[k] + 3) * (R * R - A * A));
  const double error = m.torque / m.normal_force / exact - 1;
  std::printf("order %d elements %2d b = (%g, %g, %g): error of T %.2e\n", order, elements, b[0], b[1], b[2],
              error);
  return error;
}

} // namespace

TEST(ring, TorqueIsTheDifferenceOfTwoIntegrals)
{
  const std::vector<double> coulomb{3.1e-4, 0, 0}, linear{0, 2e-4, 0}, quadratic{2.6e-4, 0, 1e-5};
  for (int order : {1, 2}) {
    EXPECT_LT(std::abs(torque_error(order, 3, coulomb)), 1e-7);
    for (const auto *b : {&linear, &quadratic}) {
      if (order == 2 && b == &linear) continue; // exact
      double error[3];
      for (int level = 0; level < 3; ++level) error[level] = std::abs(torque_error(order, 3 << level, *b));
      EXPECT_NEAR(std::log2(error[1] / error[2]), 2 * order, 0.1);
    }
  }
  EXPECT_LT(std::abs(torque_error(2, 3, linear)), 1e-7);
}

} // namespace tribogel::test
