/// A cell that turns inside out on one rank makes every rank leave the solve, so that all cut the step together; were
/// the failure that rank's own, the others would wait in the solver for ever.
#include "scenes.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

TEST(failure, OfOneRankCutsTheStepOfAll)
{
  Scene scene = paper_scene(6);
  scene.has_top = false;
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
  EXPECT_GT(single.counts.failed_solves, 0);
  EXPECT_EQ(shared.counts.failed_solves, single.counts.failed_solves);
  ASSERT_EQ(many.rows.size(), one.rows.size());
  const Measurement &a = many.rows.back().measurement, &b = one.rows.back().measurement;
  EXPECT_NEAR(a.normal_force, b.normal_force, 1e-7 * b.normal_force);
  EXPECT_NEAR(a.torque, b.torque, 1e-7 * b.torque);
}

} // namespace tribogel::test
