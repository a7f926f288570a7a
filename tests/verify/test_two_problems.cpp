/// A Problem holds all of its state: two different ones in one process, one run inside a step of the other,
/// give the numbers of separate runs, bit for bit.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

Scene viscoelastic_scene()
{
  Scene scene = paper_scene(4, 2);
  scene.schedule = schedule_from_rates({2.5, 4}, {0.37, 0.43}, {0, 0.3});
  return scene;
}

Scene sticking_scene()
{
  Scene scene = paper_scene(5, 1);
  scene.bottom.material = hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{0.21, 0.013}, {0, 1}};
  scene.schedule = schedule_from_rates({1.5, 6}, {0.29, 0.29}, {0.02, 0.11});
  return scene;
}

/// Runs another scene to its end between two steps.
class Interruption : public Observer
{
public:
  PetscErrorCode Start(const Problem &) override { return 0; }
  PetscErrorCode Step(const Problem &, const StepReport &) override
  {
    if (++steps == 3) run(sticking_scene(), problem, recorder);
    return 0;
  }
  int steps = 0;
  Problem problem;
  Recorder recorder{""};
};

void expect_same(const Recorder &a, const Recorder &b)
{
  ASSERT_EQ(a.rows.size(), b.rows.size());
  EXPECT_GT(a.rows.size(), 10u);
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    EXPECT_EQ(a.rows[k].time, b.rows[k].time);
    EXPECT_EQ(a.rows[k].measurement.normal_force, b.rows[k].measurement.normal_force);
    EXPECT_EQ(a.rows[k].measurement.torque, b.rows[k].measurement.torque);
    EXPECT_EQ(a.rows[k].measurement.contact_force, b.rows[k].measurement.contact_force);
    EXPECT_EQ(a.rows[k].report.newton_iterations, b.rows[k].report.newton_iterations);
  }
}

} // namespace

TEST(two_problems, InOneProcessGiveTheNumbersOfSeparateRuns)
{
  Recorder first(""), second("");
  {
    Problem problem;
    run(viscoelastic_scene(), problem, first);
  }
  {
    Problem problem;
    run(sticking_scene(), problem, second);
  }
  Problem outer;
  Recorder recorder("");
  Interruption inner;
  bool completed = false;
  std::string why;
  ASSERT_EQ(outer.SetUp(PETSC_COMM_WORLD, viscoelastic_scene()), 0);
  ASSERT_EQ(outer.Run({&recorder, &inner}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
  ASSERT_GT(inner.steps, 3);
  expect_same(recorder, first);
  expect_same(inner.recorder, second);
  EXPECT_NE(first.rows.back().measurement.normal_force, second.rows.back().measurement.normal_force);
}

/// The unknowns too, not only what is measured of them.
TEST(two_problems, EndInTheSameState)
{
  Problem alone, again, other;
  Recorder a(""), b(""), c("");
  run(viscoelastic_scene(), alone, a);
  run(sticking_scene(), other, c);
  run(viscoelastic_scene(), again, b);
  EXPECT_EQ(Probe::values(alone.stepper.state.U), Probe::values(again.stepper.state.U));
  EXPECT_EQ(alone.stepper.state.history, again.stepper.state.history);
  EXPECT_EQ(alone.stepper.state.dissipated, again.stepper.state.dissipated);
  EXPECT_GT(alone.stepper.state.dissipated, 0);
}

} // namespace tribogel::test
