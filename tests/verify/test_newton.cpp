/// Newton is quadratic at the end of a step: with e_k = |F_k| [N] after the active set (open, stick, slip of
/// every slave node) last changed, e_(k+1) <= C e_k^2 down to the round-off floor, and C [1/N] is the same to
/// a factor 10 over the steps of a phase. F is in newtons whatever the load, so C is |F''| |J^-1|^2 / 2 and
/// needs no scale.
///
/// C of a step is the largest e_(k+1) / e_k^2 of its pairs whose e_(k+1) lies above the floor. The floor is
/// where Newton stops when asked for 1e-14: 16 times the round-off of stresses and forces. A step counts with
/// three residuals above it. Steps that are small, or that start from the last step's motion, converge in
/// two: so -ts_atol 1.5e-3 makes larger ones and Newton starts from the last state. That the criterion can
/// fail is shown by keeping the matrix for two iterations: then convergence is linear.
///
/// The program keeps the matrix too, where one more iteration with it is foreseen to be enough.
#include "probe.hpp"

#include <limits>
#include <map>

namespace tribogel::test
{

namespace
{

struct Iterate {
  double residual, floor; ///< [N]
  std::vector<ContactStatus> active;
};

double norm(const Values &v)
{
  double sum = 0;
  for (double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// Collects C of the steps that count, by phase.
class NewtonWatch : public Observer
{
public:
  explicit NewtonWatch(Problem &watched) : problem(watched) {}

  static PetscErrorCode Monitor(SNES, PetscInt iteration, PetscReal residual, void *context)
  {
    auto &self = *static_cast<NewtonWatch *>(context);
    if (iteration == 0) self.iterates.clear();
    const double size = norm(Probe::values(self.problem.system.rows.magnitude));
    const double rounding = norm(Probe::values(self.problem.system.rows.round_off)) +
                            std::numeric_limits<double>::epsilon() * size;
    Iterate now{residual, 16 * rounding, {}};
    now.active = self.problem.system.contact->lower_face().statuses();
    self.iterates.push_back(std::move(now));
    return 0;
  }

  /// The last state, in place of the program's better guess.
  static PetscErrorCode StartAtRest(SNES, Vec U, void *context)
  {
    PetscFunctionBeginUser;
    PetscCall(VecCopy(static_cast<NewtonWatch *>(context)->problem.stepper.state.U, U));
    PetscFunctionReturn(0);
  }

  PetscErrorCode Start(const Problem &) override { return 0; }
  PetscErrorCode Step(const Problem &, const StepReport &) override
  {
    ++steps;
    std::size_t first = iterates.size() - 1;
    while (first > 0 && iterates[first - 1].active == iterates.back().active) --first;
    std::size_t end = first;
    while (end < iterates.size() && iterates[end].residual > iterates[end].floor) ++end;
    if (end < first + 3) return 0;
    double C = 0;
    for (std::size_t k = first; k + 1 < end; ++k)
      C = std::max(C, iterates[k + 1].residual / (iterates[k].residual * iterates[k].residual));
    constants[problem.stepper.state.phase].push_back(C);
    return 0;
  }

  Problem &problem;
  int steps = 0;
  std::map<int, std::vector<double>> constants;

private:
  std::vector<Iterate> iterates; ///< of the current solve
};

struct Outcome {
  std::size_t counted = 0;
  double spread = 1; ///< largest over smallest C of a phase, the worst phase
};

void watch(Scene scene, Outcome &outcome)
{
  scene.time.rule = TimeRule::exponential_euler; // one solve a step
  Problem problem;
  NewtonWatch newton(problem);
  SNES snes;
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  ASSERT_EQ(TSGetSNES(problem.stepper.ts, &snes), 0);
  ASSERT_EQ(SNESMonitorSet(snes, NewtonWatch::Monitor, &newton, nullptr), 0);
  ASSERT_EQ(SNESSetComputeInitialGuess(snes, NewtonWatch::StartAtRest, &newton), 0);
  ASSERT_EQ(problem.Run({&newton}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
  for (const auto &[phase, C] : newton.constants) {
    const auto [low, high] = std::minmax_element(C.begin(), C.end());
    outcome.counted += C.size();
    outcome.spread = std::max(outcome.spread, *high / *low);
    std::printf("phase %d: %zu steps count, C = %.2e ... %.2e 1/N\n", phase + 1, C.size(), *low, *high);
  }
  std::printf("order %d: %zu of %d steps count\n", scene.mesh.element_order, outcome.counted, newton.steps);
}

/// Counts the iterations with the matrix of the last one.
struct KeptMatrices {
  Problem &problem;
  PetscReal seen = 0; ///< its norm
  int iterations = 0, kept = 0, not_enough = 0;
  bool last_was_kept = false;

  static PetscErrorCode Monitor(SNES, PetscInt iteration, PetscReal, void *context)
  {
    auto &self = *static_cast<KeptMatrices *>(context);
    PetscReal norm;
    PetscFunctionBeginUser;
    PetscCall(MatNorm(self.problem.stepper.jacobian, NORM_FROBENIUS, &norm));
    if (iteration > 0) {
      ++self.iterations;
      self.not_enough += self.last_was_kept;
      self.last_was_kept = norm == self.seen;
      self.kept += self.last_was_kept;
    } else
      self.last_was_kept = false;
    self.seen = norm;
    PetscFunctionReturn(0);
  }
};

const std::vector<std::pair<std::string, std::string>> to_the_floor = {{"-snes_rtol", "1e-14"},
                                                                       {"-ts_atol", "1.5e-3"}};

} // namespace

TEST(newton, IsQuadraticOnThePaperSchedule)
{
  const SolverOptions options(to_the_floor);
  for (int order : {2, 1}) {
    Outcome outcome;
    watch(paper_scene(order == 2 ? 6 : 12, order), outcome);
    EXPECT_GE(outcome.counted, 20u) << "order " << order;
    EXPECT_LE(outcome.spread, 10) << "order " << order;
  }
}

/// In space the cells in which surfaces meet are cut otherwise from one iterate to the next, which may not be
/// seen.
TEST(newton, IsQuadraticInSpace)
{
  const SolverOptions options({{"-snes_rtol", "1e-14"}, {"-ts_atol", "1e-2"}});
  for (int order : {1, 2}) {
    Scene scene = paper_scene(order == 2 ? 2 : 3, order);
    scene.model = Model::solid;
    scene.plate_contact = false;
    scene.mesh.grading = 1;
    scene.schedule = schedule_from_rates({27, 81, 108}, {0.79, 0.79, 0.79}, {0, 0, 0.1});
    Outcome outcome;
    watch(scene, outcome);
    EXPECT_GE(outcome.counted, 10u) << "order " << order;
    EXPECT_LE(outcome.spread, 10) << "order " << order;
  }
}

TEST(newton, IsSeenToBeLinearWithAnOldMatrix)
{
  const SolverOptions options(to_the_floor);
  const SolverOptions old({{"-snes_lag_jacobian", "2"}, {"-snes_max_it", "60"}});
  Scene scene = paper_scene(6);
  scene.schedule.resize(1);
  Outcome outcome;
  watch(scene, outcome);
  EXPECT_GE(outcome.counted, 20u);
  EXPECT_GT(outcome.spread, 10);
}

TEST(newton, KeepsTheMatrixWhereOneMoreIterationIsEnough)
{
  const Scene scene = paper_scene(6);
  Problem problem;
  KeptMatrices watched{problem};
  SNES snes;
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  ASSERT_EQ(TSGetSNES(problem.stepper.ts, &snes), 0);
  ASSERT_EQ(SNESMonitorSet(snes, KeptMatrices::Monitor, &watched, nullptr), 0);
  ASSERT_EQ(problem.Run({}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
  std::printf("%d iterations, %d with an old matrix, not enough: %d\n", watched.iterations, watched.kept,
              watched.not_enough);
  EXPECT_GE(watched.kept, watched.iterations / 10);
  EXPECT_LE(watched.not_enough, watched.kept / 4);
}

} // namespace tribogel::test
