/// The relaxed state of each phase, solved for directly, is what the transient tends to.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

Scene scene_of(int order, ScheduleKind kind)
{
  Scene scene = paper_scene(6, order);
  scene.friction = PolynomialFriction<double>{{0.02, 8e-3}, {0, 1}};
  scene.schedule =
      schedule_from_rates({27, 4000, 4100, 8000}, {0.57, 0.57, 0.71, 0.71}, {0.05, 0.05, 0.4, 0.4});
  scene.schedule_kind = kind;
  return scene;
}

} // namespace

/// The transient holds for a thousand relaxation times; what is left of it, and of the error of its steps, is
/// below 1e-6 of N (and of N R for the torque).
TEST(steady, IsWhatTheTransientTendsTo)
{
  for (int order : {1, 2}) {
    Problem transient, steady;
    Recorder slow(""), direct("");
    run(scene_of(order, ScheduleKind::transient), transient, slow);
    run(scene_of(order, ScheduleKind::steady), steady, direct);
    ASSERT_EQ(direct.phases.size(), 4u);
    for (int k : {1, 3}) { // the others are still moving
      const Measurement &a = slow.phases[k].measurement, &b = direct.phases[k].measurement;
      EXPECT_GT(b.normal_force, 10);
      EXPECT_GT(b.torque, 0.02 * b.normal_force);
      EXPECT_NEAR(a.normal_force, b.normal_force, 1e-6 * b.normal_force);
      EXPECT_NEAR(a.torque, b.torque, 1e-6 * b.normal_force * steady.system.scene.top.radius);
      EXPECT_NEAR(a.mu_pressure_weighted, b.mu_pressure_weighted, 1e-6);
    }
    EXPECT_LT(4 * direct.rows.size(), slow.rows.size());
    EXPECT_EQ(direct.rows.back().energy.viscous, 0); // no dashpot moves
  }
}

/// Friction that vanishes at rest with an infinite slope: pressed at rest the gels are those without
/// friction; turned they are what the transient tends to.
TEST(steady, PressesAtRestAndThenTurnsWhateverTheExponent)
{
  for (const double pressure_exponent : {1.0, 0.6})
    for (const double m : {0.1, 0.5, 0.9}) {
      Scene scene = paper_scene(3, 1);
      scene.schedule = schedule_from_rates({27, 4000, 8000}, {0.57, 0.57, 0.57}, {0, 0.07, 0});
      scene.schedule_kind = ScheduleKind::steady;
      Scene slippery = scene, transient = scene;
      slippery.friction = {};
      scene.friction = PolynomialFriction<double>{{0.02}, {m}, pressure_exponent};
      transient.friction = scene.friction;
      transient.schedule_kind = ScheduleKind::transient;
      Problem problem, smooth, slow;
      Recorder recorder(""), without(""), tends("");
      run(scene, problem, recorder);
      run(slippery, smooth, without);
      run(transient, slow, tends);
      const Measurement &resting = recorder.phases[0].measurement, &turning = recorder.phases[1].measurement;
      EXPECT_NEAR(resting.normal_force / without.phases[0].measurement.normal_force, 1, 1e-6);
      EXPECT_NEAR(resting.torque, 0, 1e-9);
      EXPECT_NEAR(recorder.phases[2].measurement.normal_force / resting.normal_force, 1, 1e-9);
      EXPECT_GT(turning.torque, 1);
      EXPECT_NEAR(turning.torque / tends.phases[1].measurement.torque, 1, 1e-5) << "m " << m;
      EXPECT_NEAR(turning.normal_force / tends.phases[1].measurement.normal_force, 1, 1e-5);
      EXPECT_LE(recorder.rows.size(), 12u);
    }
}

/// The order of the phases does not matter, nor what came before.
TEST(steady, ForgetsTheWayThere)
{
  Scene scene = scene_of(2, ScheduleKind::steady);
  Problem there, back;
  Recorder one(""), two("");
  run(scene, there, one);
  scene.schedule =
      schedule_from_rates({27, 4000, 4100, 8000}, {0.71, 0.71, 0.57, 0.57}, {0.4, 0.4, 0.05, 0.05});
  run(scene, back, two);
  for (int k : {1, 3}) {
    const Measurement &a = one.phases[k].measurement, &b = two.phases[4 - k].measurement;
    EXPECT_NEAR(a.normal_force, b.normal_force, 1e-6 * a.normal_force);
    EXPECT_NEAR(a.torque, b.torque, 1e-6 * a.torque);
  }
}

} // namespace tribogel::test
