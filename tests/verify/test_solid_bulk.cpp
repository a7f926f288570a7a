/// The 3-D bulk without contact.
///
/// Patch: a linear displacement with a constant F = 1 + H of any size is in equilibrium: the nodal forces
/// vanish at inner nodes, and those of a plane end add up to P N A, on any mesh (curved cells too: the Gauss
/// rules do the cofactors of isoparametric cells exactly).
///
/// Frame: x -> Q x + d turns the nodal forces by Q. In any state they have neither resultant nor moment.
///
/// Torsion, and locking: as in test_torsion.cpp and test_locking.cpp; here the twist is no element
/// of the discrete space, so the errors are those of the mesh and fall under refinement.
#include "solids.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double pi = std::numbers::pi, a = 4.5, height = 3;

using Vector = Vector3<double>;

Vector at(const std::array<double, 3> &X)
{
  return {X[0], X[1], X[2]};
}

struct Forces {
  std::vector<double> F, magnitude;
  Vector of(const Node &node) const { return Vector(&F[node.displacement]); }
};

Forces forces(const Problem &problem, const std::vector<double> &U)
{
  Forces f{std::vector<double>(U.size(), 0), std::vector<double>(U.size(), 0)};
  EXPECT_FALSE(problem.system.bulk->AddResidual(U.data(), problem.stepper.state.history, {0.37}, f.F.data(),
                                                f.magnitude.data()));
  return f;
}

/// Local array of the displacements x(X) - X.
template <class Map> std::vector<double> displacements(const Mesh &mesh, const Map &x)
{
  std::vector<double> U(3 * mesh.nodes.size());
  for (const Node &node : mesh.nodes) {
    const Vector u = x(at(node.X)) - at(node.X);
    for (int i = 0; i < 3; ++i) U[node.displacement + i] = u[i];
  }
  return U;
}

Matrix3<double> first_piola(const Viscoelastic<double> &material, const Matrix3<double> &F)
{
  std::vector<double> history(static_cast<std::size_t>(material.history_size()));
  material.initial_history(history.data());
  const Response<double> response = material.evaluate(F, {history.data()}, {0.37}, nullptr, false);
  return from_mandel(response.tau) * F.inverse().transpose();
}

double largest(const std::vector<double> &values)
{
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

void expect_patch(Problem &problem, double distance, double end_area)
{
  jostle(problem.system.mesh, distance, [](const std::array<double, 3> &X) {
    return std::max(std::abs(X[0]), std::abs(X[1])) < 2.9 && X[2] > -0.99 * height && X[2] < -0.01 * height;
  });
  ASSERT_EQ(Bulk::Create(problem.system.mesh, problem.system.scene, problem.system.bulk), 0);
  Matrix3<double> F;
  F << 1.23, 0.21, -0.34, -0.13, 0.87, 0.29, 0.17, -0.41, 0.79;
  const std::vector<double> U =
      displacements(problem.system.mesh, [&](const Vector &X) -> Vector { return F * X; });
  const Forces f = forces(problem, U);
  Vector end = Vector::Zero();
  double worst = 0;
  for (const Node &node : problem.system.mesh.nodes) {
    if (node.on(Side::top_plate)) end += f.of(node);
    if (!node.sides) worst = std::max(worst, f.of(node).cwiseAbs().maxCoeff());
  }
  const Vector exact = first_piola(problem.system.scene.bottom.material, F).col(2) * end_area;
  std::printf("order %d, %zu cells: inner forces %.2e of %.2e N, error of the end's %.2e of %.2e N\n",
              problem.system.mesh.order, problem.system.mesh.cells.size(), worst, largest(f.magnitude),
              (end - exact).norm(), exact.norm());
  EXPECT_LT(worst, 2e-14 * problem.system.scene.bottom.material.equilibrium.bulk_modulus * a * a);
  EXPECT_LT((end - exact).norm(), 1e-12 * exact.norm());
}

Scene at_rest(const Viscoelastic<double> &material, int order, int elements)
{
  Scene scene = solid_cylinder(a, height, material, order, elements);
  scene.schedule = schedule_from_twists({1}, {0}, {0});
  return scene;
}

/// The area of the upper end of an O-grid with n cells a side: of a polygon with 4 n corners.
double polygon(int corners)
{
  return 0.5 * corners * a * a * std::sin(2 * pi / corners);
}

double end_area(const Mesh &mesh)
{
  double volume = 0;
  const auto cells = [&]<int order>(std::integral_constant<int, order>) {
    for (const MeshCell &cell : mesh.cells) {
      Cell<Solid, order> geometry;
      std::array<std::array<double, 3>, Cell<Solid, order>::nodes> X;
      for (std::size_t n = 0; n < X.size(); ++n) X[n] = mesh.nodes[cell.node[n]].X;
      EXPECT_TRUE(geometry.set(X));
      for (const auto &p : geometry.point) volume += p.weight;
    }
  };
  if (mesh.order == 1)
    cells(std::integral_constant<int, 1>{});
  else
    cells(std::integral_constant<int, 2>{});
  return volume / height;
}

} // namespace

TEST(solid_bulk, LinearDisplacementsPassThePatchTestInABox)
{
  const Box box{{even(-3, 3, 4), even(-3, 3, 3), even(-height, 0, 3)},
                {Side::wall, Side::wall, Side::wall, Side::wall, Side::bottom_plate, Side::top_plate}};
  for (int order : {1, 2}) {
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, at_rest(viscoelastic_gel(), order, 3), box.mesh()), 0);
    expect_patch(problem, order == 1 ? 0.2 : 0.1, 36);
  }
}

TEST(solid_bulk, LinearDisplacementsPassThePatchTestInACylinder)
{
  for (int order : {1, 2}) {
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, at_rest(viscoelastic_gel(), order, 4)), 0);
    const double area = end_area(problem.system.mesh);
    std::printf("order %d: area of the end %.6f, circle %.6f\n", order, area, pi * a * a);
    if (order == 1) {
      EXPECT_NEAR(area, polygon(16), 1e-12 * area);
    }
    EXPECT_NEAR(area / (pi * a * a), 1, order == 1 ? 0.03 : 3e-4);
    expect_patch(problem, order == 1 ? 0.15 : 0.08, area);
  }
}

/// Compressed between lubricated plates, a quarter of a block is uniform (test_bulk_patch.cpp, through Newton
/// and TS).
TEST(solid_bulk, AQuarterOfABlockIsUniform)
{
  const Box box{{even(0, 2, 2), even(0, 1.5, 2), even(-height, 0, 3)},
                {Side::fixed_x, Side::wall, Side::fixed_y, Side::wall, Side::bottom_plate, Side::top_plate}};
  constexpr double lambda = 0.8;
  for (int order : {1, 2}) {
    Scene scene = at_rest(hyperelastic_gel(), order, 3);
    scene.plate_bond = PlateBond::lubricated;
    scene.schedule = schedule_from_twists({2}, {(1 - lambda) * height}, {0});
    const SolverOptions options(fixed_steps(1, 1e-13));
    Problem problem;
    Recorder recorder("");
    bool completed = false;
    std::string why;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, box.mesh()), 0);
    jostle(problem.system.mesh, 0.15, [&](const auto &X) {
      return X[0] > 0.01 && X[0] < 1.99 && X[1] > 0.01 && X[1] < 1.49 && X[2] > -0.99 * height &&
             X[2] < -0.01;
    });
    ASSERT_EQ(Bulk::Create(problem.system.mesh, problem.system.scene, problem.system.bulk), 0);
    ASSERT_EQ(problem.stepper.BuildMatrix(), 0);
    ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
    ASSERT_TRUE(completed) << why;
    double low = 0.9, high = 1.5; // lateral stretch, from a stress-free side
    const auto P = [&](double mu) {
      return first_piola(hyperelastic_gel(), Vector(mu, mu, lambda).asDiagonal().toDenseMatrix());
    };
    for (int k = 0; k < 60; ++k) (P(0.5 * (low + high))(0, 0) < 0 ? low : high) = 0.5 * (low + high);
    const double N = recorder.rows.back().measurement.normal_force, exact = -3 * P(low)(2, 2);
    Vec U, Udot;
    const double *u;
    double worst = 0;
    ASSERT_EQ(DMCreateLocalVector(problem.system.mesh.dm, &U), 0);
    ASSERT_EQ(DMCreateLocalVector(problem.system.mesh.dm, &Udot), 0);
    ASSERT_EQ(problem.stepper.LocalState(U, Udot), 0);
    ASSERT_EQ(VecGetArrayRead(U, &u), 0);
    for (const Node &node : problem.system.mesh.nodes) {
      const auto &X = node.X;
      const Vector right((low - 1) * X[0], (low - 1) * X[1], (lambda - 1) * (X[2] + height));
      worst = std::max(worst, (Vector(u + node.displacement) - right).norm());
    }
    ASSERT_EQ(VecRestoreArrayRead(U, &u), 0);
    ASSERT_EQ(VecDestroy(&U), 0);
    ASSERT_EQ(VecDestroy(&Udot), 0);
    std::printf("order %d: force %.15g of %.15g, largest error of a displacement %.2e mm\n", order, N, exact,
                worst);
    EXPECT_NEAR(N / exact, 1, 1e-10);
    EXPECT_LT(worst, 1e-10);
  }
}

TEST(solid_bulk, TurningAndLiftingTurnsTheForces)
{
  const Eigen::AngleAxisd turn(1.9, Vector(0.3, -0.8, 0.52).normalized());
  const auto some = [](const Vector &X) -> Vector {
    return X + Vector(0.25 * std::sin(0.5 * X[1] - 0.7 * X[2]), 0.3 * std::cos(0.4 * X[0] + 0.9 * X[2]),
                      0.2 * std::sin(0.8 * X[0] - 0.3 * X[1]));
  };
  for (int order : {1, 2}) {
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, at_rest(viscoelastic_gel(), order, 3)), 0);
    const Forces before = forces(problem, displacements(problem.system.mesh, some));
    const Forces after = forces(problem, displacements(problem.system.mesh, [&](const Vector &X) -> Vector {
                                  return turn * some(X) + Vector(1, -2, 3);
                                }));
    double change = 0, size = largest(before.magnitude);
    Vector sum = Vector::Zero(), moment = Vector::Zero();
    for (const Node &node : problem.system.mesh.nodes) {
      change = std::max(change, (after.of(node) - turn * before.of(node)).norm());
      sum += before.of(node);
      moment += some(at(node.X)).cross(before.of(node));
    }
    std::printf("order %d: change of the forces %.2e of %.2e N; resultant %.2e N, moment %.2e N mm\n", order,
                change, size, sum.norm(), moment.norm());
    EXPECT_GT(size, 1);
    EXPECT_LT(change, 1e-12 * size);
    EXPECT_LT(sum.norm(), 1e-12 * size);
    EXPECT_LT(moment.norm(), 1e-12 * size * a);
  }
}

/// Height and radius are equal, and with two elements a side the outline has eight corners: each further mesh
/// halves all edges.
TEST(solid_bulk, TorsionConvergesToTheUniversalSolution)
{
  constexpr double G = 0.7, psi = 0.021, T = pi / 2 * G * psi * a * a * a * a,
                   N = pi / 4 * G * psi * psi * a * a * a * a;
  for (int order : {1, 2}) {
    double before = 0;
    for (int elements : {2 * (3 - order), 4 * (3 - order)}) {
      Scene scene = solid_cylinder(a, a, neo_hookean(G, 1e4), order, elements);
      scene.schedule = schedule_from_twists({2}, {0}, {psi * a});
      const SolverOptions options(fixed_steps(1, 1e-9));
      Problem problem;
      Recorder recorder("");
      run(scene, problem, recorder);
      const Measurement &m = recorder.rows.back().measurement;
      const double error = m.torque / T - 1;
      std::printf("order %d elements %d: errors of T %.3e, N %.3e\n", order, elements, error,
                  m.normal_force / N - 1);
      if (before != 0) {
        EXPECT_GT(before / std::abs(error), order == 1 ? 3.5 : 12);
      }
      before = std::abs(error);
    }
    EXPECT_LT(before, order == 1 ? 0.03 : 1e-3);
  }
}

/// Same levels in both models; thin disc theory is about 2 % low. Between K/G of 1e4 and 1e5 nothing
/// stiffens but the disc: the difference of the models is the outline's.
TEST(solid_bulk, AThinDiscDoesNotLock)
{
  constexpr double radius = 7, thin = 0.7, G = 0.6, strain = 1e-4;
  constexpr double thin_disc[4][2] = {{1e2, 51.55}, {1e3, 125.13}, {1e4, 147.06}, {1e5, 149.70}};
  for (int order : {1, 2}) {
    double difference[4];
    for (int each = 0; each < 4; ++each) {
      const auto [bulk_over_shear, E_c] = thin_disc[each];
      double N[2];
      for (int k = 0; k < 2; ++k) {
        Scene scene = solid_cylinder(radius, thin, neo_hookean(G, bulk_over_shear), order, 6);
        scene.model = k ? Model::solid : Model::axisymmetric;
        scene.schedule = schedule_from_twists({2}, {strain * thin}, {0});
        const std::vector<MeridianBlock> disc{{bottom_body, even(0, radius, order == 1 ? 12 : 6),
                                               even(-thin, 0, order == 1 ? 6 : 3), Side::axis, Side::wall,
                                               Side::bottom_plate, Side::top_plate}};
        const SolverOptions options(fixed_steps(2, 1e-9));
        Problem problem;
        Recorder recorder("");
        run(scene, disc, problem, recorder);
        N[k] = recorder.rows.back().measurement.normal_force / (pi * radius * radius * strain * G);
      }
      difference[each] = N[1] / N[0] - 1;
      std::printf("order %d, K/G %.0e: E_c/G %.2f, axisymmetric %.2f, thin disc %.2f\n", order,
                  bulk_over_shear, N[1], N[0], E_c);
      EXPECT_NEAR(N[1] / E_c, 1.02, order == 1 ? 0.1 : 0.03);
    }
    EXPECT_NEAR(difference[3], difference[2], 0.1 * std::abs(difference[2])) << "order " << order;
  }
}

/// A bonded gel pressed and then twisted: force and torque approach those of the half plane with the same
/// edges. The torque's error is that of the outline; the force's, of the singular line where wall and plate
/// meet, falls slowly.
TEST(solid_bulk, ApproachesTheAxisymmetricModel)
{
  for (int order : {1, 2}) {
    double before[2] = {};
    for (int elements : {4 - (order - 1), 2 * (4 - (order - 1))}) {
      Measurement m[2];
      for (int k = 0; k < 2; ++k) {
        Scene scene = solid_cylinder(a, order == 1 ? a : height, viscoelastic_gel(), order, elements);
        scene.model = k ? Model::solid : Model::axisymmetric;
        scene.schedule = schedule_from_twists({1, 2}, {0.013, 0.013}, {0, 0.02});
        const SolverOptions options(fixed_steps(1, 1e-8));
        Problem problem;
        Recorder recorder("");
        run(scene, problem, recorder);
        ASSERT_EQ(recorder.rows.size(), 3u); // equal steps in all runs
        m[k] = recorder.rows.back().measurement;
      }
      const double errors[2] = {m[1].normal_force / m[0].normal_force - 1, m[1].torque / m[0].torque - 1};
      std::printf("order %d elements %d: N %.5f, T %.5f; differences %.3e, %.3e\n", order, elements,
                  m[1].normal_force, m[1].torque, errors[0], errors[1]);
      for (int i = 0; i < 2; ++i) {
        if (before[i] != 0) {
          EXPECT_LT(std::abs(errors[i]), before[i] / (order == 1 ? 3 : 2));
        }
        before[i] = std::abs(errors[i]);
      }
    }
    EXPECT_LT(before[0], order == 1 ? 0.02 : 2e-3);
    EXPECT_LT(before[1], order == 1 ? 0.02 : 2e-4);
  }
}

} // namespace tribogel::test
