/// What a run says by itself: failures in words and by kind, and whether the friction law is asked what it
/// can answer.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>

namespace tribogel::test
{

namespace
{

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

/// A small rheometer that slides at up to 10 * rate mm/s in its second phase.
Scene turned_at(double rate, const std::vector<double> &coefficients)
{
  Scene scene = paper_scene(5);
  scene.friction = PolynomialFriction<double>{coefficients, {0, 1}};
  scene.schedule = schedule_from_rates({20, 40}, {0.4, 0.4}, {0, rate});
  return scene;
}

struct Outcome {
  bool completed = false;
  std::string why;
};

Outcome outcome_of(const Scene &scene, Problem &problem, Recorder &recorder)
{
  Outcome outcome;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  EXPECT_EQ(problem.Run({&recorder}, outcome.completed, outcome.why), 0);
  return outcome;
}

} // namespace

TEST(notices, AFailureIsToldInWordsOnceAndCounted)
{
  Scene scene = paper_scene(6);
  scene.arrangement = Arrangement::single_gel;
  scene.bottom.material = hyperelastic_gel();
  scene.schedule = schedule_from_twists({1}, {1.3}, {0.4});
  const SolverOptions options(OptionList{{"-ts_dt", "1"}}); // too much for the cells at the plate
  Problem problem;
  Recorder recorder("");
  std::vector<StepFailure> told;
  recorder.on_first_failure = [&](const StepFailure &failure) { told.push_back(failure); };
  EXPECT_TRUE(outcome_of(scene, problem, recorder).completed);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, FailureKind::inverted_element);
  EXPECT_EQ(told[0].time, 0);
  EXPECT_GT(told[0].step, 0.1);
  EXPECT_TRUE(contains(told[0].words, "turned inside out in the bottom gel near R = ")) << told[0].words;
  int failures = 0;
  for (int count : problem.stepper.counts.failures) failures += count;
  EXPECT_EQ(failures, problem.stepper.counts.failed_solves);
}

/// Newton may not iterate: every step fails, down to the smallest, and that is the end, in words.
TEST(notices, TheSmallestStepIsTheEnd)
{
  const SolverOptions options(OptionList{{"-snes_max_it", "0"}});
  Problem problem;
  Recorder recorder("");
  const Outcome outcome = outcome_of(turned_at(0.1, {0, 1e-3}), problem, recorder);
  EXPECT_FALSE(outcome.completed);
  EXPECT_TRUE(contains(outcome.why, "no step from t = 0 s (phase 1) succeeds")) << outcome.why;
  EXPECT_TRUE(contains(outcome.why, "times its tolerance near R = ")) << outcome.why;
  EXPECT_EQ(recorder.rows.size(), 1u); // the initial state
  EXPECT_GT(problem.stepper.counts.failures[static_cast<std::size_t>(FailureKind::newton)], 3);
}

TEST(notices, ANegativeCoefficientEndsTheRunAndSaysWhere)
{
  Problem problem;
  Recorder recorder("");
  Scene scene = turned_at(0.2, {1e-3, -1e-3}); // mu < 0 beyond 1 mm/s
  scene.friction_speeds = {{0.01, 0.5}};       // gives a notice at the same step
  const Outcome outcome = outcome_of(scene, problem, recorder);
  EXPECT_FALSE(outcome.completed);
  EXPECT_TRUE(contains(outcome.why, "the friction coefficient is -0.0")) << outcome.why;
  EXPECT_TRUE(contains(outcome.why, "mm, where the gels slide at ")) << outcome.why;
  EXPECT_EQ(recorder.rows.back().phase, 2);
  const auto at_speed =
      std::find_if(recorder.notices.begin(), recorder.notices.end(),
                   [](const std::string &notice) { return contains(notice, "-friction_speed_range"); });
  ASSERT_NE(at_speed, recorder.notices.end());
  EXPECT_TRUE(at_speed->starts_with("t = ") && !contains(*at_speed, "coefficient")) << *at_speed;
  EXPECT_FALSE(contains(outcome.why, "-friction_speed_range")) << outcome.why;
}

/// What options end the run is said by their names.
TEST(notices, AnOptionThatEndsTheRunIsNamed)
{
  for (const auto &[name, value] : OptionList{{"-ts_max_snes_failures", "2"}, {"-ts_max_reject", "0"}}) {
    const SolverOptions options(OptionList{{"-snes_max_it", "0"}, {name, value}});
    Problem problem;
    Recorder recorder("");
    const Outcome outcome = outcome_of(turned_at(0.1, {0, 1e-3}), problem, recorder);
    EXPECT_TRUE(outcome.why.starts_with(name + " reached at t = 0 s")) << outcome.why;
    EXPECT_FALSE(contains(outcome.why, "however small")) << outcome.why;
  }
}

TEST(notices, FrictionThatFallsFasterThanTheGelsHoldIsToldOnce)
{
  // -dtau/dv = 0.05 p, about 2e-2 MPa s/mm; the gels hold 0.16 MPa/mm, so steps below 0.1 s are not unique.
  const SolverOptions options(
      OptionList{{"-ts_max_steps", "40"}}); // where nothing is unique, steps get short
  Scene scene = turned_at(0.05, {0.2, -0.05});
  scene.schedule = schedule_from_rates({20, 20.1}, {0.4, 0.4}, {0, 0.05});
  for (const double slope : {-0.05, -1e-6, 1e-6}) {
    scene.friction = PolynomialFriction<double>{{0.2, slope}, {0, 1}};
    Problem problem;
    Recorder recorder("");
    outcome_of(scene, problem, recorder);
    int not_unique = 0, unstable = 0;
    for (const std::string &notice : recorder.notices) {
      not_unique += contains(notice, "is not unique");
      unstable += contains(notice, "steady sliding is unstable");
    }
    EXPECT_EQ(not_unique, slope < -0.01 ? 1 : 0);
    EXPECT_EQ(unstable, slope == -1e-6 ? 1 : 0); // long steps do not show it
  }
}

TEST(notices, SlidingFasterThanTheLawIsKnownForIsToldOnce)
{
  for (const double known : {0.5, 2.0}) {
    Problem problem;
    Recorder recorder("");
    Scene scene = turned_at(0.1, {0, 1e-3}); // 1 mm/s at the rim
    scene.friction_speeds = {{0.01, known}};
    EXPECT_TRUE(outcome_of(scene, problem, recorder).completed);
    ASSERT_EQ(recorder.notices.size(), known < 1 ? 1u : 0u);
    if (known < 1) {
      EXPECT_TRUE(contains(recorder.notices[0], "-friction_speed_range, which ends at 0.5"));
    }
  }
}

/// With the same numbers at its end. Steps may only double, so that there is something to spare.
TEST(notices, APhaseThatHasSettledEndsInOneStep)
{
  const SolverOptions options(OptionList{{"-ts_adapt_clip", "0.1,2"}});
  Scene scene = turned_at(0.1, {0, 1e-3});
  scene.schedule = schedule_from_rates({20, 4000}, {0.4, 0.4}, {0.1, 0.1});
  Problem whole, cut;
  Recorder long_way(""), short_way("");
  EXPECT_TRUE(outcome_of(scene, whole, long_way).completed);
  scene.phase_end_tolerance = 0.01;
  EXPECT_TRUE(outcome_of(scene, cut, short_way).completed);
  EXPECT_LT(short_way.rows.size(), long_way.rows.size());
  ASSERT_EQ(short_way.notices.size(), 1u); // not in phase 1, which moves to its end
  EXPECT_TRUE(contains(short_way.notices[0], "phase 2: N and T have stopped changing"));
  const Measurement &a = short_way.phases[1].measurement, &b = long_way.phases[1].measurement;
  EXPECT_NEAR(a.normal_force, b.normal_force, 1e-4 * b.normal_force);
  EXPECT_NEAR(a.torque, b.torque, 1e-4 * b.torque);
}

} // namespace tribogel::test
