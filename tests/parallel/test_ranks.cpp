/// Any number of ranks gives the numbers of one: the same scene with equal fixed steps on all ranks of
/// PETSC_COMM_WORLD and, alone, on PETSC_COMM_SELF. Newton goes on to 1e-12 of the forces, the solver is
/// direct, so that what is left is the round-off of another order of summation: |dN| <= 1e-10 max N, |dT| <=
/// 1e-10 max N R at every step.
#include "hertz.hpp"
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/rate_and_state.hpp"

namespace tribogel::test
{

namespace
{

Scene scene_of(int order, double mu_0)
{
  Scene scene = paper_scene(6, order);
  scene.friction = PolynomialFriction<double>{{mu_0, 8e-3}, {0, 1}};
  scene.initial_gap = 0.05;
  scene.schedule = schedule_from_rates({3, 5, 9}, {0.47, 0.47, 0.53}, {0, 0.013, 0.27});
  return scene;
}

void run_on(MPI_Comm comm, const Scene &scene, const std::vector<MeridianBlock> &blocks, Problem &problem,
            Recorder &recorder)
{
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(comm, scene, blocks), 0);
  ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
}

int sum_over_ranks(int mine)
{
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  return mine;
}

class ranks : public ::testing::TestWithParam<std::pair<int, double>>
{
};

} // namespace

TEST_P(ranks, GiveTheNumbersOfOne)
{
  const auto [order, mu_0] = GetParam();
  const SolverOptions options({{"-snes_rtol", "1e-12"}, {"-ts_adapt_type", "none"}, {"-ts_dt", "0.5"}});
  const Scene scene = scene_of(order, mu_0);
  Problem shared, single;
  Recorder many(""), one("");
  run_on(PETSC_COMM_WORLD, scene, meridian_blocks(scene), shared, many);
  run_on(PETSC_COMM_SELF, scene, meridian_blocks(scene), single, one);

  ASSERT_EQ(many.rows.size(), one.rows.size());
  ASSERT_EQ(many.rows.size(), 19u); // the initial state and 18 steps of half a second
  double N = 0, dN = 0, dT = 0;
  for (std::size_t k = 0; k < one.rows.size(); ++k) {
    EXPECT_EQ(many.rows[k].time, one.rows[k].time);
    const Measurement &a = many.rows[k].measurement, &b = one.rows[k].measurement;
    N = std::max(N, std::abs(b.normal_force));
    dN = std::max(
        {dN, std::abs(a.normal_force - b.normal_force), std::abs(a.contact_force - b.contact_force)});
    dT = std::max({dT, std::abs(a.torque - b.torque), std::abs(a.contact_torque - b.contact_torque)});
  }
  EXPECT_GT(N, 10);
  EXPECT_GT(one.rows.back().measurement.torque, 1e-3 * N * scene.top.radius);
  EXPECT_LE(dN, 1e-10 * N);
  EXPECT_LE(dT, 1e-10 * N * scene.top.radius);
}

INSTANTIATE_TEST_SUITE_P(scenes, ranks,
                         ::testing::Values(std::pair{1, 0.0}, std::pair{2, 0.0}, std::pair{1, 0.07},
                                           std::pair{2, 0.07}));

/// So does what friction remembers: it is the same list on every rank.
TEST(ranks_memory, IsThatOfOne)
{
  RateAndStateFriction<double> law;
  law.set({{0.05}, {0.01}, {0.007}, {0.04}, {0.03}, {2}});
  const SolverOptions options(fixed_steps(0.5, 1e-12));
  Scene scene = scene_of(2, 0);
  scene.friction = law;
  Problem shared, single;
  Recorder many(""), one("");
  run_on(PETSC_COMM_WORLD, scene, meridian_blocks(scene), shared, many);
  run_on(PETSC_COMM_SELF, scene, meridian_blocks(scene), single, one);
  const std::vector<double> &ages = shared.stepper.state.friction_history.values,
                            &alone = single.stepper.state.friction_history.values;
  ASSERT_EQ(ages.size(), alone.size());
  ASSERT_GE(ages.size(), shared.system.mesh.slave.node.size());
  for (std::size_t k = 0; k < ages.size(); ++k) EXPECT_NEAR(ages[k] / alone[k], 1, 1e-8);
  EXPECT_LT(*std::min_element(ages.begin(), ages.end()), 2); // some have slid
  const Measurement &a = many.rows.back().measurement, &b = one.rows.back().measurement;
  EXPECT_NEAR(a.normal_force / b.normal_force, 1, 1e-10);
  EXPECT_NEAR(a.torque / b.torque, 1, 1e-9);
}

/// So does an outline that no option gives: a spherical cap of curved elements, pressed and turned.
TEST(ranks_outline, GivesTheNumbersOfOne)
{
  const SolverOptions options(fixed_steps(1, 1e-12));
  const HertzScene is{2, 0, {{0.1, 0.3}, {0, 1}}, 8, 0.05};
  const Scene scene = is.scene(schedule_from_twists({1, 2}, {is.approach(), is.approach()}, {0, 0.02}));
  Problem shared, single;
  Recorder many(""), one("");
  run_on(PETSC_COMM_WORLD, scene, is.blocks(), shared, many);
  run_on(PETSC_COMM_SELF, scene, is.blocks(), single, one);
  ASSERT_EQ(many.rows.size(), one.rows.size());
  for (const Node &node : shared.system.mesh.nodes)
    if (node.on(Side::slave)) {
      EXPECT_NEAR(std::hypot(node.X[0], node.X[1] - is.sphere()), is.sphere(), 1e-13 * is.sphere());
    }
  const Measurement &a = many.rows.back().measurement, &b = one.rows.back().measurement;
  EXPECT_GT(b.torque, 1e-3 * b.normal_force * is.a);
  EXPECT_NEAR(a.normal_force / b.normal_force, 1, 1e-9);
  EXPECT_NEAR(a.torque / b.torque, 1, 1e-9);
}

/// Each cell and each unknown has one rank; the load is shared.
TEST(ranks_partition, SharesTheCellsOut)
{
  int size;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  Problem shared, single;
  ASSERT_EQ(shared.SetUp(PETSC_COMM_WORLD, scene_of(2, 0)), 0);
  ASSERT_EQ(single.SetUp(PETSC_COMM_SELF, scene_of(2, 0)), 0);
  const int all = static_cast<int>(single.system.mesh.cells.size()),
            mine = static_cast<int>(shared.system.mesh.cells.size());
  EXPECT_EQ(sum_over_ranks(mine), all);
  EXPECT_NEAR(mine, static_cast<double>(all) / size, 1);
  int owned = 0;
  for (const Node &node : shared.system.mesh.nodes) owned += node.owned;
  EXPECT_EQ(sum_over_ranks(owned), static_cast<int>(single.system.mesh.nodes.size()));

  const double unknowns = static_cast<double>(shared.system.rows.group.size());
  EXPECT_EQ(sum_over_ranks(static_cast<int>(shared.system.rows.group.size())), shared.system.mesh.unknowns);
  EXPECT_EQ(shared.system.mesh.unknowns, single.system.mesh.unknowns);
  // Nodes between two ranks have one owner and multipliers are at the walls: 0.83 to 1.26 of an equal share
  // on 4 ranks.
  EXPECT_LE(unknowns, (size == 1 ? 1 : 1.3 / size) * single.system.mesh.unknowns);
  EXPECT_GE(unknowns, 0.8 / size * single.system.mesh.unknowns);
}

/// The contact surfaces are the same list on every rank, and every node of theirs has one owner.
TEST(ranks_partition, KnowsTheContactSurfacesEverywhere)
{
  Problem shared, single;
  ASSERT_EQ(shared.SetUp(PETSC_COMM_WORLD, scene_of(2, 0)), 0);
  ASSERT_EQ(single.SetUp(PETSC_COMM_SELF, scene_of(2, 0)), 0);
  for (const auto &[many, one] : {std::pair{&shared.system.mesh.slave, &single.system.mesh.slave},
                                  std::pair{&shared.system.mesh.master, &single.system.mesh.master}}) {
    ASSERT_EQ(many->node.size(), one->node.size());
    ASSERT_EQ(many->facet.size(), one->facet.size());
    for (std::size_t n = 0; n < one->node.size(); ++n) {
      EXPECT_EQ(many->node[n].X, one->node[n].X);
      EXPECT_EQ(many->node[n].multiplier, one->node[n].multiplier);
      EXPECT_EQ(sum_over_ranks(many->node[n].local >= 0), 1);
    }
  }
}

} // namespace tribogel::test
