/// Failures on several ranks.
///
/// A cell that turns inside out on one rank makes every rank leave the solve, so that all cut the step
/// together; were the failure that rank's own, the others would wait in the solver for ever.
#include "scenes.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

TEST(failure, OfOneRankCutsTheStepOfAll)
{
  Scene scene = paper_scene(6);
  scene.arrangement = Arrangement::single_gel;
  scene.bottom.material = hyperelastic_gel();
  scene.schedule = schedule_from_twists({1}, {1.3}, {0.4});
  const OptionList whole_travel_at_once{{"-ts_dt", "1"}}; // too much for the cells at the plate
  const SolverOptions options(whole_travel_at_once);
  Problem shared, single;
  Recorder many(""), one("");
  bool completed = false, alone_completed = false;
  std::string why;
  ASSERT_EQ(shared.SetUp(PETSC_COMM_WORLD, scene), 0);
  ASSERT_EQ(shared.Run({&many}, completed, why), 0);
  ASSERT_EQ(single.SetUp(PETSC_COMM_SELF, scene), 0);
  ASSERT_EQ(single.Run({&one}, alone_completed, why), 0);
  ASSERT_TRUE(completed && alone_completed) << why;
  EXPECT_GT(single.stepper.counts.failed_solves, 0);
  EXPECT_EQ(shared.stepper.counts.failed_solves, single.stepper.counts.failed_solves);
  ASSERT_EQ(many.rows.size(), one.rows.size());
  const Measurement &a = many.rows.back().measurement, &b = one.rows.back().measurement;
  EXPECT_NEAR(a.normal_force, b.normal_force, 1e-7 * b.normal_force);
  EXPECT_NEAR(a.torque, b.torque, 1e-7 * b.torque);
}

/// A matrix that cannot be factorised fails that solve, not the later ones.
TEST(failure, OfTheLinearSolverIsForgotten)
{
  Problem problem;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, paper_scene(4)), 0);
  SNES snes;
  KSP ksp;
  KSPConvergedReason reason;
  VecHandle x;
  ASSERT_EQ(TSGetSNES(problem.stepper.ts, &snes), 0);
  ASSERT_EQ(SNESGetKSP(snes, &ksp), 0);
  ASSERT_EQ(VecDuplicate(problem.stepper.state.U, x.put()), 0);
  ASSERT_EQ(MatZeroEntries(problem.stepper.jacobian), 0);
  ASSERT_EQ(MatAssemblyBegin(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
  ASSERT_EQ(MatAssemblyEnd(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
  ASSERT_EQ(KSPSetOperators(ksp, problem.stepper.jacobian, problem.stepper.jacobian), 0);
  ASSERT_EQ(KSPSolve(ksp, problem.stepper.state.U, x), 0);
  ASSERT_EQ(KSPGetConvergedReason(ksp, &reason), 0);
  EXPECT_LT(reason, 0);

  ASSERT_EQ(problem.stepper.ProbeSolver(), 0); // the same with the tangent at rest
  ASSERT_EQ(KSPGetConvergedReason(ksp, &reason), 0);
  EXPECT_GT(reason, 0);
}

} // namespace tribogel::test
