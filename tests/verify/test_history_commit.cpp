/// A rejected step leaves nothing behind: neither in the unknowns nor in the internal variables, what
/// friction remembers, energies or the start of the next step. A run whose steps fail (Newton's iterations
/// run out) or are rejected (error estimate) is compared with one that takes the same accepted steps and
/// rejects none.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/rate_and_state.hpp"

namespace tribogel::test
{

namespace
{

constexpr TimeRule rules[] = {TimeRule::exponential_euler, TimeRule::sdirk2};

const Friction viscous(PolynomialFriction<double>{{0, 0.013}, {0, 1}});

Friction rate_and_state()
{
  RateAndStateFriction<double> law;
  law.set({{0.03}, {0.01}, {0.007}, {0.4}, {0.3}, {2}});
  return law;
}

Scene scene_of(int order, TimeRule rule, const Friction &friction = viscous)
{
  Scene scene = paper_scene(4, order);
  scene.time.rule = rule;
  scene.friction = friction;
  scene.schedule = schedule_from_rates({8}, {0.57}, {0.3});
  return scene;
}

/// Makes TS take the listed steps.
class Replay : public Observer
{
public:
  explicit Replay(std::vector<HistoryRow> given) : rows(std::move(given)) {}
  PetscErrorCode Start(const Problem &) override { return 0; }
  PetscErrorCode Step(const Problem &problem, const StepReport &) override
  {
    ++taken;
    if (taken + 1 < rows.size())
      return TSSetTimeStep(problem.stepper.ts, rows[taken + 1].time - problem.stepper.state.time);
    return 0;
  }

private:
  std::vector<HistoryRow> rows;
  std::size_t taken = 0;
};

void expect_same_end(const Problem &a, const Problem &b, double tolerance)
{
  const Values U = Probe::values(a.stepper.state.U), V = Probe::values(b.stepper.state.U);
  ASSERT_EQ(U.size(), V.size());
  ASSERT_EQ(a.stepper.state.history.size(), b.stepper.state.history.size());
  double difference = 0, strain = 0;
  for (std::size_t k = 0; k < U.size(); ++k) difference = std::max(difference, std::abs(U[k] - V[k]));
  for (std::size_t k = 0; k < a.stepper.state.history.size(); ++k)
    strain = std::max(strain, std::abs(a.stepper.state.history[k] - b.stepper.state.history[k]));
  EXPECT_LE(difference, tolerance);
  EXPECT_LE(strain, tolerance);
  const std::vector<double> &ages = a.stepper.state.friction_history.values,
                            &others = b.stepper.state.friction_history.values;
  EXPECT_EQ(ages.empty(), !a.system.scene.friction.has_memory());
  ASSERT_EQ(ages.size(), others.size());
  for (std::size_t k = 0; k < ages.size(); ++k) EXPECT_NEAR(ages[k], others[k], 100 * tolerance * ages[k]);
  EXPECT_NEAR(a.stepper.state.dissipated, b.stepper.state.dissipated, tolerance * b.stepper.state.dissipated);
  EXPECT_GT(b.stepper.state.dissipated, 1e-3);
}

} // namespace

TEST(history_commit, AFailedSolveLeavesNothingBehind)
{
  for (const auto &[order, rule] : {std::pair{1, rules[0]}, {2, rules[0]}, {1, rules[1]}, {2, rules[1]}}) {
    Problem failing, smooth;
    const char *most = rule == TimeRule::sdirk2 ? "3" : "4"; // its solves are shorter
    Recorder with(""), without("");
    {
      const SolverOptions options({{"-ts_adapt_type", "none"}, {"-ts_dt", "8"}, {"-snes_max_it", most}});
      run(scene_of(order, rule), failing, with);
    }
    EXPECT_GE(failing.stepper.counts.failed_solves, 1);
    ASSERT_GE(with.rows.size(), 3u);
    const double step = with.rows[1].step; // 8 s quartered once or more
    EXPECT_LT(step, 8);
    {
      const SolverOptions options(
          {{"-ts_adapt_type", "none"}, {"-ts_dt", text_of(step)}, {"-snes_max_it", most}});
      run(scene_of(order, rule), smooth, without);
    }
    EXPECT_EQ(smooth.stepper.counts.failed_solves, 0);
    ASSERT_EQ(with.rows.size(), without.rows.size());
    expect_same_end(failing, smooth, 0);
  }
}

namespace
{

void expect_no_trace_of_rejection(TimeRule rule, const char *tolerance, const Friction &friction = viscous)
{
  Problem adaptive, replayed;
  Recorder with(""), without("");
  const SolverOptions tight({{"-snes_rtol", "1e-13"}, {"-ts_dt", "0.5"}});
  {
    const SolverOptions options({std::pair<std::string, std::string>{"-ts_atol", tolerance}});
    run(scene_of(2, rule, friction), adaptive, with);
  }
  EXPECT_GE(adaptive.stepper.counts.rejected_steps, 1);
  const SolverOptions options({{"-ts_adapt_type", "none"}, {"-ts_dt", text_of(with.rows[1].time)}});
  Replay replay(with.rows);
  bool completed = false;
  std::string why;
  ASSERT_EQ(replayed.SetUp(PETSC_COMM_WORLD, scene_of(2, rule, friction)), 0);
  ASSERT_EQ(replayed.Run({&without, &replay}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
  EXPECT_EQ(replayed.stepper.counts.rejected_steps, 0);
  ASSERT_EQ(with.rows.size(), without.rows.size());
  for (std::size_t k = 0; k < with.rows.size(); ++k)
    EXPECT_NEAR(with.rows[k].time, without.rows[k].time, 1e-12);
  expect_same_end(adaptive, replayed, 1e-11);
}

} // namespace

TEST(history_commit, AStepRejectedForItsErrorLeavesNothingBehind)
{
  expect_no_trace_of_rejection(TimeRule::exponential_euler, "3e-3");
  expect_no_trace_of_rejection(TimeRule::sdirk2, "1e-4");
  expect_no_trace_of_rejection(TimeRule::exponential_euler, "3e-3", rate_and_state());
  expect_no_trace_of_rejection(TimeRule::sdirk2, "1e-4", rate_and_state());
}

} // namespace tribogel::test
