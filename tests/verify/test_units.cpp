/// Change of units through the whole program: lengths, moduli and times are scaled by powers of two,
/// friction coefficients and viscosities accordingly. Newton's method must take the same path and N, T scale
/// as force and moment; a number with a dimension hidden anywhere (a tolerance, a step size, a
/// regularisation) breaks it.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tribogel::test
{

namespace
{

struct Units {
  double length, modulus, time; ///< new numbers per old ones

  double force() const { return modulus * length * length; }
};

void convert(Ogden<double> &law, const Units &unit)
{
  for (double &G : law.moduli) G *= unit.modulus;
  law.bulk_modulus *= unit.modulus;
}

void convert(Specimen &specimen, const Units &unit)
{
  specimen.radius *= unit.length;
  specimen.height *= unit.length;
  convert(specimen.material.equilibrium, unit);
  for (auto &branch : specimen.material.branches) {
    convert(branch.spring, unit);
    branch.deviatoric_viscosity *= unit.modulus * unit.time;
    branch.volumetric_viscosity *= unit.modulus * unit.time;
  }
}

Scene converted(Scene scene, const Units &unit)
{
  convert(scene.top, unit);
  convert(scene.bottom, unit);
  scene.initial_gap *= unit.length;
  LawValues law = scene.friction.law()->values(); // coefficients and exponents of a polynomial
  for (std::size_t i = 0; i < law[0].size(); ++i) law[0][i] *= std::pow(unit.time / unit.length, law[1][i]);
  scene.friction = PolynomialFriction<double>{law[0], law[1]};
  for (Phase &phase : scene.schedule) {
    phase.start_time *= unit.time;
    phase.end_time *= unit.time;
    phase.start_approach *= unit.length;
    phase.end_approach *= unit.length;
    phase.rate /= unit.time;
  }
  return scene;
}

Scene scene_of(const PolynomialFriction<double> &friction)
{
  Scene scene = paper_scene(4);
  scene.friction = friction;
  scene.initial_gap = 0.11;
  scene.schedule = schedule_from_rates({27, 120, 260, 400}, {0.7, 0.7, 0.7, 0.7}, {0, 0, 0.03, 0.4});
  return scene;
}

/// `dt` 0: adaptive steps.
void expect_same(const PolynomialFriction<double> &friction, const Units &unit, double dt)
{
  Recorder old_rows(""), new_rows("");
  const Scene scene = scene_of(friction);
  for (const bool in_new : {false, true}) {
    // The smaller the error that is allowed, the more of it is round-off, and the steps follow that.
    const OptionList given = dt > 0 ? fixed_steps(dt * (in_new ? unit.time : 1), 1e-9)
                                    : OptionList{{"-ts_atol", "1e-2"}, {"-snes_rtol", "1e-12"}};
    const SolverOptions options(given);
    Problem problem;
    run(in_new ? converted(scene, unit) : scene, problem, in_new ? new_rows : old_rows);
  }
  ASSERT_EQ(old_rows.rows.size(), new_rows.rows.size());
  const Measurement &end = old_rows.rows.back().measurement;
  ASSERT_GT(end.torque, 0);
  // Adaptive steps pass the solver's round-off on through the error estimate.
  const double tolerance = dt > 0 ? 1e-10 : 1e-8;
  double force = 0, torque = 0;
  int iterations = 0;
  for (std::size_t k = 0; k < old_rows.rows.size(); ++k) {
    const HistoryRow &a = old_rows.rows[k], &b = new_rows.rows[k];
    EXPECT_NEAR(b.time, a.time * unit.time, tolerance * b.time);
    force = std::max(force, std::abs(b.measurement.normal_force / unit.force() - a.measurement.normal_force));
    torque = std::max(torque,
                      std::abs(b.measurement.torque / (unit.force() * unit.length) - a.measurement.torque));
    iterations = std::max(
        iterations, std::abs(static_cast<int>(a.report.newton_iterations - b.report.newton_iterations)));
  }
  EXPECT_LE(iterations, 1);
  EXPECT_LE(force, tolerance * end.normal_force);
  EXPECT_LE(torque, tolerance * end.torque);
}

const PolynomialFriction<double> viscous{{8e-4}, {1}}, coulomb{{2.6e-4, 1e-5}, {0, 2}};
const Units larger{0x1p7, 0x1p-9, 0x1p5}, smaller{0x1p-10, 0x1p20, 0x1p-6};

} // namespace

TEST(units, FixedSteps)
{
  for (const Units &unit : {larger, smaller}) {
    expect_same(viscous, unit, 9.5);
    expect_same(coulomb, unit, 9.5);
  }
}

TEST(units, AdaptiveStepsViscous)
{
  expect_same(viscous, larger, 0);
}

TEST(units, AdaptiveStepsCoulomb)
{
  expect_same(coulomb, smaller, 0);
}

} // namespace tribogel::test
