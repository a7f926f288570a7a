/// Companions of a run, -error_estimate: one that differs in nothing gives the run's numbers; one that fails says so
/// and throws nothing; the meshes and tolerances that are meant; errors of a coarse run are within what is estimated.
#include "observe/error_estimate.hpp"
#include "probe.hpp"
#include "solver_options.hpp"

#include "support/petsc_session.hpp"

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

const WishToStop never = [](MPI_Comm, std::string &) -> PetscErrorCode { return 0; };

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
  EXPECT_EQ(same.unknowns, problem.mesh.unknowns);
  EXPECT_EQ(same.steps, problem.counts.accepted_steps);
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

  const SolverOptions wrong({{"-ts_max_time", "3"}}); // refused by PETSc's way of errors
  testing::internal::CaptureStderr();
  ASSERT_EQ(RunCompanion(PETSC_COMM_WORLD, short_scene(4, 1), nullptr, never, companion, stopped), 0);
  testing::internal::GetCapturedStderr();
  EXPECT_NE(companion.failure, "");
}

TEST(companions, AreStoppedOnRequest)
{
  const Scene scene = short_scene(4, 1);
  int asked = 0;
  const WishToStop soon = [&asked](MPI_Comm, std::string &why) -> PetscErrorCode {
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

} // namespace tribogel::test
