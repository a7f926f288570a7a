/// Element residual and tangent of the three-field mean-dilatation formulation (Simo, Taylor and Pister), THEORY
/// section 2.2, for any kinematics, order and material.
///
/// The Jacobian J = det F is projected on the discontinuous polynomials P_(k-1) of the cell, theta = proj J, and the
/// material (equilibrium and Maxwell parts alike) sees F~ = (theta/J)^(1/3) F. The pressure p = proj(tr tau~/(3 theta))
/// follows in the element, so only displacements are unknowns. All is the gradient of one incremental potential: the
/// tangent is symmetric.
#pragma once

#include "tribogel/element/cell.hpp"
#include "tribogel/material/viscoelastic.hpp"
#include "tribogel/math/tensor.hpp"

#include <cmath>

namespace tribogel
{

/// Integrals over one cell, for the energy balance [N mm].
struct CellEnergy {
  double stored = 0, dissipated = 0; ///< stored now; dissipated by the dashpots during the step
};

template <class Kinematics, int order> class MeanDilatation
{
public:
  using CellType = Cell<Kinematics, order>;
  static constexpr int nodes = CellType::nodes, points = CellType::points, modes = CellType::modes;
  static constexpr int unknowns = Kinematics::unknowns, dofs = nodes * unknowns;
  template <class T> using Vector = Eigen::Matrix<T, dofs, 1>;
  using Matrix = Eigen::Matrix<double, dofs, dofs, Eigen::RowMajor>;

  /// Internal forces R [N] for nodal unknowns U [mm] (node by node). `history` holds the internal variables at the
  /// points at t_n (points x material.history_size()), `history_new`, if not null, receives those at t_(n+1).
  template <class T, class Material>
  static PointStatus residual(const Kinematics &kinematics, const CellType &cell, const Material &material,
                              const Vector<T> &U, const T *history, StepWeights step, Vector<T> &R,
                              T *history_new = nullptr, CellEnergy *energy = nullptr)
  {
    State<T> s;
    const PointStatus status = s.evaluate(kinematics, cell, material, U, history, step, history_new, false, energy);
    if (status != PointStatus::ok) return status;
    R.setConstant(T(0));
    for (int q = 0; q < points; ++q) {
      const Matrix3<T> P = s.first_piola(q);
      const auto &p = cell.point[q];
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < unknowns; ++i) {
          const Matrix3<T> dF = kinematics.first(p.X, s.field[q], i, p.N[a], p.dN[a]);
          R[a * unknowns + i] += p.weight * P.cwiseProduct(dF).sum();
        }
    }
    return status;
  }

  /// The same with the consistent tangent K = dR/dU [N/mm].
  template <class Material>
  static PointStatus tangent(const Kinematics &kinematics, const CellType &cell, const Material &material,
                             const Vector<double> &U, const double *history, StepWeights step, Vector<double> &R,
                             Matrix &K);

private:
  template <class T> struct State {
    typename Kinematics::template Field<T> field[points];
    Matrix3<T> F[points], inverse[points];
    T J[points], theta[points], pressure[points];
    Response<T> response[points];

    template <class Material>
    PointStatus evaluate(const Kinematics &kinematics, const CellType &cell, const Material &material,
                         const Vector<T> &U, const T *history, StepWeights step, T *history_new, bool with_tangent,
                         CellEnergy *energy);

    /// Coefficients of the L2 projection of f on the modes.
    Eigen::Matrix<T, modes, 1> project(const CellType &cell, const T *f) const
    {
      Eigen::Matrix<T, modes, 1> moment = Eigen::Matrix<T, modes, 1>::Constant(T(0));
      for (int q = 0; q < points; ++q)
        for (int k = 0; k < modes; ++k) moment[k] += cell.point[q].weight * cell.point[q].psi[k] * f[q];
      return cell.inverse_mass * moment;
    }

    /// Kirchhoff stress dev tau~ + p J 1 conjugate to the actual F, THEORY (2.4).
    Matrix3<T> kirchhoff(int q) const
    {
      Matrix3<T> tau = from_mandel(response[q].tau);
      const T shift = pressure[q] * J[q] - tau.trace() / 3.0;
      for (int i = 0; i < 3; ++i) tau(i, i) += shift;
      return tau;
    }
    Matrix3<T> first_piola(int q) const { return kirchhoff(q) * inverse[q].transpose(); }
  };

  using Gradient = Eigen::Matrix<double, 10, dofs>;
  using Curvature = Eigen::Matrix<double, 10, 10>;
  static Curvature curvature(const State<double> &s, int q);
};

template <class Kinematics, int order>
template <class T>
template <class Material>
PointStatus MeanDilatation<Kinematics, order>::State<T>::evaluate(const Kinematics &kinematics, const CellType &cell,
                                                                  const Material &material, const Vector<T> &U,
                                                                  const T *history, StepWeights step, T *history_new,
                                                                  bool with_tangent, CellEnergy *energy)
{
  using std::cbrt;
  const int stride = material.history_size();
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    auto &f = field[q];
    for (int i = 0; i < unknowns; ++i) {
      f.u[i] = T(0);
      f.grad[i].fill(T(0));
      for (int a = 0; a < nodes; ++a) {
        f.u[i] += p.N[a] * U[a * unknowns + i];
        for (int j = 0; j < Kinematics::dim; ++j) f.grad[i][j] += p.dN[a][j] * U[a * unknowns + i];
      }
    }
    F[q] = kinematics.deformation(p.X, f);
    J[q] = F[q].determinant();
    if (!(J[q] > 0)) return PointStatus::inverted; // NaN included
    inverse[q] = F[q].inverse();
  }
  const auto dilatation = project(cell, J);
  T s[points];
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    theta[q] = T(0);
    for (int k = 0; k < modes; ++k) theta[q] += p.psi[k] * dilatation[k];
    if (!(theta[q] > 0)) return PointStatus::inverted;
    const T scale = cbrt(theta[q] / J[q]);
    const HistoryLevels<T> levels{history ? history + q * stride : nullptr};
    response[q] = material.evaluate(Matrix3<T>(scale * F[q]), levels, step,
                                    history_new ? history_new + q * stride : nullptr, with_tangent);
    if (response[q].status != PointStatus::ok) return response[q].status;
    s[q] = (response[q].tau[0] + response[q].tau[1] + response[q].tau[2]) / (3.0 * theta[q]);
    if (energy) {
      energy->stored += p.weight * value(response[q].energy);
      energy->dissipated += p.weight * value(response[q].dissipated);
    }
  }
  const auto mean = project(cell, s);
  for (int q = 0; q < points; ++q) {
    pressure[q] = T(0);
    for (int k = 0; k < modes; ++k) pressure[q] += cell.point[q].psi[k] * mean[k];
  }
  return PointStatus::ok;
}

/// Second derivative of the incremental potential at one point with respect to (l, ln theta), where l = dF F^-1 is the
/// full spatial velocity gradient (rows 3 i + j) and the terms that contain d2F are left out, THEORY (2.6).
template <class Kinematics, int order>
auto MeanDilatation<Kinematics, order>::curvature(const State<double> &s, int q) -> Curvature
{
  const Matrix3<double> tau = from_mandel(s.response[q].tau);
  const double t = tau.trace(), pJ = s.pressure[q] * s.J[q];
  Eigen::Matrix<double, 10, 1> trace = Eigen::Matrix<double, 10, 1>::Zero(), dilate = trace, deviator = trace;
  Eigen::Matrix<double, 6, 10> rate = Eigen::Matrix<double, 6, 10>::Zero(); // d~ from (l, ln theta), Mandel
  constexpr double half_root = 1 / std::numbers::sqrt2;
  for (int m = 0; m < 6; ++m) {
    const auto [i, j] = mandel_index[m];
    rate(m, 3 * i + j) += m < 3 ? 1 : half_root;
    if (m >= 3) rate(m, 3 * j + i) += half_root;
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) rate(i, 4 * k) -= 1.0 / 3;
    rate(i, 9) += 1.0 / 3;
    trace[4 * i] = 1;
    for (int j = 0; j < 3; ++j) deviator[3 * i + j] = tau(i, j) - (i == j ? t / 3 : 0);
  }
  dilate[9] = 1;
  const Eigen::Matrix<double, 10, 1> a = (dilate - trace) / 3; // variation of ln (theta/J)^(1/3)
  Curvature H = rate.transpose() * (s.response[q].tangent * rate);
  const auto symmetric = [&H](const auto &x, const auto &y, double factor) {
    H += factor * (x * y.transpose() + y * x.transpose());
  };
  symmetric(a, deviator, 2);
  symmetric(a, dilate, 2 * t / 3);
  H -= 2 * t * a * a.transpose();
  H -= t / 3 * dilate * dilate.transpose();
  H += pJ * trace * trace.transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      H(3 * i + j, 3 * j + i) += t / 3 - pJ;                            // tr(l l)
      for (int k = 0; k < 3; ++k) H(3 * i + j, 3 * i + k) += tau(j, k); // tau : l^T l
    }
  return H;
}

template <class Kinematics, int order>
template <class Material>
PointStatus MeanDilatation<Kinematics, order>::tangent(const Kinematics &kinematics, const CellType &cell,
                                                       const Material &material, const Vector<double> &U,
                                                       const double *history, StepWeights step, Vector<double> &R,
                                                       Matrix &K)
{
  State<double> s;
  const PointStatus status = s.evaluate(kinematics, cell, material, U, history, step, nullptr, true, nullptr);
  if (status != PointStatus::ok) return status;

  Gradient G[points];
  Eigen::Matrix<double, modes, dofs> moment = Eigen::Matrix<double, modes, dofs>::Zero();
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < unknowns; ++i) {
        const Matrix3<double> l = kinematics.first(p.X, s.field[q], i, p.N[a], p.dN[a]) * s.inverse[q];
        const int column = a * unknowns + i;
        for (int k = 0; k < 9; ++k) G[q](k, column) = l(k / 3, k % 3);
        const double dJ = p.weight * s.J[q] * l.trace();
        for (int k = 0; k < modes; ++k) moment(k, column) += p.psi[k] * dJ;
      }
  }
  const Eigen::Matrix<double, modes, dofs> d_dilatation = cell.inverse_mass * moment;

  R.setZero();
  K.setZero();
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    G[q].row(9).setZero();
    for (int k = 0; k < modes; ++k) G[q].row(9) += p.psi[k] / s.theta[q] * d_dilatation.row(k);
    const Matrix3<double> tau = s.kirchhoff(q);
    Eigen::Matrix<double, 9, 1> stress;
    for (int k = 0; k < 9; ++k) stress[k] = tau(k / 3, k % 3);
    R.noalias() += p.weight * (G[q].template topRows<9>().transpose() * stress);
    const Gradient HG = p.weight * curvature(s, q) * G[q];
    K.noalias() += G[q].transpose() * HG;

    const Matrix3<double> P = p.weight * (tau * s.inverse[q].transpose());
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b)
        for (int i = 0; i < unknowns; ++i)
          for (int j = 0; j < unknowns; ++j)
            K(a * unknowns + i, b * unknowns + j) += kinematics.second(P, i, p.N[a], p.dN[a], j, p.N[b], p.dN[b]);
  }
  return status;
}

} // namespace tribogel
