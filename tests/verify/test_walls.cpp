/// Side walls at the plates and on the other gel. For elastic gels without slip the work of the plate is the
/// stored energy, so N = dE/d(approach) exactly: it holds only if the walls' forces do no work against their
/// constraints and are counted in N.
#include "solver_options.hpp"
#include "wall_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

/// Stored energy at each phase's end [N mm].
class EnergyWatch : public Observer
{
public:
  std::vector<double> stored;
  PetscErrorCode Start(const Problem &) override { return 0; }
  PetscErrorCode Step(const Problem &problem, const StepReport &report) override
  {
    if (report.ends_phase) stored.push_back(problem.stepper.state.stored);
    return 0;
  }
};

struct Outcome {
  std::vector<PhaseEnd> phases;
  std::vector<double> stored;
  double beyond; ///< deepest wall node past a plate [mm]
  double wall_force;
};

/// How far wall nodes stand beyond the planes of the plates, and the walls' force on the top plate.
void inspect(Problem &problem, Outcome &outcome)
{
  Vec U, Udot;
  const PetscScalar *u, *rate;
  ASSERT_EQ(DMGetLocalVector(problem.system.mesh.dm, &U), 0);
  ASSERT_EQ(DMGetLocalVector(problem.system.mesh.dm, &Udot), 0);
  ASSERT_EQ(problem.stepper.LocalState(U, Udot), 0);
  ASSERT_EQ(VecGetArrayRead(U, &u), 0);
  ASSERT_EQ(VecGetArrayRead(Udot, &rate), 0);
  const Scene &scene = problem.system.scene;
  const double travel = problem.stepper.phase().end_approach;
  outcome.beyond = 0;
  for (const Node &node : problem.system.mesh.nodes) {
    const double z = node.X[1] + u[node.displacement + 2]; // in the frame of the body's plate
    const double top = scene.has_top() ? scene.top.height + scene.initial_gap : -travel;
    outcome.beyond = std::max({outcome.beyond, -scene.bottom.height - z, z - top});
  }
  outcome.wall_force = 0;
  if (problem.system.contact) {
    ContactResults results;
    ASSERT_EQ(problem.system.contact->Results(problem.stepper.plates(problem.stepper.state.time, 1), u, rate,
                                              results),
              0);
    outcome.wall_force = -results.wall.force[2];
  }
  ASSERT_EQ(VecRestoreArrayRead(Udot, &rate), 0);
  ASSERT_EQ(VecRestoreArrayRead(U, &u), 0);
  ASSERT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &Udot), 0);
  ASSERT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &U), 0);
}

Outcome outcome_of(const Scene &scene)
{
  Problem problem;
  Recorder recorder("");
  EnergyWatch energy;
  bool completed = false;
  std::string why;
  Outcome outcome{};
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  EXPECT_EQ(problem.Run({&recorder, &energy}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  if (!completed) return outcome;
  outcome.phases = recorder.phases;
  outcome.stored = energy.stored;
  inspect(problem, outcome);
  return outcome;
}

Scene single_gel(int order)
{
  Scene scene = paper_scene(order == 1 ? 12 : 7, order);
  scene.arrangement = Arrangement::single_gel;
  scene.bottom = {10, 8, hyperelastic_gel()};
  scene.mesh.grading = 6;
  scene.schedule = around(2.4, 0.01);
  return scene;
}

} // namespace

/// A soft gel stuck on a stiff one, or on a plane, whose wall rolls on.
void expect_rolling(const Scene &scene)
{
  Problem problem;
  Recorder recorder("");
  EnergyWatch energy;
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  ASSERT_EQ(problem.Run({&recorder, &energy}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
  const Measurement &middle = recorder.phases[1].measurement;
  EXPECT_LE(std::abs(middle.force_mismatch()), 1e-8 * middle.normal_force);
  EXPECT_NEAR((energy.stored[2] - energy.stored[0]) / 0.02 / middle.normal_force, 1, 2e-3);
  int rolled = 0;
  double crease = 0;
  for (const ProfileRow &row : recorder.last_profile) {
    if (std::string(row.surface) != "top") continue;
    if (row.reference_z == 0) crease = std::max(crease, row.r);
    if (row.reference_z > 0 && row.pressure > 0) {
      ++rolled;
      EXPECT_GT(row.r, crease);
      EXPECT_EQ(row.status, std::string("stick"));
    }
  }
  EXPECT_GE(rolled, scene.model == Model::axisymmetric ? 2 : 16); // in space a ring of nodes
}

class walls : public ::testing::TestWithParam<int>
{
};

TEST_P(walls, DoNotPassThroughThePlatesAndPressOnThem)
{
  const SolverOptions options(newton_tolerance(1e-11));
  Scene scene = single_gel(GetParam());
  const Outcome with = outcome_of(scene);
  ASSERT_EQ(with.phases.size(), 3u);
  EXPECT_LE(with.beyond, 1e-10);
  const double N = with.phases[1].measurement.normal_force;
  EXPECT_GT(with.wall_force, 0.01 * N);
  EXPECT_NEAR((with.stored[2] - with.stored[0]) / 0.02 / N, 1, 1e-4);
  scene.plate_contact = false;
  EXPECT_GT(outcome_of(scene).beyond, 0.01);
}

TEST_P(walls, RollOntoTheOtherGelWithoutLossOfForceOrEnergy)
{
  const SolverOptions options(newton_tolerance(1e-11));
  expect_rolling(mushroom(GetParam()));
}

TEST_P(walls, RollOntoARigidPlaneWithoutLossOfForceOrEnergy)
{
  const SolverOptions options(newton_tolerance(1e-11));
  Scene scene = mushroom(GetParam());
  scene.arrangement = Arrangement::gel_on_rigid;
  scene.schedule = around(2, 0.01);
  expect_rolling(scene);
}

TEST(walls_in_space, RollOntoTheOtherGelWithoutLossOfForceOrEnergy)
{
  Scene scene = mushroom(1);
  scene.model = Model::solid;
  scene.mesh.elements_radial = 4;
  scene.mesh.bottom_elements_radial = 5;
  scene.mesh.grading = 2;
  expect_rolling(scene);
}

INSTANTIATE_TEST_SUITE_P(order, walls, ::testing::Values(1, 2));

} // namespace tribogel::test
