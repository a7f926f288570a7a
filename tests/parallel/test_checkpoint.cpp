/// A run that goes on from a checkpoint is the run that was never interrupted: on one rank bit for bit, on
/// others to the round-off of another order of summation (MUMPS on several ranks sums in the order in which
/// messages come). Checkpoints are written by all ranks of PETSC_COMM_WORLD and read by each rank alone, and
/// the other way round.
#include "observe/checkpoint.hpp"
#include "probe.hpp"
#include "support/user_error.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/rate_and_state.hpp"

#include <filesystem>

#include <unistd.h>

namespace tribogel::test
{

namespace
{

constexpr double stop_time = 3.4; // in the midst of the second phase [s]

Scene scene_of(int order, bool both)
{
  Scene scene = paper_scene(5, order);
  if (!both) scene.arrangement = Arrangement::single_gel;
  scene.friction = PolynomialFriction<double>{{0.05, 8e-3}, {0, 1}};
  if (both) scene.bottom.material = hyperelastic_gel(); // cells with and without history
  scene.schedule = schedule_from_rates({2, 5, 9}, {0.3, 0.47, 0.53}, {0, 0.013, 0.27});
  return scene;
}

Friction rate_and_state()
{
  RateAndStateFriction<double> law;
  law.set({{0.05}, {0.01}, {0.007}, {0.04}, {0.03}, {2}});
  return law;
}

/// Asks for a stop.
class Stop : public Observer
{
public:
  PetscErrorCode Start(const Problem &) override { return 0; }
  PetscErrorCode Step(const Problem &problem, const StepReport &) override
  {
    if (problem.stepper.state.time > stop_time) stop.request("enough");
    return 0;
  }
};

/// A directory that the ranks of a communicator share.
class Directory
{
public:
  explicit Directory(MPI_Comm on) : comm(on)
  {
    int number = static_cast<int>(getpid());
    MPI_Bcast(&number, 1, MPI_INT, 0, comm);
    path = std::filesystem::temp_directory_path() / ("tribogel-checkpoint-" + std::to_string(number));
    std::filesystem::create_directories(path);
  }
  ~Directory()
  {
    int rank;
    MPI_Comm_rank(comm, &rank);
    MPI_Barrier(comm);
    if (rank == 0) std::filesystem::remove_all(path);
  }
  std::filesystem::path path;

private:
  MPI_Comm comm;
};

struct StoppedRun {
  Problem problem;
  Recorder recorder;
  Checkpoint checkpoint;

  StoppedRun(MPI_Comm comm, const Scene &scene, const std::string &directory)
      : recorder(directory), checkpoint(recorder, output(directory), "{}", "mesh", MPI_Wtime())
  {
    Stop stop;
    bool completed = true;
    std::string why;
    EXPECT_EQ(problem.SetUp(comm, scene), 0);
    EXPECT_EQ(problem.Run({&recorder, &stop}, completed, why), 0);
    EXPECT_FALSE(completed);
    EXPECT_EQ(why, "enough");
    EXPECT_EQ(problem.stepper.state.phase, 1);
    EXPECT_GE(problem.stepper.state.steps_in_phase, 2);
    EXPECT_LT(problem.stepper.state.time, problem.stepper.phase().end_time);
    EXPECT_EQ(checkpoint.Write(problem), 0);
  }
  static OutputSettings output(const std::string &directory)
  {
    std::filesystem::create_directories(directory);
    OutputSettings parameters;
    parameters.directory = directory;
    return parameters;
  }
};

struct ContinuedRun {
  Problem problem;
  Recorder recorder;
  Checkpoint checkpoint;

  /// Each run has files of its own: a copy of the stopped one's.
  ContinuedRun(MPI_Comm comm, const Scene &scene, const std::string &stopped, const std::string &directory)
      : recorder(directory), checkpoint(recorder, StoppedRun::output(directory), "{}", "mesh", MPI_Wtime())
  {
    int rank;
    MPI_Comm_rank(comm, &rank);
    if (rank == 0) std::filesystem::copy(stopped, directory);
    StoredRun stored;
    EXPECT_EQ(problem.SetUp(comm, scene), 0);
    EXPECT_EQ(ReadStoredRun(comm, directory, stored), 0);
    EXPECT_EQ(checkpoint.Restore(stored, problem), 0);
  }
  void finish()
  {
    bool completed = false;
    std::string why;
    EXPECT_EQ(problem.Run({&recorder, &checkpoint}, completed, why), 0);
    EXPECT_TRUE(completed) << why;
  }
};

void expect_same_state(const State &a, const State &b)
{
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.steps_in_phase, b.steps_in_phase);
  for (double State::*member : {&State::time, &State::step, &State::step_before, &State::next_step})
    EXPECT_EQ(a.*member, b.*member);
  for (VecHandle State::*member : {&State::U, &State::Udot, &State::Udot_before}) {
    EXPECT_EQ(Probe::values(a.*member), Probe::values(b.*member));
    PetscReal size;
    EXPECT_EQ(VecNorm(a.*member, NORM_INFINITY, &size), 0);
    EXPECT_GT(size, 0);
  }
  EXPECT_EQ(a.history, b.history);
  EXPECT_EQ(a.friction_history, b.friction_history);
  EXPECT_EQ(a.loads, b.loads);
  EXPECT_EQ(a.load_rates, b.load_rates);
  EXPECT_EQ(a.largest, b.largest);
}

double sum_over(MPI_Comm comm, double share)
{
  MPI_Allreduce(MPI_IN_PLACE, &share, 1, MPI_DOUBLE, MPI_SUM, comm);
  return share;
}

/// Largest differences relative to the largest N, T = N R, work.
void expect_same_rows(const std::vector<HistoryRow> &a, const std::vector<HistoryRow> &b, double R,
                      double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  double N = 0, work = 0, difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].phase, b[k].phase);
    EXPECT_NEAR(a[k].time, b[k].time, tolerance * b[k].time);
    EXPECT_EQ(a[k].report.newton_iterations, b[k].report.newton_iterations);
    const Measurement &m = a[k].measurement, &n = b[k].measurement;
    N = std::max(N, std::abs(n.normal_force));
    work = std::max(work, std::abs(b[k].energy.work));
    difference =
        std::max({difference, std::abs(m.normal_force - n.normal_force), std::abs(m.torque - n.torque) / R});
    for (double EnergyBalance::*part :
         {&EnergyBalance::work, &EnergyBalance::stored, &EnergyBalance::viscous, &EnergyBalance::friction})
      EXPECT_NEAR(a[k].energy.*part, b[k].energy.*part, 1e-10 * work);
  }
  EXPECT_GT(N, 10);
  EXPECT_LE(difference, tolerance * N);
}

struct Case {
  int order;
  bool both; ///< gels
  bool remembers = false;

  Scene scene() const
  {
    Scene scene = scene_of(order, both);
    if (remembers) scene.friction = rate_and_state();
    return scene;
  }
};

class checkpoint_ranks : public ::testing::TestWithParam<Case>
{
protected:
  const Scene scene = GetParam().scene();
  const SolverOptions options = SolverOptions(fixed_steps(0.5, 1e-12));
  const Directory directory{PETSC_COMM_WORLD};
  const double R = scene.twist_length();

  Problem uninterrupted;
  Recorder whole{""};
  void SetUp() override { run(scene, uninterrupted, whole); }
};

} // namespace

TEST_P(checkpoint_ranks, GoesOnAsItWasOnTheSameRanks)
{
  StoppedRun stopped(PETSC_COMM_WORLD, scene, directory.path / "stopped");
  ContinuedRun continued(PETSC_COMM_WORLD, scene, directory.path / "stopped", directory.path / "goes_on");
  expect_same_state(continued.problem.stepper.state, stopped.problem.stepper.state);
  for (double State::*share : {&State::stored, &State::dissipated}) {
    const double all = sum_over(PETSC_COMM_WORLD, stopped.problem.stepper.state.*share);
    EXPECT_GT(all, 0);
    EXPECT_EQ(sum_over(PETSC_COMM_WORLD, continued.problem.stepper.state.*share), all);
  }
  EXPECT_EQ(continued.problem.stepper.counts.newton_iterations,
            stopped.problem.stepper.counts.newton_iterations);
  continued.finish();
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  expect_same_rows(continued.recorder.rows, whole.rows, R, size == 1 ? 0 : 1e-12);
  EXPECT_EQ(continued.problem.stepper.counts.accepted_steps, uninterrupted.stepper.counts.accepted_steps);
  EXPECT_EQ(continued.problem.stepper.counts.newton_iterations,
            uninterrupted.stepper.counts.newton_iterations);
  ASSERT_EQ(continued.recorder.phases.size(), whole.phases.size());
  for (std::size_t k = 0; k < whole.phases.size(); ++k)
    EXPECT_EQ(continued.recorder.phases[k].time, whole.phases[k].time);
}

TEST_P(checkpoint_ranks, GoesOnAloneFromTheCheckpointOfMany)
{
  StoppedRun stopped(PETSC_COMM_WORLD, scene, directory.path / "stopped");
  int rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  ContinuedRun continued(PETSC_COMM_SELF, scene, directory.path / "stopped",
                         directory.path / ("alone" + std::to_string(rank)));
  continued.finish();
  expect_same_rows(continued.recorder.rows, whole.rows, R, 1e-12);
}

TEST_P(checkpoint_ranks, GoesOnOnManyFromTheCheckpointOfOne)
{
  int rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0) StoppedRun(PETSC_COMM_SELF, scene, directory.path / "stopped");
  MPI_Barrier(PETSC_COMM_WORLD);
  ContinuedRun continued(PETSC_COMM_WORLD, scene, directory.path / "stopped", directory.path / "goes_on");
  continued.finish();
  expect_same_rows(continued.recorder.rows, whole.rows, R, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(scenes, checkpoint_ranks,
                         ::testing::Values(Case{1, true}, Case{2, true}, Case{2, false},
                                           Case{1, true, true}));

/// A checkpoint of another mesh is refused, on all ranks.
TEST(checkpoint_scene, MustFit)
{
  const SolverOptions options(fixed_steps(0.5, 1e-9));
  const Directory directory(PETSC_COMM_WORLD);
  StoppedRun stopped(PETSC_COMM_WORLD, scene_of(2, true), directory.path / "stopped");
  Scene other = scene_of(2, true);
  other.mesh.elements_radial = 4;
  StoredRun stored;
  Problem problem;
  Recorder recorder(directory.path / "stopped");
  Checkpoint checkpoint(recorder, StoppedRun::output(directory.path / "stopped"), "{}", "mesh", MPI_Wtime());
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, other), 0);
  ASSERT_EQ(ReadStoredRun(PETSC_COMM_WORLD, directory.path / "stopped", stored), 0);
  EXPECT_THROW(checkpoint.Restore(stored, problem), UserError);
}

} // namespace tribogel::test
