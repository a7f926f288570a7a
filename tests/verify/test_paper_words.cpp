/// What the paper says in words about its Figs. 5 to 13, as statements. Those about Fig. 8 and the tenfold
/// torque are in test_paper_anchors.cpp.
#include "scenes.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

/// Frictionless, Fig. 6, and the three cases of Table 2.
const PolynomialFriction<double> laws[] = {
    {}, {{8e-4}, {1}}, {{2e-4}, {1}}, {{2.6e-4, 1e-5}, {0, 2}}, {{2.2e-4, 3.26e-5}, {0, 1}}};

/// The steady state at 1 rad/s.
Measurement turning(const PolynomialFriction<double> &law, int refinements)
{
  Problem problem;
  Recorder recorder("");
  Scene scene = paper_scene(6);
  scene.mesh.refinements = refinements;
  scene.friction = law;
  scene.schedule = schedule_from_rates({100}, {0.79}, {1});
  scene.schedule_kind = ScheduleKind::steady;
  run(scene, problem, recorder);
  EXPECT_EQ(recorder.phases.size(), 1u);
  return recorder.phases.empty() ? Measurement{} : recorder.phases.back().measurement;
}

/// A short hold and two rates; 600 s are a hundred relaxation times.
Scene pair(bool viscous_top, bool viscous_bottom)
{
  Scene scene = paper_scene(4);
  scene.top.material = viscous_top ? viscoelastic_gel() : hyperelastic_gel();
  scene.bottom.material = viscous_bottom ? viscoelastic_gel() : hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{0.0015, 1e-5}, {1, 2}};
  scene.schedule = schedule_from_rates({27, 600, 1500, 2400}, {0.79, 0.79, 0.79, 0.79}, {0, 0, 0.1, 1});
  return scene;
}

} // namespace

/// Fig. 10: "the variation of the axial load is not dependent upon the change in the friction coefficient,
/// while the torque is strongly dependent". Friction changes N through the gels' torsion alone, 1e-5 of it;
/// the mesh does more.
TEST(paper_words, NormalForceDoesNotDependOnTheLawWithinItsOwnErrorAndTorqueDoes)
{
  double lowest = INFINITY, highest = 0, least_torque = INFINITY, most_torque = 0;
  for (const PolynomialFriction<double> &law : laws) {
    const Measurement m = turning(law, 0);
    lowest = std::min(lowest, m.normal_force);
    highest = std::max(highest, m.normal_force);
    if (law.exponents.empty()) continue;
    least_torque = std::min(least_torque, m.torque);
    most_torque = std::max(most_torque, m.torque);
  }
  const double error = std::abs(turning(laws[1], 1).normal_force - turning(laws[1], 0).normal_force);
  EXPECT_LT(error, 0.02 * lowest); // else the statement says nothing
  EXPECT_LT(highest - lowest, 0.1 * error);
  EXPECT_GT(most_torque, 5 * least_torque);
}

/// Fig. 7: "(3.11) slightly overestimates the converged weighted values". It does for the weights p dA and
/// that figure's law. It does not for the weights dA, since the contact is wider than the undeformed radius;
/// nor, even for the weights p dA, for case 3 of Table 2.
TEST(paper_words, Equation311OverestimatesThePressureWeightedCoefficientAlone)
{
  const double over_pressure_weighted[] = {1.005, 1.005, 1.008, 0.992},
               over_area_weighted[] = {0.904, 0.904, 0.888, 0.940};
  for (std::size_t k = 0; k < 4; ++k) {
    const Measurement m = turning(laws[k + 1], 1);
    EXPECT_NEAR(m.mu_apparent / m.mu_pressure_weighted, over_pressure_weighted[k], 0.001);
    EXPECT_NEAR(m.mu_apparent / m.mu_area_weighted, over_area_weighted[k], 0.002);
  }
}

/// Figs. 12, 13: "the steady state (long term) values of the torque, normal force and apparent coefficient of
/// friction are independent of the model", which leaves out the relaxation. Fig. 6: "the torque presents step
/// jumps".
TEST(paper_words, LongTermValuesDoNotDependOnTheViscosityAndTorqueJumps)
{
  const bool kinds[3][2] = {{true, true}, {false, true}, {false, false}};
  std::vector<PhaseEnd> ends[3];
  double peak[3] = {};
  for (int k = 0; k < 3; ++k) {
    Problem problem;
    Recorder recorder("");
    run(pair(kinds[k][0], kinds[k][1]), problem, recorder);
    ends[k] = recorder.phases;
    ASSERT_EQ(ends[k].size(), 4u);
    const double N = ends[k].back().measurement.normal_force;
    for (const HistoryRow &row : recorder.rows) {
      peak[k] = std::max(peak[k], row.measurement.normal_force / N);
      if (row.phase < 3) continue;
      const PhaseEnd &end = ends[k][static_cast<std::size_t>(row.phase - 1)];
      EXPECT_NEAR(row.measurement.normal_force / N, 1,
                  2e-4); // "approximatively constant when rotation is applied"
      if (row.time - ends[k][static_cast<std::size_t>(row.phase - 2)].time > 10) {
        EXPECT_NEAR(row.measurement.torque / end.measurement.torque, 1, 1e-3) << row.time;
      }
    }
  }
  for (std::size_t phase = 1; phase < 4; ++phase)
    for (int k = 1; k < 3; ++k) {
      const Measurement &a = ends[0][phase].measurement, &b = ends[k][phase].measurement;
      EXPECT_NEAR(b.normal_force / a.normal_force, 1, 1e-6);
      if (phase == 1) continue;
      EXPECT_NEAR(b.torque / a.torque, 1, 1e-6);
      EXPECT_NEAR(b.mu_apparent / a.mu_apparent, 1, 1e-6);
    }
  EXPECT_GT(peak[0], 1.1);
  EXPECT_GT(peak[0], peak[1] + 0.02);
  EXPECT_GT(peak[1], peak[2] + 0.02);
  EXPECT_LT(peak[2], 1.001);
}

/// Fig. 5: "the normal force increases when the torque is applied". The plates' distance and the twist theta
/// are given, so N = dW/d(approach): it rises by the integral of dT/d(approach) over theta, 1/2 theta^2
/// dk/d(approach) for small ones.
TEST(paper_words, NormalForceOfATwistedGelRisesByWhatItsTorsionalStiffnessGains)
{
  const double approach = 0.414, step = 0.004, twist = 0.05;
  Scene scene = paper_scene(6);
  scene.arrangement = Arrangement::single_gel;
  scene.bottom = {10, 4.4, viscoelastic_gel()};
  scene.schedule_kind = ScheduleKind::steady;
  scene.schedule = schedule_from_twists({100, 200, 300, 400, 500},
                                        {approach, approach, approach, approach + step, approach - step},
                                        {0, twist, 2 * twist, twist, twist});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  ASSERT_EQ(recorder.phases.size(), 5u);
  const auto at = [&](int k) { return recorder.phases[static_cast<std::size_t>(k)].measurement; };
  const double rise = at(1).normal_force - at(0).normal_force;
  const double stiffening = (at(3).torque - at(4).torque) / (2 * step * twist); // dk/d(approach)
  EXPECT_GT(rise, 0);
  EXPECT_NEAR(rise, 0.5 * twist * twist * stiffening, 0.02 * rise);
  EXPECT_NEAR((at(2).normal_force - at(0).normal_force) / rise, 4, 0.1);
}

} // namespace tribogel::test
