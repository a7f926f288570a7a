/// Energy of one gel between its plates without contact: work of the plates = stored + dissipated. The
/// work is the trapezoidal sum of N d(approach) + T d(rotation) over the steps. A hyperelastic gel errs by
/// the quadrature alone, second order in dt; a viscoelastic one by the time rule, first order or second.
#include "bulk_scenes.hpp"

namespace tribogel::test
{

namespace
{

struct Balance {
  double work, stored, dissipated;

  double imbalance() const { return (work - stored - dissipated) / work; }
};

/// Compressed by 8 %, held, turned by 0.6 rad and held.
Balance balance(const Viscoelastic<double> &material, double dt, TimeRule rule = TimeRule::exponential_euler)
{
  Scene scene = cylinder(4.5, 3, material, 2, 3);
  scene.schedule = schedule_from_twists({1, 2, 3, 4}, {0.24, 0.24, 0.24, 0.24}, {0, 0, 0.6, 0.6});
  scene.time.rule = rule;
  const SolverOptions options(fixed_steps(dt, 1e-13));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  EXPECT_EQ(recorder.rows.size(), static_cast<std::size_t>(1 + std::lround(4 / dt)))
      << "a step was cut, the order cannot be measured";
  Balance sum{0, problem.stepper.state.stored, problem.stepper.state.dissipated};
  for (std::size_t n = 1; n < recorder.rows.size(); ++n) {
    const HistoryRow &now = recorder.rows[n], &last = recorder.rows[n - 1];
    sum.work += 0.5 * (now.measurement.normal_force + last.measurement.normal_force) *
                    (now.approach - last.approach) +
                0.5 * (now.measurement.torque + last.measurement.torque) * (now.rotation - last.rotation);
  }
  std::printf("dt %.5f: work %.6f stored %.6f dissipated %.6f imbalance %.3e\n", dt, sum.work, sum.stored,
              sum.dissipated, sum.imbalance());
  return sum;
}

} // namespace

TEST(bulk_energy, OfAHyperelasticGelIsConservedToSecondOrder)
{
  double before = 0;
  for (double dt : {0.125, 0.0625, 0.03125}) {
    const Balance b = balance(hyperelastic_gel(), dt);
    EXPECT_EQ(b.dissipated, 0);
    if (before != 0) {
      EXPECT_NEAR(before / b.imbalance(), 4, 0.1);
    }
    before = b.imbalance();
  }
  EXPECT_LT(std::abs(before), 1e-3);
}

TEST(bulk_energy, OfAViscoelasticGelIsConservedToFirstOrder)
{
  double before = 0;
  for (double dt : {0.0625, 0.03125, 0.015625}) {
    const Balance b = balance(viscoelastic_gel(), dt);
    EXPECT_GT(b.dissipated, 0.05 * b.work);
    if (before != 0) {
      EXPECT_NEAR(before / b.imbalance(), 2, 0.06);
    }
    before = b.imbalance();
  }
  EXPECT_LT(std::abs(before), 0.02);
}

TEST(bulk_energy, OfAViscoelasticGelIsConservedToSecondOrderWithSdirk2)
{
  double before = 0;
  for (double dt : {0.0625, 0.03125, 0.015625}) {
    const Balance b = balance(viscoelastic_gel(), dt, TimeRule::sdirk2);
    if (before != 0) {
      EXPECT_GT(std::abs(before / b.imbalance()), 3.5);
    }
    before = b.imbalance();
  }
  EXPECT_LT(std::abs(before), 1e-3);
}

} // namespace tribogel::test
