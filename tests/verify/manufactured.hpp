/// Manufactured solutions: a smooth finite deformation is chosen, a load that makes it the solution is
/// applied, and the discrete solution is compared with it.
///
/// The load is the virtual work of the exact stress, sum over nodes a and components i of
///
///   load_ai = int P(F_exact) : dF_exact[N_a e_i] dV,
///
/// by a quadrature of higher degree than the elements'. By parts it is the work of the body force -Div P and
/// of the tractions P N on the free sides; stated this way no second derivatives (and no 1/R terms) are
/// written by hand. P comes from the material, F_exact from dual numbers in the closed form, not from the
/// mesh. The load is constant, conjugate to the unknowns. Plates and axis are prescribed.
#pragma once

#include "bulk_scenes.hpp"

#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"

#include <numbers>

namespace tribogel::test
{

/// Kinematics and exact unknowns with their gradients.
template <class Model> struct Manufactured {
  static constexpr int dim = Model::dim;
  using Position = std::array<double, dim>;
  using Field = typename Model::template Field<double>;

  Model kinematics;
  Field (*exact)(const Position &);

  static Position position(const Node &node)
  {
    Position X;
    std::copy_n(node.X.begin(), dim, X.begin());
    return X;
  }

  /// Calls visit(cell, N, dN, X, weight) at the points of a Gauss rule in every cell; the weight is the
  /// volume.
  template <int order, class Visit> static void integrate(const Mesh &mesh, const Visit &visit)
  {
    constexpr int n = dim == 2 ? 6 : 4, nodes = tensor_nodes<dim, order>;
    static const auto gauss = gauss_rule<n>();
    for (const MeshCell &cell : mesh.cells)
      for (int q = 0; q < power(n, dim); ++q) {
        Position xi, X{};
        double weight = 1;
        for (int j = 0, rest = q; j < dim; ++j, rest /= n) {
          xi[j] = gauss.point[rest % n];
          weight *= gauss.weight[rest % n];
        }
        const auto shape = tensor_shape<dim, order>(xi);
        Eigen::Matrix<double, dim, dim> jacobian = Eigen::Matrix<double, dim, dim>::Zero();
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < dim; ++i) {
            X[i] += shape.N[b] * mesh.nodes[cell.node[b]].X[i];
            for (int j = 0; j < dim; ++j) jacobian(i, j) += mesh.nodes[cell.node[b]].X[i] * shape.dN[b][j];
          }
        const Eigen::Matrix<double, dim, dim> inverse = jacobian.inverse();
        std::vector<Position> dN(nodes);
        for (int b = 0; b < nodes; ++b)
          for (int j = 0; j < dim; ++j)
            for (int k = 0; k < dim; ++k) dN[b][j] += shape.dN[b][k] * inverse(k, j);
        visit(cell, shape.N, dN, X, weight * jacobian.determinant() * Model::measure(X));
      }
  }

  template <int order> void add_load(const Problem &problem, double *load) const
  {
    const Viscoelastic<double> &material = problem.system.scene.bottom.material;
    integrate<order>(problem.system.mesh, [&](const MeshCell &cell, const auto &N, const auto &dN,
                                              const Position &X, double weight) {
      const Field field = exact(X);
      const Matrix3<double> F = kinematics.deformation(X, field);
      const Response<double> response = material.evaluate(F, {}, {0}, nullptr, false);
      ASSERT_EQ(response.status, PointStatus::ok);
      const Matrix3<double> P = from_mandel(response.tau) * F.inverse().transpose();
      for (std::size_t n = 0; n < N.size(); ++n)
        for (int i = 0; i < 3; ++i)
          load[problem.system.mesh.nodes[cell.node[n]].displacement + i] +=
              weight * P.cwiseProduct(kinematics.first(X, field, i, N[n], dN[n])).sum();
    });
  }

  /// Over the reference volume.
  struct Errors {
    double L2 = 0, H1 = 0;
  };

  template <int order> Errors errors(const Mesh &mesh, const double *U) const
  {
    Errors e;
    integrate<order>(
        mesh, [&](const MeshCell &cell, const auto &N, const auto &dN, const Position &X, double weight) {
          const Field right = exact(X);
          for (int i = 0; i < 3; ++i) {
            double u = -right.u[i];
            Position gradient;
            for (int j = 0; j < dim; ++j) gradient[j] = -right.grad[i][j];
            for (std::size_t n = 0; n < N.size(); ++n) {
              const double value = U[mesh.nodes[cell.node[n]].displacement + i];
              u += N[n] * value;
              for (int j = 0; j < dim; ++j) gradient[j] += dN[n][j] * value;
            }
            e.L2 += weight * u * u;
            for (int j = 0; j < dim; ++j) e.H1 += weight * gradient[j] * gradient[j];
            if (dim == 2 && i == 0) e.H1 += weight * u * u / (X[0] * X[0]);
          }
        });
    return {std::sqrt(e.L2), std::sqrt(e.H1)};
  }

  /// Newton's method down to round-off, from a disturbed interpolant of the exact solution.
  template <int order> void solve(Problem &problem, Vec local) const
  {
    const double height = problem.system.scene.bottom.height;
    const DM dm = problem.system.mesh.dm;
    KSP ksp;
    PC pc;
    Vec load, f, F, U, change;
    for (Vec *v : {&load, &f}) ASSERT_EQ(VecDuplicate(local, v), 0);
    for (Vec *v : {&F, &U, &change}) ASSERT_EQ(VecDuplicate(problem.stepper.state.U, v), 0);
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
    for (const Node &node : problem.system.mesh.nodes) {
      const Field right = exact(position(node));
      const double disturbance = 0.004 * node.X[0] * std::sin(std::numbers::pi * node.X[dim - 1] / height);
      for (int i = 0; i < 3; ++i) u[node.displacement + i] = right.u[i] + disturbance;
    }
    ASSERT_EQ(VecRestoreArray(local, &u), 0);
    ASSERT_EQ(DMLocalToGlobal(dm, local, INSERT_VALUES, U), 0);
    double first = 0, norm = 0;
    for (int iteration = 0; iteration < 12; ++iteration) {
      ASSERT_EQ(DMGlobalToLocal(dm, U, INSERT_VALUES, local), 0);
      std::vector<double> sizes(problem.system.mesh.nodes.size() * 3, 0);
      ASSERT_EQ(VecCopy(load, f), 0);
      ASSERT_EQ(VecScale(f, -1), 0);
      ASSERT_EQ(VecGetArray(f, &values), 0);
      ASSERT_EQ(VecGetArray(local, &u), 0);
      ASSERT_FALSE(
          problem.system.bulk->AddResidual(u, problem.stepper.state.history, {0}, values, sizes.data()));
      BulkFailure failure;
      ASSERT_EQ(MatZeroEntries(problem.stepper.jacobian), 0);
      ASSERT_EQ(problem.system.bulk->AddJacobian(u, problem.stepper.state.history, {0},
                                                 problem.stepper.jacobian, failure),
                0);
      ASSERT_EQ(VecRestoreArray(local, &u), 0);
      ASSERT_EQ(VecRestoreArray(f, &values), 0);
      ASSERT_EQ(VecZeroEntries(F), 0);
      ASSERT_EQ(DMLocalToGlobal(dm, f, ADD_VALUES, F), 0);
      ASSERT_EQ(VecNorm(F, NORM_2, &norm), 0);
      if (iteration == 0) first = norm;
      if (norm < 1e-10 * first) break;
      ASSERT_EQ(MatAssemblyBegin(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
      ASSERT_EQ(MatAssemblyEnd(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
      ASSERT_EQ(KSPSetOperators(ksp, problem.stepper.jacobian, problem.stepper.jacobian), 0);
      ASSERT_EQ(KSPSolve(ksp, F, change), 0);
      ASSERT_EQ(VecAXPY(U, -1, change), 0);
    }
    EXPECT_LT(norm, 1e-10 * first);
    for (Vec *v : {&load, &f, &F, &U, &change}) ASSERT_EQ(VecDestroy(v), 0);
    ASSERT_EQ(KSPDestroy(&ksp), 0);
  }

  /// Errors on one mesh.
  template <int order> Errors errors_of(Problem &problem) const
  {
    Vec local;
    const double *u;
    Errors e;
    EXPECT_EQ(DMCreateLocalVector(problem.system.mesh.dm, &local), 0);
    solve<order>(problem, local);
    EXPECT_EQ(VecGetArrayRead(local, &u), 0);
    e = errors<order>(problem.system.mesh, u);
    EXPECT_EQ(VecRestoreArrayRead(local, &u), 0);
    EXPECT_EQ(VecDestroy(&local), 0);
    return e;
  }
};

} // namespace tribogel::test
