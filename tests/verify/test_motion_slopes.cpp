/// dF/d(travel) and dF/d(angle) of the top plate, which control of force and torque needs, against central
/// differences of the assembled residual, at states that are perturbed so that no term vanishes: with open,
/// sticking and slipping nodes, a law that feels the current area, the bottom plate turning too, in the half
/// plane and in space (there with the plates' axes apart and turned), on a gel and on a rigid plane, and
/// where the wall rolls on. A plate that moves by h in a step moves at a rate that is shift h higher.
#include "probe.hpp"
#include "wall_scenes.hpp"

namespace tribogel::test
{

namespace
{

Scene scene_of(Model model, int order, Arrangement arrangement)
{
  const bool solid = model == Model::solid;
  Scene scene = paper_scene(solid ? 3 : order == 1 ? 8 : 5, order);
  scene.model = model;
  scene.arrangement = arrangement;
  scene.bottom.material = hyperelastic_gel();
  scene.initial_gap = 0.02;
  scene.friction = PolynomialFriction<double>{{0.83, 0.07}, {0, 1}, 0.4, 0.3};
  scene.schedule = schedule_from_rates({2.3, 4.1}, {0.21, 0.27}, {0.013, 0.17});
  scene.bottom_plate_rate = 0.021;
  scene.mesh.grading = solid ? 1 : 2;
  scene.mesh.bottom_elements_radial = scene.mesh.elements_radial + 1;
  if (solid && arrangement == Arrangement::gel_on_gel) scene.misalignment.offset = {0.4, -0.3};
  return scene;
}

/// Residual, or columns, in global vectors.
class Moved
{
public:
  Moved(Problem &of, double step, double displacement, double traction)
      : problem(of), shift(1 / step), time(of.stepper.state.time + step)
  {
    Vec U, Udot;
    PetscInt size;
    std::mt19937 random(20);
    std::uniform_real_distribution<double> in(-1, 1);
    EXPECT_EQ(DMGetLocalVector(problem.system.mesh.dm, &U), 0);
    EXPECT_EQ(DMGetLocalVector(problem.system.mesh.dm, &Udot), 0);
    EXPECT_EQ(problem.stepper.LocalState(U, Udot), 0);
    EXPECT_EQ(VecGetLocalSize(U, &size), 0);
    u = Probe::values(U);
    rate.assign(u.size(), 0.0);
    EXPECT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &Udot), 0);
    EXPECT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &U), 0);
    for (const Node &node : problem.system.mesh.nodes)
      for (int i = 0; i < 3; ++i) {
        const bool free = !(node.prescribed >> i & 1u);
        const double moved = free ? displacement * in(random) : 0;
        u[node.displacement + i] += moved;
        rate[node.displacement + i] = shift * moved;
        if (node.traction >= 0) u[node.traction + i] += traction * in(random);
      }
  }

  Values residual(double travel, double angle)
  {
    EulerSolve solve = problem.stepper.solve(time);
    solve.plates.step = 1 / shift;
    solve.plates.top_travel += travel;
    solve.plates.top_travel_rate += shift * travel;
    solve.plates.top_rotation += angle;
    solve.plates.top_rate += shift * angle;
    Values F(u.size(), 0.0), sizes(u.size(), 0.0);
    EXPECT_EQ(problem.system.AddResidual(solve, u.data(), rate.data(), F.data(), sizes.data()), 0);
    EXPECT_FALSE(problem.system.failure) << problem.system.failure.contact;
    return F;
  }

  std::array<Values, 2> slopes()
  {
    EulerSolve solve = problem.stepper.solve(time);
    solve.plates.step = 1 / shift;
    std::array<Values, 2> columns{Values(u.size(), 0.0), Values(u.size(), 0.0)};
    EXPECT_EQ(problem.system.AddMotionSlopes(solve, u.data(), rate.data(), shift, columns[0].data(),
                                             columns[1].data()),
              0);
    return columns;
  }

private:
  Problem &problem;
  double shift, time;
  Values u, rate;
};

void check(const Scene &scene, double displacement, double traction)
{
  const SolverOptions equal_steps({{"-ts_adapt_type", "none"}, {"-ts_dt", "0.5"}});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  Moved moved(problem, 0.37, displacement, traction);
  const auto columns = moved.slopes();
  for (int motion = 0; motion < 2; ++motion) {
    const double h = motion == 0 ? 2e-5 : 2e-5 / scene.twist_length();
    Values difference(columns[0].size(), 0.0);
    for (const auto &[at, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      const Values F = moved.residual(motion == 0 ? at * h : 0, motion == 1 ? at * h : 0);
      for (std::size_t k = 0; k < F.size(); ++k) difference[k] += weight * F[k] / (12 * h);
    }
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < difference.size(); ++k) {
      largest = std::max(largest, std::abs(difference[k]));
      error = std::max(error, std::abs(difference[k] - columns[motion][k]));
    }
    EXPECT_GT(largest, 1e-3) << "motion " << motion;
    EXPECT_LE(error / largest, 1e-7) << "motion " << motion; // round-off of the residual over h
  }
}

} // namespace

class motion_slopes : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(order, motion_slopes, ::testing::Values(1, 2));

TEST_P(motion_slopes, HalfPlane)
{
  for (const Arrangement arrangement : {Arrangement::gel_on_gel, Arrangement::gel_on_rigid})
    check(scene_of(Model::axisymmetric, GetParam(), arrangement), 0.011, 1.3);
}

TEST_P(motion_slopes, Space)
{
  for (const Arrangement arrangement : {Arrangement::gel_on_gel, Arrangement::gel_on_rigid})
    check(scene_of(Model::solid, GetParam(), arrangement), 0.011, 1.3);
}

TEST_P(motion_slopes, RollingWall)
{
  check(mushroom(GetParam()), 1e-4, 0.1);
}

} // namespace tribogel::test
