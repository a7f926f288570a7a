/// Force and torque balance: in each row of a run of the paper scene the top plate's reactions equal the
/// resultants of the contact tractions, and those of the bottom plate. The differences are sums of the
/// residuals that Newton's method leaves in the gels, so they follow the solver's tolerance and nothing else.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tribogel::test
{

namespace
{

Scene shortened(int elements_radial, int order = 2)
{
  Scene scene = paper_scene(elements_radial, order);
  scene.time.tolerance = 0.01; // many rows
  scene.schedule = schedule_from_rates({27, 200, 300, 350}, {0.79, 0.79, 0.79, 0.7}, {0, 0, 0.04, 0.9});
  return scene;
}

/// Sum over both plates of the reactions [N] and [N mm] after each step, the largest so far.
class PlateSum : public Observer
{
public:
  PetscErrorCode Start(const Problem &) override { return 0; }

  PetscErrorCode Step(const Problem &problem, const StepReport &) override
  {
    Vec U, Udot, forces, sizes;
    PetscScalar *u, *f, *s;
    PetscFunctionBeginUser;
    for (Vec *v : {&U, &Udot, &forces, &sizes}) PetscCall(DMGetLocalVector(problem.system.mesh.dm, v));
    PetscCall(problem.stepper.LocalState(U, Udot));
    PetscCall(VecZeroEntries(forces));
    PetscCall(VecGetArray(U, &u));
    PetscCall(VecGetArray(forces, &f));
    PetscCall(VecGetArray(sizes, &s));
    problem.system.bulk->AddResidual(u, problem.stepper.state.history, {0}, f, s);
    double sum[2] = {0, 0};
    for (const Node &node : problem.system.mesh.nodes)
      if (node.on(Side::top_plate) || node.on(Side::bottom_plate))
        for (int i = 0; i < 2; ++i) sum[i] += f[node.displacement + 2 - i];
    force = std::max(force, std::abs(sum[0]));
    torque = std::max(torque, std::abs(sum[1]) * problem.system.scene.twist_length());
    PetscCall(VecRestoreArray(sizes, &s));
    PetscCall(VecRestoreArray(forces, &f));
    PetscCall(VecRestoreArray(U, &u));
    for (Vec *v : {&U, &Udot, &forces, &sizes}) PetscCall(DMRestoreLocalVector(problem.system.mesh.dm, v));
    PetscFunctionReturn(0);
  }

  double force = 0, torque = 0;
};

/// Largest mismatches over the rows, of the top plate with the contact and of the two plates, over the
/// largest N and T.
std::array<double, 2> mismatch(const Scene &scene, double tolerance)
{
  const SolverOptions options(newton_tolerance(tolerance));
  Problem problem;
  Recorder recorder("");
  PlateSum plates;
  bool completed = false;
  std::string why;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  EXPECT_EQ(problem.Run({&recorder, &plates}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  double N = 0, T = 0, force = plates.force, torque = plates.torque;
  for (const HistoryRow &row : recorder.rows) {
    N = std::max(N, row.measurement.normal_force);
    T = std::max(T, std::abs(row.measurement.torque));
    force = std::max(force, std::abs(row.measurement.force_mismatch()));
    torque = std::max(torque, std::abs(row.measurement.torque_mismatch()));
  }
  EXPECT_GT(N, 10);
  EXPECT_GT(T, 1);
  EXPECT_GT(recorder.rows.size(), 50u);
  return {force / N, torque / T};
}

void expect_balance(const Scene &scene)
{
  for (const double tolerance : {1e-5, 1e-10}) {
    const auto [force, torque] = mismatch(scene, tolerance);
    EXPECT_LE(force, 30 * tolerance);
    EXPECT_LE(torque, 30 * tolerance);
  }
}

} // namespace

TEST(balance, ViscousFriction)
{
  expect_balance(shortened(4));
}

TEST(balance, Order1AndCoarserBottom)
{
  Scene scene = shortened(6, 1);
  scene.mesh.bottom_elements_radial = 4;
  expect_balance(scene);
}

TEST(balance, ViscousFrictionAfterAnInitialGap)
{
  Scene scene = shortened(4);
  scene.initial_gap = 0.23;
  for (Phase &phase : scene.schedule) {
    phase.end_approach += scene.initial_gap;
    if (phase.start_approach > 0) phase.start_approach += scene.initial_gap;
  }
  expect_balance(scene);
}

TEST(balance, CoulombFriction)
{
  Scene scene = shortened(4);
  scene.friction = PolynomialFriction<double>{{2.6e-4, 1e-5}, {0, 2}};
  expect_balance(scene);
}

} // namespace tribogel::test
