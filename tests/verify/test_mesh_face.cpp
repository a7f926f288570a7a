/// The coefficients read from a torque take the contact face of a mesh file as it is. A square of edge 1 with the axis
/// at its corner has <r> = (sqrt 2 + asinh 1)/3 and <r^2> = 2/3; the circle of its area has <r> = 0.376 and
/// <r^2> = 0.159.
#include "gmsh_texts.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

TEST(mesh_face, WeighsTheTorqueByItsOwnMoments)
{
  const SolverOptions options(fixed_steps(0.5, 1e-9));
  for (const int order : {1, 2}) {
    Scene scene = paper_scene(1, order);
    scene.model = Model::solid;
    scene.round = false;
    scene.plate_contact = false;
    scene.top.radius = scene.bottom.radius = std::sqrt(1 / std::numbers::pi);
    scene.top.height = scene.bottom.height = 1;
    scene.top.material = scene.bottom.material = hyperelastic_gel();
    scene.friction = {{0.1}, {0}};
    scene.schedule = schedule_from_twists({1, 2}, {0.05, 0.05}, {0, 0.02});
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

} // namespace tribogel::test
