/// Companions of a run, -error_estimate: one that differs in nothing gives the run's numbers; one that fails
/// says so and throws nothing; the meshes and tolerances that are meant; errors of a coarse run are within
/// what is estimated.
#include "observe/error_estimate.hpp"
#include "probe.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

namespace
{

Scene short_scene(int elements, int order)
{
  Scene scene = paper_scene(elements, order);
  scene.schedule = schedule_from_rates({9, 30}, {0.37, 0.37}, {0, 0.1});
  scene.time.tolerance = 0.5;
  return scene;
}

const StopQuestion never = [](MPI_Comm, std::string &) -> PetscErrorCode { return 0; };

} // namespace

TEST(companions, ThatDifferInNothingGiveTheNumbersOfTheRun)
{
  const Scene scene = short_scene(4, 2);
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  Companion same;
  same.mesh = scene.mesh;
  bool stopped = true;
  ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, scene, nullptr, never, same, stopped), 0);
  EXPECT_FALSE(stopped);
  EXPECT_EQ(same.failure, "");
  ASSERT_EQ(same.ends.size(), recorder.phases.size());
  for (std::size_t k = 0; k < same.ends.size(); ++k) {
    EXPECT_EQ(same.ends[k][0], recorder.phases[k].measurement.normal_force);
    EXPECT_EQ(same.ends[k][1], recorder.phases[k].measurement.torque);
  }
  EXPECT_EQ(same.unknowns, problem.system.mesh.unknowns);
  EXPECT_EQ(same.steps, problem.stepper.counts.accepted_steps);
}

TEST(companions, WithALargerToleranceTakeLongerSteps)
{
  const Scene scene = short_scene(4, 1);
  for (const OptionList &given : {OptionList{}, OptionList{{"-ts_atol", "1e-3"}}}) {
    const SolverOptions options(given);
    Companion same, coarse;
    same.mesh = coarse.mesh = scene.mesh;
    coarse.tolerance_over = 4;
    bool stopped;
    ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, scene, nullptr, never, same, stopped), 0);
    ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, scene, nullptr, never, coarse, stopped), 0);
    EXPECT_LT(coarse.steps, 0.85 * same.steps);
  }
}

TEST(companions, ThatFailSaySo)
{
  Scene scene = short_scene(4, 1);
  Companion companion;
  companion.mesh = scene.mesh;
  bool stopped = false;
  for (Phase &phase : scene.schedule) phase.end_approach = 8.3; // of 8.4 mm
  ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, scene, nullptr, never, companion, stopped), 0);
  EXPECT_NE(companion.failure.find("no step from"), std::string::npos) << companion.failure;
  EXPECT_FALSE(stopped);

  const OptionList refused{{"-ts_max_time", "3"}}; // in PETSc's way of errors
  const SolverOptions options(refused);
  testing::internal::CaptureStderr();
  ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, short_scene(4, 1), nullptr, never, companion, stopped), 0);
  testing::internal::GetCapturedStderr();
  EXPECT_NE(companion.failure, "");
}

TEST(companions, AreStoppedOnRequest)
{
  const Scene scene = short_scene(4, 1);
  int asked = 0;
  const StopQuestion soon = [&asked](MPI_Comm, std::string &why) -> PetscErrorCode {
    if (++asked == 5) why = "enough";
    return 0;
  };
  Companion companion;
  companion.mesh = scene.mesh;
  bool stopped = false;
  ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, scene, nullptr, soon, companion, stopped), 0);
  EXPECT_TRUE(stopped);
  EXPECT_EQ(asked, 5);
  EXPECT_EQ(companion.failure, "enough");
}

/// The limits of N and T per rate are those of tests/measurements/mesh-limits.md. Fails with meshes of 2
/// and 4 times the edges alone (order 2, 10 elements).
TEST(companions, ErrorsOfTheRheometerAreWithinTheEstimate)
{
  constexpr double force = 290.4435, torque = 11.4421;
  const std::array<int, 2> meshes[] = {{6, 2}, {8, 2}, {10, 2}, {8, 1}, {14, 1}}; // elements, order
  for (const auto &[elements, order] : meshes) {
    Scene scene = paper_scene(elements, order);
    scene.schedule = schedule_from_rates({27}, {0.79}, {0.01});
    scene.schedule_kind = ScheduleKind::steady;
    scene.time.rule = TimeRule::exponential_euler;
    scene.mesh.grading = MeshParameters{}.grading;
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    ErrorEstimate estimate;
    int ended = 0;
    ASSERT_EQ(EstimateErrors(
                  PETSC_COMM_WORLD, scene, nullptr, recorder, never, [&ended](const Companion &) { ++ended; },
                  estimate),
              0);
    EXPECT_EQ(ended, static_cast<int>(estimate.companions.size()));
    ASSERT_EQ(estimate.phases.size(), 1u);
    const Measurement &m = recorder.phases[0].measurement;
    const double errors[] = {m.normal_force - force, m.torque - 0.01 * torque};
    for (std::size_t load = 0; load < 2; ++load) {
      const double estimated = estimate.phases[0][load].mesh.error;
      std::printf("order %d, %d elements: error %.2e, estimated %.2e\n", order, elements, errors[load],
                  estimated);
      EXPECT_GT(estimated, std::abs(errors[load]));
      EXPECT_LT(estimated, 20 * std::abs(errors[load]));
    }
  }
}

} // namespace tribogel::test
