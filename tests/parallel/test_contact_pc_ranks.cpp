/// The preconditioner `contact` on several ranks: the numbers of a direct solver on one, and as good a start
/// for the Krylov method as there.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

struct Outcome {
  double N, T;
  int newton, linear;
};

Outcome outcome(MPI_Comm comm, const Scene &scene, const OptionList &given)
{
  OptionList options = newton_tolerance(1e-10);
  options.insert(options.end(), given.begin(), given.end());
  const SolverOptions solver(options);
  Problem problem;
  Recorder recorder("");
  bool completed = false;
  std::string why;
  EXPECT_EQ(problem.SetUp(comm, scene), 0);
  EXPECT_EQ(problem.Run({&recorder}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  if (!completed) return {};
  const Measurement &end = recorder.rows.back().measurement;
  return {end.normal_force, end.torque, problem.stepper.counts.newton_iterations,
          problem.stepper.counts.linear_iterations};
}

} // namespace

/// Nodes that slip and a rim that is open, on more ranks than some own contact on.
TEST(contact_pc_ranks, GivesTheNumbersOfADirectSolver)
{
  Scene scene = paper_scene(3, 1);
  scene.model = Model::solid;
  scene.mesh.grading = 1;
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{0.02, 8e-3}, {0, 1}};
  scene.schedule = schedule_from_rates({3}, {0.4}, {0.2});
  scene.schedule_kind = ScheduleKind::steady;
  const Outcome exact = outcome(PETSC_COMM_SELF, scene, {});
  EXPECT_GT(exact.N, 10);
  EXPECT_GT(exact.T, 1);
  for (const bool inner_is_exact : {true, false}) {
    OptionList options{{"-pc_type", "contact"},
                       {"-ksp_type", "gmres"},
                       {"-ksp_pc_side", "right"},
                       {"-ksp_gmres_restart", "200"}};
    if (inner_is_exact)
      options.insert(options.end(), {{"-ksp_rtol", "1e-8"},
                                     {"-condensed_pc_type", "lu"},
                                     {"-condensed_pc_factor_mat_solver_type", "mumps"}});
    else
      options.insert(options.end(), {{"-ksp_rtol", "1e-4"}, {"-condensed_pc_type", "gamg"}});
    const Outcome found = outcome(PETSC_COMM_WORLD, scene, options);
    EXPECT_NEAR(found.N, exact.N, 1e-9 * exact.N);
    EXPECT_NEAR(found.T, exact.T, 1e-9 * exact.N * scene.top.radius);
    EXPECT_LE(found.linear, (inner_is_exact ? 4 : 80) * found.newton);
    int rank;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0)
      std::printf("%s: %.3g of N, %.3g of N R; %d linear in %d Newton iterations\n",
                  inner_is_exact ? "lu" : "gamg", found.N / exact.N - 1,
                  (found.T - exact.T) / (exact.N * scene.top.radius), found.linear, found.newton);
  }
}

} // namespace tribogel::test
