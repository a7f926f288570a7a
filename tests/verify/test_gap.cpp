/// An initial gap: before the gels touch the contact carries exactly nothing although the plate moves and
/// turns, and the plates feel the round-off of a rigid motion only (K times the last bits of the strain);
/// afterwards the state is that of the scene without a gap whose plate travelled the gap less. Exact for
/// elastic gels at rest or in steady rotation, which remember no path.
#include "scenes.hpp"
#include "solver_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double gap = 0.23;

Scene scene_with_gap(double initial_gap, int order)
{
  Scene scene = paper_scene(5, order);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.initial_gap = initial_gap;
  const double approach = 0.79 + initial_gap;
  scene.schedule = schedule_from_rates({27, 300, 500}, {approach, approach, approach}, {0.05, 0, 0.1});
  return scene;
}

} // namespace

TEST(gap, NothingBeforeTouchAndTheSameStateAfterwards)
{
  const SolverOptions options(newton_tolerance(1e-11));
  for (int order : {1, 2}) {
    Problem open, closed;
    Recorder with(""), without("");
    run(scene_with_gap(gap, order), open, with);
    run(scene_with_gap(0, order), closed, without);
    int before = 0, after = 0;
    for (const HistoryRow &row : with.rows) {
      if (row.approach < gap) {
        ++before;
        EXPECT_LE(std::abs(row.measurement.normal_force), 1e-12 * without.phases[1].measurement.normal_force);
        EXPECT_LE(std::abs(row.measurement.torque), 1e-12 * without.phases[2].measurement.torque);
        EXPECT_EQ(row.measurement.contact_force, 0);
        EXPECT_EQ(row.measurement.contact_torque, 0);
        EXPECT_TRUE(std::isnan(row.measurement.contact_radius));
      } else if (row.approach > 1.01 * gap) {
        ++after;
        EXPECT_GT(row.measurement.normal_force, 0);
      }
    }
    EXPECT_GE(before, 5);
    EXPECT_GE(after, 10);
    ASSERT_EQ(with.last_profile.size(), without.last_profile.size());
    for (std::size_t k : {1u, 2u}) { // at rest, then turning
      const Measurement &a = with.phases[k].measurement, &b = without.phases[k].measurement;
      EXPECT_NEAR(a.normal_force / b.normal_force, 1, 1e-8);
      EXPECT_NEAR(a.contact_radius / b.contact_radius, 1, 1e-8);
    }
    const double T = without.phases[2].measurement.torque;
    ASSERT_GT(T, 0.01);
    EXPECT_NEAR(with.phases[2].measurement.torque / T, 1, 1e-8);
    double pressure = 0, place = 0;
    for (std::size_t k = 0; k < with.last_profile.size(); ++k) {
      const ProfileRow &a = with.last_profile[k], &b = without.last_profile[k];
      place = std::max(place, std::hypot(a.r - b.r, a.z - b.z));
      if (!std::isnan(b.pressure)) pressure = std::max(pressure, std::abs(a.pressure - b.pressure));
    }
    EXPECT_LE(place, 1e-8 * 10);
    EXPECT_LE(pressure, 1e-8);
  }
}

/// Nothing is resolved where nothing happens: no touch in any phase, only touch, one gel that stays as it is.
TEST(gap, NothingTakesAStepAPhase)
{
  Scene apart = paper_scene(4), touching = apart, alone = apart;
  apart.initial_gap = 1;
  for (Phase &phase : touching.schedule) phase.start_approach = phase.end_approach = 0;
  alone.arrangement = Arrangement::single_gel;
  alone.schedule = schedule_from_rates({27, 3600}, {0, 0}, {0, 0});
  for (const Scene &scene : {apart, touching, alone}) {
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    EXPECT_EQ(recorder.Conclude(problem), 0);
    EXPECT_LE(problem.stepper.counts.accepted_steps, 12);
    EXPECT_EQ(problem.stepper.counts.rejected_steps, 0);
    const double round_off =
        16 * std::numeric_limits<double>::epsilon() * 400 * std::numbers::pi * 100; // of (K + K_v) A
    for (const HistoryRow &row : recorder.rows) {
      EXPECT_LE(std::abs(row.measurement.normal_force), round_off);
      EXPECT_EQ(row.measurement.torque, 0);
    }
    ASSERT_EQ(recorder.notices.size(), scene.has_top() ? 1u : 0u);
    if (scene.has_top()) {
      EXPECT_NE(recorder.notices[0].find("never been pressed together"), std::string::npos);
    }
  }
}

/// No step goes over the touch, however late in a phase it is, and what follows takes the steps of a phase. N
/// is proportional to the travel that is left.
TEST(gap, ClosedLateIsMetWithoutFailures)
{
  std::vector<double> stiffness;
  for (const double left : {1e-2, 1e-4, 1e-7}) {
    Scene scene = paper_scene(4);
    scene.bottom.radius = scene.top.radius;
    scene.initial_gap = 0.5;
    const double approach = scene.initial_gap + left;
    scene.schedule = schedule_from_rates({27, 3600}, {approach, approach}, {0.05, 0});
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    EXPECT_EQ(problem.stepper.counts.failed_solves, 0);
    EXPECT_LE(problem.stepper.counts.accepted_steps + problem.stepper.counts.rejected_steps, 40);
    stiffness.push_back(recorder.phases.back().measurement.normal_force / left);
  }
  EXPECT_NEAR(stiffness[1] / stiffness[0], 1, 5e-3); // measured without gap: 1.1e-3 between 1e-2 and 1e-4 mm
  EXPECT_NEAR(stiffness[2] / stiffness[1], 1, 1e-3);
}

/// In the linear limit N is proportional to the travel, T to N, and the steps are those of any other travel.
TEST(gap, TinyTravelsAreLinearAndTakeNoMoreSteps)
{
  std::array<double, 2> reference{};
  PetscInt steps = 0;
  for (const double travel : {1e-3, 1e-6, 1e-8, 1e-10}) {
    Scene scene = paper_scene(4);
    scene.bottom.radius = scene.top.radius;
    const std::vector<double> approach(5, travel);
    scene.schedule = schedule_from_rates({27, 3600, 4500, 5400, 6300}, approach, {0, 0, 0.01, 0.1, 1});
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    const Measurement &end = recorder.phases.back().measurement;
    if (travel == 1e-3) {
      reference = {end.normal_force / travel, end.torque / travel};
      steps = problem.stepper.counts.accepted_steps + problem.stepper.counts.rejected_steps;
    }
    EXPECT_NEAR(end.normal_force / travel / reference[0], 1, 3e-3) << travel;
    EXPECT_NEAR(end.torque / travel / reference[1], 1, 3e-3) << travel;
    EXPECT_LE(problem.stepper.counts.accepted_steps + problem.stepper.counts.rejected_steps, 1.2 * steps)
        << travel;
  }
}

} // namespace tribogel::test
