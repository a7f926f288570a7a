/// The coefficients read from a torque take the contact face of a mesh file as it is. A square of edge 1 with
/// the axis at its corner has <r> = (sqrt 2 + asinh 1)/3 and <r^2> = 2/3; the circle of its area has <r> =
/// 0.376 and <r^2> = 0.159.
#include "gmsh_texts.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

/// Turned by 0.02 rad, a fiftieth of the edge at the far corner.
Scene turned_cubes(int order)
{
  Scene scene = paper_scene(1, order);
  scene.model = Model::solid;
  scene.round = false;
  scene.plate_contact = false;
  scene.top.radius = scene.bottom.radius = std::sqrt(1 / std::numbers::pi);
  scene.top.height = scene.bottom.height = 1;
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{0.1}, {0}};
  scene.schedule = schedule_from_twists({1, 2}, {0.05, 0.05}, {0, 0.02});
  return scene;
}

} // namespace

TEST(mesh_face, WeighsTheTorqueByItsOwnMoments)
{
  const SolverOptions options(fixed_steps(0.5, 1e-9));
  for (const int order : {1, 2}) {
    const Scene scene = turned_cubes(order);
    Problem problem;
    Recorder recorder("");
    bool completed = false;
    std::string why;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, cubes()), 0);
    ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
    ASSERT_TRUE(completed) << why;
    const Measurement &m = recorder.rows.back().measurement;
    EXPECT_GT(m.torque, 0);
    const double r = (std::sqrt(2.0) + std::asinh(1.0)) / 3;
    EXPECT_NEAR(m.mu_apparent * r * m.normal_force / m.torque, 1, 1e-4); // four Gauss points along each edge
    EXPECT_NEAR(m.mu_gong * (2.0 / 3) / r * m.normal_force / m.torque, 1, 1e-4);
  }
}

/// A square on an equal one hangs over its edge as soon as it turns about the corner: by 0.02 rad with 1 % of
/// its area, by 0.3 rad with more than the 10 % that end a run.
TEST(mesh_face, IsKnownToHangOverTheEdgeBeforeItTurns)
{
  for (const double angle : {0.02, 0.3, -0.3}) {
    Scene scene = turned_cubes(1);
    scene.schedule = schedule_from_twists({1, 2}, {0.05, 0.05}, {0, angle});
    Problem problem;
    std::string objection;
    std::vector<std::string> doubts;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, cubes()), 0);
    ASSERT_EQ(problem.system.JudgeStart(problem.stepper.plates(0, 0), objection, doubts), 0);
    EXPECT_EQ(objection, "");
    ASSERT_EQ(doubts.size(), angle == 0.02 ? 0 : 1);
    for (const std::string &doubt : doubts)
      EXPECT_EQ(doubt.find("when the top plate has turned by "), 0) << doubt;
  }
  Scene scene = turned_cubes(1);
  scene.misalignment.offset = {0.05, 0};
  Problem problem;
  std::string objection;
  std::vector<std::string> doubts;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, cubes()), 0);
  ASSERT_EQ(problem.system.JudgeStart(problem.stepper.plates(0, 0), objection, doubts), 0);
  EXPECT_EQ(objection, "");
  ASSERT_EQ(doubts.size(), 1);
  EXPECT_EQ(doubts[0].find("the top gel hangs over the edge of the bottom gel with about "), 0) << doubts[0];
  double share = 0;
  ASSERT_EQ(problem.system.contact->AtRest(problem.stepper.plates(0, 0), share, objection), 0);
  EXPECT_NEAR(share, 0.05, 0.01); // Gauss points beyond the edge
}

} // namespace tribogel::test
