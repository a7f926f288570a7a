/// Manufactured solution, B6: a smooth finite deformation with radial, axial and twisting motion is chosen, a load that
/// makes it the solution is applied, and the discrete solution is compared with it.
///
/// The load is the virtual work of the exact stress, sum over nodes a and components i of
///
///   load_ai = int P(F_exact) : dF_exact[N_a e_i] dV,
///
/// by a quadrature of higher degree than the elements'. By parts it is the work of the body force -Div P and of the
/// tractions P N on the wall; stated this way no second derivatives (and no 1/R terms) are written by hand. P comes
/// from the material, F_exact from dual numbers in R and Z through the closed form, not from the mesh. The load is
/// constant: conjugate to (r, L phi, z), it turns with the material. Plates and axis are prescribed.
///
/// Rates of the norms over the reference volume: k + 1 in L2, k in H1 at order k.
#include "bulk_scenes.hpp"

#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"
#include "tribogel/kinematics/axisymmetric.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 4.5, height = 3;
using Plane = std::array<double, 2>;
using Field = AxisymmetricTorsion::Field<double>;

/// Unknowns (u_R, L phi, u_Z) and their gradients. On the axis u_R is odd in R, the others even. u_R and u_Z come from
/// a stream function, so that the volume changes in second order only: with K/G = 20 more would mean pressures far
/// above G, under which the dead load has no unique solution.
Field exact_field(const Plane &X)
{
  using D = Dual<2>;
  const D R = D::seed(X[0], 0), s = D::seed(X[1], 1) / height, q = R * R / (a * a);
  const D g = 0.4 * sin(1.7 * s + 0.5), slope = 0.4 * 1.7 / height * cos(1.7 * s + 0.5);
  const D u[3] = {-0.5 * R * (1 - 0.4 * q) * slope, 0.9 * (0.7 + 0.6 * q) * sin(1.3 * s - 0.4), (1 - 0.8 * q) * g};
  Field field;
  for (int i = 0; i < 3; ++i) {
    field.u[i] = u[i].v;
    field.grad[i] = u[i].d;
  }
  return field;
}

/// Calls visit(cell, N, dN, X, weight) at the points of a 6 x 6 Gauss rule in every cell; the weight is the volume.
template <int order, class Visit> void integrate(const Mesh &mesh, const Visit &visit)
{
  static const auto gauss = gauss_rule<6>();
  for (const MeshCell &cell : mesh.cells)
    for (int q = 0; q < 36; ++q) {
      const auto shape = tensor_shape<2, order>({gauss.point[q % 6], gauss.point[q / 6]});
      Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
      Plane X{};
      for (std::size_t n = 0; n < shape.N.size(); ++n)
        for (int i = 0; i < 2; ++i) {
          X[i] += shape.N[n] * mesh.nodes[cell.node[n]].X[i];
          for (int j = 0; j < 2; ++j) jacobian(i, j) += mesh.nodes[cell.node[n]].X[i] * shape.dN[n][j];
        }
      const Eigen::Matrix2d inverse = jacobian.inverse();
      std::vector<Plane> dN(shape.N.size());
      for (std::size_t n = 0; n < dN.size(); ++n)
        for (int j = 0; j < 2; ++j) dN[n][j] = shape.dN[n][0] * inverse(0, j) + shape.dN[n][1] * inverse(1, j);
      visit(cell, shape.N, dN, X,
            gauss.weight[q % 6] * gauss.weight[q / 6] * jacobian.determinant() * AxisymmetricTorsion::measure(X));
    }
}

template <int order> void add_load(const Problem &problem, double *load)
{
  const AxisymmetricTorsion kinematics{problem.scene.twist_length()};
  const Viscoelastic<double> &material = problem.scene.bottom.material;
  integrate<order>(problem.mesh,
                   [&](const MeshCell &cell, const auto &N, const auto &dN, const Plane &X, double weight) {
                     const Field field = exact_field(X);
                     const Matrix3<double> F = kinematics.deformation(X, field);
                     const Response<double> response = material.evaluate(F, {}, {0}, nullptr, false);
                     ASSERT_EQ(response.status, PointStatus::ok);
                     const Matrix3<double> P = from_mandel(response.tau) * F.inverse().transpose();
                     for (std::size_t n = 0; n < N.size(); ++n)
                       for (int i = 0; i < 3; ++i)
                         load[problem.mesh.nodes[cell.node[n]].displacement + i] +=
                             weight * P.cwiseProduct(kinematics.first(X, field, i, N[n], dN[n])).sum();
                   });
}

struct Errors {
  double L2 = 0, H1 = 0;
};

template <int order> Errors errors(const Mesh &mesh, const double *U)
{
  Errors e;
  integrate<order>(mesh, [&](const MeshCell &cell, const auto &N, const auto &dN, const Plane &X, double weight) {
    const Field exact = exact_field(X);
    for (int i = 0; i < 3; ++i) {
      double u = -exact.u[i];
      Plane gradient{-exact.grad[i][0], -exact.grad[i][1]};
      for (std::size_t n = 0; n < N.size(); ++n) {
        const double value = U[mesh.nodes[cell.node[n]].displacement + i];
        u += N[n] * value;
        for (int j = 0; j < 2; ++j) gradient[j] += dN[n][j] * value;
      }
      e.L2 += weight * u * u;
      e.H1 += weight * (gradient[0] * gradient[0] + gradient[1] * gradient[1] + (i == 0 ? u * u / (X[0] * X[0]) : 0));
    }
  });
  return {std::sqrt(e.L2), std::sqrt(e.H1)};
}

/// Newton's method down to round-off, from a disturbed interpolant of the exact solution.
template <int order> void solve(Problem &problem, Vec local)
{
  const DM dm = problem.mesh.dm;
  KSP ksp;
  PC pc;
  Vec load, f, F, U, change;
  for (Vec *v : {&load, &f}) ASSERT_EQ(VecDuplicate(local, v), 0);
  for (Vec *v : {&F, &U, &change}) ASSERT_EQ(VecDuplicate(problem.state.U, v), 0);
  ASSERT_EQ(KSPCreate(PETSC_COMM_WORLD, &ksp), 0);
  ASSERT_EQ(KSPSetType(ksp, KSPPREONLY), 0);
  ASSERT_EQ(KSPGetPC(ksp, &pc), 0);
  ASSERT_EQ(PCSetType(pc, PCLU), 0);
  ASSERT_EQ(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), 0);
  double *values, *u;
  ASSERT_EQ(VecZeroEntries(load), 0);
  ASSERT_EQ(VecGetArray(load, &values), 0);
  add_load<order>(problem, values);
  ASSERT_EQ(VecRestoreArray(load, &values), 0);

  ASSERT_EQ(VecGetArray(local, &u), 0);
  for (const Node &node : problem.mesh.nodes) {
    const Field exact = exact_field(node.X);
    const double disturbance = 0.004 * node.X[0] * std::sin(std::numbers::pi * node.X[1] / height);
    for (int i = 0; i < 3; ++i) u[node.displacement + i] = exact.u[i] + disturbance;
  }
  ASSERT_EQ(VecRestoreArray(local, &u), 0);
  ASSERT_EQ(DMLocalToGlobal(dm, local, INSERT_VALUES, U), 0);
  double first = 0, norm = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    ASSERT_EQ(DMGlobalToLocal(dm, U, INSERT_VALUES, local), 0);
    std::vector<double> sizes(problem.mesh.nodes.size() * 3, 0);
    ASSERT_EQ(VecCopy(load, f), 0);
    ASSERT_EQ(VecScale(f, -1), 0);
    ASSERT_EQ(VecGetArray(f, &values), 0);
    ASSERT_EQ(VecGetArray(local, &u), 0);
    ASSERT_FALSE(problem.bulk->AddResidual(u, problem.state.history, {0}, values, sizes.data()));
    BulkFailure failure;
    ASSERT_EQ(MatZeroEntries(problem.jacobian), 0);
    ASSERT_EQ(problem.bulk->AddJacobian(u, problem.state.history, {0}, problem.jacobian, failure), 0);
    ASSERT_EQ(VecRestoreArray(local, &u), 0);
    ASSERT_EQ(VecRestoreArray(f, &values), 0);
    ASSERT_EQ(VecZeroEntries(F), 0);
    ASSERT_EQ(DMLocalToGlobal(dm, f, ADD_VALUES, F), 0);
    ASSERT_EQ(VecNorm(F, NORM_2, &norm), 0);
    if (iteration == 0) first = norm;
    if (norm < 1e-10 * first) break;
    ASSERT_EQ(MatAssemblyBegin(problem.jacobian, MAT_FINAL_ASSEMBLY), 0);
    ASSERT_EQ(MatAssemblyEnd(problem.jacobian, MAT_FINAL_ASSEMBLY), 0);
    ASSERT_EQ(KSPSetOperators(ksp, problem.jacobian, problem.jacobian), 0);
    ASSERT_EQ(KSPSolve(ksp, F, change), 0);
    ASSERT_EQ(VecAXPY(U, -1, change), 0);
  }
  EXPECT_LT(norm, 1e-10 * first);
  for (Vec *v : {&load, &f, &F, &U, &change}) ASSERT_EQ(VecDestroy(v), 0);
  ASSERT_EQ(KSPDestroy(&ksp), 0);
}

template <int order> void expect_rates(double distortion)
{
  Errors before;
  for (int elements : {6, 12, 24}) {
    Scene scene = cylinder(a, height, {{{0.75, 0.45, 0.18}, {1.3, 2, 5}, 28}, {}}, order, elements); // K/G = 20
    scene.schedule = schedule_from_twists({1}, {0}, {0});
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
    if (distortion > 0) {
      distort(problem.mesh, a, height, a / elements, distortion);
      ASSERT_EQ(Bulk::Create(problem.mesh, problem.scene, problem.bulk), 0);
    }
    Vec local;
    const double *u;
    ASSERT_EQ(DMCreateLocalVector(problem.mesh.dm, &local), 0);
    ASSERT_NO_FATAL_FAILURE(solve<order>(problem, local));
    ASSERT_EQ(VecGetArrayRead(local, &u), 0);
    const Errors e = errors<order>(problem.mesh, u);
    ASSERT_EQ(VecRestoreArrayRead(local, &u), 0);
    ASSERT_EQ(VecDestroy(&local), 0);
    std::printf("order %d distortion %.2f elements %2d: L2 %.3e H1 %.3e", order, distortion, elements, e.L2, e.H1);
    if (before.L2 > 0) {
      const double rates[2] = {std::log2(before.L2 / e.L2), std::log2(before.H1 / e.H1)};
      std::printf(" rates %.3f %.3f", rates[0], rates[1]);
      EXPECT_GT(rates[0], order + 1 - 0.15);
      EXPECT_GT(rates[1], order - 0.1);
    }
    std::printf("\n");
    before = e;
  }
}

} // namespace

TEST(manufactured, LinearElementsConvergeAtOrderTwo)
{
  expect_rates<1>(0);
  expect_rates<1>(0.15);
}

TEST(manufactured, QuadraticElementsConvergeAtOrderThree)
{
  expect_rates<2>(0);
  expect_rates<2>(0.15);
}

} // namespace tribogel::test
