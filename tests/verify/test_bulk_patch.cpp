/// What the discrete bulk must reproduce to round-off, whatever the mesh.
///
/// Patch: on lubricated plates a compressed cylinder is uniform, F = diag(mu, mu, lambda), with mu from
/// sigma_r = 0. With the principal Kirchhoff stresses of the Ogden law, b = J^(-1/3) (mu, mu, lambda) and J =
/// mu^2 lambda:
///
///   sum_r G_r (b_1^alpha_r - (2 b_1^alpha_r + b_3^alpha_r)/3) + K/2 (J^2 - 1) = 0,   N = -pi a^2
///   tau_3/lambda
///
/// solved here by bisection, on a mesh whose inner vertices are moved.
///
/// Frame: turning and lifting the whole body leaves every nodal force as it is. In any state at all the
/// nodal forces have no resultant along Z and no moment about Z.
#include "bulk_scenes.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 4.5, height = 3, lambda = 0.73;
constexpr int elements = 6;

/// Principal Kirchhoff stress tau_A of diag(mu, mu, lambda); A = 0 or 2.
double kirchhoff(const Ogden<double> &ogden, double mu, int A)
{
  const double J = mu * mu * lambda, b[3] = {mu / std::cbrt(J), mu / std::cbrt(J), lambda / std::cbrt(J)};
  double tau = ogden.bulk_modulus / 2 * (J * J - 1);
  for (std::size_t r = 0; r < ogden.moduli.size(); ++r) {
    const double alpha = ogden.exponents[r];
    tau +=
        ogden.moduli[r] * (std::pow(b[A], alpha) - (2 * std::pow(b[0], alpha) + std::pow(b[2], alpha)) / 3);
  }
  return tau;
}

double lateral_stretch(const Ogden<double> &ogden)
{
  double low = 0.9, high = 1.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (kirchhoff(ogden, middle, 0) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A smooth state without symmetry, far from small, in a local array.
std::vector<double> some_state(const Mesh &mesh)
{
  std::vector<double> U(3 * mesh.nodes.size());
  for (const Node &node : mesh.nodes) {
    const double R = node.X[0], Z = node.X[1];
    U[node.displacement] = 0.08 * R * std::cos(0.4 * R + 0.9 * Z);
    U[node.displacement + 1] = 0.7 * std::sin(0.8 * Z - 0.2 * R) + 0.1 * R;
    U[node.displacement + 2] = 0.25 * std::sin(0.5 * R - 0.7 * Z);
  }
  return U;
}

void set_up_distorted(Problem &problem, const Scene &scene)
{
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  distort(problem.system.mesh, a, height, a / elements, 0.2);
  ASSERT_EQ(Bulk::Create(problem.system.mesh, problem.system.scene, problem.system.bulk), 0);
}

struct Forces {
  std::vector<double> F, magnitude;
};

Forces forces(const Problem &problem, const std::vector<double> &U)
{
  Forces f{std::vector<double>(U.size(), 0), std::vector<double>(U.size(), 0)};
  EXPECT_FALSE(problem.system.bulk->AddResidual(U.data(), problem.stepper.state.history, {0.37}, f.F.data(),
                                                f.magnitude.data()));
  return f;
}

Scene at_rest(const Viscoelastic<double> &material, int order)
{
  Scene scene = cylinder(a, height, material, order, elements);
  scene.schedule = schedule_from_twists({1}, {0}, {0});
  return scene;
}

} // namespace

TEST(bulk_patch, UniformStateIsExactOnADistortedMesh)
{
  const Ogden<double> ogden = hyperelastic_gel().equilibrium;
  const double mu = lateral_stretch(ogden);
  const double N = -std::numbers::pi * a * a * kirchhoff(ogden, mu, 2) / lambda;
  for (int order : {1, 2}) {
    Scene scene = at_rest(hyperelastic_gel(), order);
    scene.plate_bond = PlateBond::lubricated;
    scene.schedule = schedule_from_twists({2}, {(1 - lambda) * height}, {0});
    const SolverOptions options(fixed_steps(0.5, 1e-13));
    Problem problem;
    Recorder recorder("");
    bool completed = false;
    std::string why;
    ASSERT_NO_FATAL_FAILURE(set_up_distorted(problem, scene));
    ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
    ASSERT_TRUE(completed) << why;
    EXPECT_NEAR(recorder.rows.back().measurement.normal_force / N, 1, 1e-11);

    Vec U, Udot;
    const double *u;
    double worst = 0;
    ASSERT_EQ(DMCreateLocalVector(problem.system.mesh.dm, &U), 0);
    ASSERT_EQ(DMCreateLocalVector(problem.system.mesh.dm, &Udot), 0);
    ASSERT_EQ(problem.stepper.LocalState(U, Udot), 0);
    ASSERT_EQ(VecGetArrayRead(U, &u), 0);
    for (const Node &node : problem.system.mesh.nodes) {
      worst = std::max(worst, std::abs(u[node.displacement] - (mu - 1) * node.X[0]));
      worst = std::max(worst, std::abs(u[node.displacement + 1]));
      worst = std::max(worst, std::abs(u[node.displacement + 2] - (lambda - 1) * (node.X[1] + height)));
    }
    ASSERT_EQ(VecRestoreArrayRead(U, &u), 0);
    ASSERT_EQ(VecDestroy(&U), 0);
    ASSERT_EQ(VecDestroy(&Udot), 0);
    std::printf("order %d: force %.17g of %.17g, largest error of a displacement %.2e mm\n", order,
                recorder.rows.back().measurement.normal_force, N, worst);
    EXPECT_LT(worst, 1e-11);
  }
}

TEST(bulk_patch, TurningAndLiftingChangesNoForce)
{
  for (int order : {1, 2}) {
    Problem problem;
    ASSERT_NO_FATAL_FAILURE(set_up_distorted(problem, at_rest(viscoelastic_gel(), order)));
    const std::vector<double> U = some_state(problem.system.mesh);
    const Forces before = forces(problem, U);
    const double turn = 2.3 * a, lift = 1.7;
    std::vector<double> moved = U;
    for (const Node &node : problem.system.mesh.nodes) {
      moved[node.displacement + 1] += turn;
      moved[node.displacement + 2] += lift;
    }
    const Forces after = forces(problem, moved);
    double largest = 0, change = 0;
    for (std::size_t k = 0; k < U.size(); ++k) {
      largest = std::max(largest, before.magnitude[k]);
      change = std::max(change, std::abs(after.F[k] - before.F[k]));
    }
    std::printf("order %d: change of the forces %.2e of %.2e N\n", order, change, largest);
    EXPECT_LT(change, 1e-12 * largest);
  }
}

TEST(bulk_patch, ForcesOfAnyStateBalance)
{
  for (int order : {1, 2}) {
    Problem problem;
    ASSERT_NO_FATAL_FAILURE(set_up_distorted(problem, at_rest(viscoelastic_gel(), order)));
    const Forces f = forces(problem, some_state(problem.system.mesh));
    double sum[3] = {}, size[3] = {};
    for (const Node &node : problem.system.mesh.nodes)
      for (int i = 0; i < 3; ++i) {
        sum[i] += f.F[node.displacement + i];
        size[i] += f.magnitude[node.displacement + i];
      }
    std::printf("order %d: moment %.2e of %.2e, axial resultant %.2e of %.2e\n", order, sum[1], size[1],
                sum[2], size[2]);
    EXPECT_GT(std::abs(sum[0]), 1e-3 * size[0]); // the radial ones are no resultant
    for (int i : {1, 2}) EXPECT_LT(std::abs(sum[i]), 1e-14 * size[i]);
  }
}

} // namespace tribogel::test
