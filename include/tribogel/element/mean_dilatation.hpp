/// Element residual and tangent of the three-field mean-dilatation formulation (Simo, Taylor and Pister),
/// THEORY section 2.2, for any kinematics, order and material.
///
/// The Jacobian J = det F is projected on the discontinuous polynomials P_(k-1) of the cell, theta = proj J,
/// and the material (equilibrium and Maxwell parts alike) sees F~ = (theta/J)^(1/3) F. The pressure p =
/// proj(tr tau~/(3 theta)) follows in the element, so only displacements are unknowns. All is the gradient of
/// one incremental potential: the tangent is symmetric.
#pragma once

#include "tribogel/element/cell.hpp"
#include "tribogel/element/energy.hpp"
#include "tribogel/material/points.hpp"
#include "tribogel/math/tensor.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace tribogel
{

template <class Kinematics, int order> class MeanDilatation
{
public:
  using CellType = Cell<Kinematics, order>;
  static constexpr int nodes = CellType::nodes, points = CellType::points, modes = CellType::modes;
  static constexpr int unknowns = Kinematics::unknowns, dofs = nodes * unknowns;
  template <class T> using Vector = Eigen::Matrix<T, dofs, 1>;
  using Matrix = Eigen::Matrix<double, dofs, dofs, Eigen::RowMajor>;

  /// What follows from the unknowns of one cell, at its points; forces and tangent are made of it.
  template <class T> struct Evaluation {
    typename Kinematics::template Field<T> field[points];
    Matrix3<T> inverse[points]; ///< F^-1
    T J[points], theta[points], pressure[points];
    Response<T> response[points];

    /// For nodal unknowns U [mm] (node by node). `history` holds the internal variables at the points at t_n
    /// (points x material.history_size()), `history_new`, if not null, receives those at t_(n+1). Nothing
    /// means anything unless the status is ok. The material's scalar is T, or Lanes where T is double.
    template <class Material>
    PointStatus set(const Kinematics &kinematics, const CellType &cell, const Material &material,
                    const Vector<T> &U, const T *history, StepWeights step, T *history_new,
                    bool with_tangent);

    CellEnergy energy(const CellType &cell) const
    {
      CellEnergy sum;
      for (int q = 0; q < points; ++q) {
        sum.stored += cell.point[q].weight * value(response[q].energy);
        sum.dissipated += cell.point[q].weight * value(response[q].dissipated);
      }
      return sum;
    }

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

  /// Internal forces [N], node by node.
  template <class T>
  static Vector<T> forces(const Kinematics &kinematics, const CellType &cell, const Evaluation<T> &s)
  {
    Rows<T> rows;
    for (auto &row : rows) row.fill(T(0));
    for (int q = 0; q < points; ++q) {
      const Point &p = cell.point[q];
      const Inputs<T> conjugate =
          p.weight * stacked(s.first_piola(q)).transpose() * variations(kinematics, p, s.field[q]);
      add_rows(p, conjugate, rows);
    }
    Vector<T> R;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < unknowns; ++i) R[a * unknowns + i] = rows[i][a];
    return R;
  }

  /// Their consistent derivative with respect to the unknowns [N/mm], of an evaluation with tangent.
  static void tangent(const Kinematics &kinematics, const CellType &cell, const Evaluation<double> &s,
                      Matrix &K);

private:
  using Point = typename CellType::Point;
  static constexpr auto input = Kinematics::inputs;
  static constexpr int inputs = static_cast<int>(input.size());

  template <class T> using Inputs = Eigen::Matrix<T, 1, inputs>;
  template <class T>
  using Stack = Eigen::Matrix<T, 9, inputs, Eigen::RowMajor>; ///< 3x3 entries (3 i + j), by input
  template <class T>
  using Rows = std::array<std::array<T, nodes>, unknowns>; ///< one number a degree of freedom

  template <class T> static Eigen::Matrix<T, 9, 1> stacked(const Matrix3<T> &A)
  {
    Eigen::Matrix<T, 9, 1> v;
    for (int k = 0; k < 9; ++k) v[k] = A(k / 3, k % 3);
    return v;
  }

  /// f(integral constant 0), f(1), ... f(count - 1).
  template <int count, class Function> static void for_each(Function &&f)
  {
    [&]<int... k>(std::integer_sequence<int, k...>)
    {
      (f(std::integral_constant<int, k>{}), ...);
    }
    (std::make_integer_sequence<int, count>{});
  }

  /// The unit vector of one input, as shape function and gradient of a node.
  struct Unit {
    double N = 0;
    std::array<double, Kinematics::dim> dN{};
    explicit Unit(int k)
    {
      if (input[k].derivative == 0)
        N = 1;
      else
        dN[input[k].derivative - 1] = 1;
    }
  };

  /// dF for a unit rate of each input.
  template <class T>
  static Stack<T> variations(const Kinematics &kinematics, const Point &p,
                             const typename Kinematics::template Field<T> &field)
  {
    Stack<T> dF;
    for_each<inputs>([&](auto k) {
      const Unit unit(k);
      dF.col(k()) = stacked(kinematics.first(p.X, field, input[k].unknown, unit.N, unit.dN));
    });
    return dF;
  }

  /// From numbers conjugate to the inputs to numbers conjugate to the nodes' unknowns.
  template <class T, class Conjugate>
  static void add_rows(const Point &p, const Conjugate &conjugate, Rows<T> &rows)
  {
    for_each<inputs>([&](auto k) {
      const T c = conjugate[k()];
      for (int a = 0; a < nodes; ++a) rows[input[k].unknown][a] += p.shape[input[k].derivative][a] * c;
    });
  }

  using Curvature = Eigen::Matrix<double, inputs + 1, inputs + 1, Eigen::RowMajor>;
  using Rates = Eigen::Matrix<double, 9, inputs + 1, Eigen::RowMajor>;
  static Curvature curvature(const Kinematics &kinematics, const Evaluation<double> &s, int q,
                             const Rates &l);

  /// [i][a][j][b]: the tangent, unknown by unknown, so that the loop over b is one of the processor's
  /// vectors. Only i <= j is filled.
  using Blocks = std::array<std::array<std::array<std::array<double, nodes>, unknowns>, nodes>, unknowns>;
  static void add_inputs(const Point &p, const Curvature &H, Blocks &K);
};

template <class Kinematics, int order>
template <class T>
template <class Material>
PointStatus MeanDilatation<Kinematics, order>::Evaluation<T>::set(
    const Kinematics &kinematics, const CellType &cell, const Material &material, const Vector<T> &U,
    const T *history, StepWeights step, T *history_new, bool with_tangent)
{
  using std::cbrt;
  Matrix3<T> F[points]; // then F~
  Rows<T> u;
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < unknowns; ++i) u[i][a] = U[a * unknowns + i];
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    auto &f = field[q];
    for (int i = 0; i < unknowns; ++i) {
      f.u[i] = T(0);
      f.grad[i].fill(T(0));
      for (int a = 0; a < nodes; ++a) {
        f.u[i] += p.shape[0][a] * u[i][a];
        for (int j = 0; j < Kinematics::dim; ++j) f.grad[i][j] += p.shape[1 + j][a] * u[i][a];
      }
    }
    F[q] = kinematics.deformation(p.X, f);
    J[q] = F[q].determinant();
    if (!(J[q] > 0)) return PointStatus::inverted; // NaN included
    inverse[q] = F[q].inverse();
  }
  const auto dilatation = project(cell, J);
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    theta[q] = T(0);
    for (int k = 0; k < modes; ++k) theta[q] += p.psi[k] * dilatation[k];
    if (!(theta[q] > 0)) return PointStatus::inverted;
    F[q] *= T(cbrt(theta[q] / J[q]));
  }
  const PointStatus status =
      evaluate_points(material, points, F, history, step, history_new, with_tangent, response);
  if (status != PointStatus::ok) return status;
  T s[points];
  for (int q = 0; q < points; ++q)
    s[q] = (response[q].tau[0] + response[q].tau[1] + response[q].tau[2]) / (3.0 * theta[q]);
  const auto mean = project(cell, s);
  for (int q = 0; q < points; ++q) {
    pressure[q] = T(0);
    for (int k = 0; k < modes; ++k) pressure[q] += cell.point[q].psi[k] * mean[k];
  }
  return PointStatus::ok;
}

/// Second derivative of the incremental potential at one point with respect to the inputs and, last, ln
/// theta, THEORY (2.6). The columns of `l` are the spatial velocity gradients that go with them.
template <class Kinematics, int order>
auto MeanDilatation<Kinematics, order>::curvature(const Kinematics &kinematics, const Evaluation<double> &s,
                                                  int q, const Rates &l) -> Curvature
{
  using Row = Eigen::Matrix<double, 1, inputs + 1>;
  const Matrix3<double> tau = from_mandel(s.response[q].tau);
  const double t = tau.trace(), pJ = s.pressure[q] * s.J[q];
  const Row trace = l.row(0) + l.row(4) + l.row(8), dilate = Row::Unit(inputs);
  const Row a = (dilate - trace) / 3;                         // variation of ln (theta/J)^(1/3)
  Eigen::Matrix<double, 6, inputs + 1, Eigen::RowMajor> rate; // d~, Mandel
  Row deviator = -t / 3 * trace;
  Rates product; // with the terms in l^T l and tr(l l)
  for (int m = 0; m < 6; ++m) {
    const auto [i, j] = mandel_index[m];
    if (m < 3)
      rate.row(m) = l.row(4 * m) + a;
    else
      rate.row(m) = (l.row(3 * i + j) + l.row(3 * j + i)) / std::numbers::sqrt2;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      deviator += tau(i, j) * l.row(3 * i + j);
      product.row(3 * i + j) = (t / 3 - pJ) * l.row(3 * j + i);
      for (int k = 0; k < 3; ++k) product.row(3 * i + j) += tau(j, k) * l.row(3 * i + k);
    }
  const Eigen::Matrix<double, 6, inputs + 1, Eigen::RowMajor> stress = s.response[q].tangent * rate;
  const Row beside_a = 2 * deviator + 2 * t / 3 * dilate - t * a;
  Curvature H = rate.transpose() * stress;
  H.noalias() += l.transpose() * product;
  H.noalias() += a.transpose() * beside_a + beside_a.transpose() * a;
  H.noalias() += pJ * trace.transpose() * trace;
  H(inputs, inputs) -= t / 3;
  const Matrix3<double> P = s.first_piola(q);
  for_each<inputs>([&](auto k) {
    for_each<inputs>([&](auto m) {
      const Unit row(k), column(m);
      H(k(), m()) +=
          kinematics.second(P, input[k].unknown, row.N, row.dN, input[m].unknown, column.N, column.dN);
    });
  });
  return H;
}

template <class Kinematics, int order>
void MeanDilatation<Kinematics, order>::add_inputs(const Point &p, const Curvature &H, Blocks &K)
{
  std::array<std::array<std::array<double, nodes>, unknowns>, inputs> HB{};
  for_each<inputs>([&](auto k) {
    for_each<inputs>([&](auto m) {
      if constexpr (input[k].unknown <= input[m].unknown)
        for (int b = 0; b < nodes; ++b)
          HB[k][input[m].unknown][b] += H(k(), m()) * p.shape[input[m].derivative][b];
    });
  });
  for_each<inputs>([&](auto k) {
    constexpr int i = input[k].unknown;
    for (int a = 0; a < nodes; ++a)
      for (int j = i; j < unknowns; ++j)
        for (int b = 0; b < nodes; ++b) K[i][a][j][b] += p.shape[input[k].derivative][a] * HB[k][j][b];
  });
}

template <class Kinematics, int order>
void MeanDilatation<Kinematics, order>::tangent(const Kinematics &kinematics, const CellType &cell,
                                                const Evaluation<double> &s, Matrix &K)
{
  // The dilatation depends on all of the cell's unknowns through a few modes: beside the blocks of inputs, a
  // tangent of low rank.
  using Dense = Eigen::Matrix<double, modes, dofs, Eigen::RowMajor>; // columns unknown by unknown, as Blocks
  Rows<double> moment[modes]{}, coupling[modes]{};
  Eigen::Matrix<double, modes, modes> dilatational = Eigen::Matrix<double, modes, modes>::Zero();
  Blocks blocks{};
  for (int q = 0; q < points; ++q) {
    const auto &p = cell.point[q];
    const Stack<double> dF = variations(kinematics, p, s.field[q]);
    Rates l;
    l.col(inputs).setZero();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        l.row(3 * i + j).template head<inputs>() = dF.row(3 * i) * s.inverse[q](0, j) +
                                                   dF.row(3 * i + 1) * s.inverse[q](1, j) +
                                                   dF.row(3 * i + 2) * s.inverse[q](2, j);
    const Curvature H = p.weight * curvature(kinematics, s, q, l);
    add_inputs(p, H, blocks);
    const Inputs<double> dJ = p.weight * s.J[q] * (l.row(0) + l.row(4) + l.row(8)).template head<inputs>();
    for (int k = 0; k < modes; ++k) {
      const double d_ln_theta = p.psi[k] / s.theta[q];
      add_rows(p, Inputs<double>(p.psi[k] * dJ), moment[k]);
      add_rows(p, Inputs<double>(d_ln_theta * H.row(inputs).template head<inputs>()), coupling[k]);
      for (int m = 0; m < modes; ++m)
        dilatational(k, m) += d_ln_theta * p.psi[m] / s.theta[q] * H(inputs, inputs);
    }
  }
  const Dense d_dilatation = cell.inverse_mass * Eigen::Map<const Dense>(moment[0][0].data());
  const Dense side = Eigen::Map<const Dense>(coupling[0][0].data()) + 0.5 * dilatational * d_dilatation;
  Eigen::Map<Matrix> all(blocks[0][0][0].data());
  all.noalias() += side.transpose() * d_dilatation;
  all.noalias() += d_dilatation.transpose() * side;
  for (int i = 0; i < unknowns; ++i)
    for (int j = i; j < unknowns; ++j)
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          K(a * unknowns + i, b * unknowns + j) = K(b * unknowns + j, a * unknowns + i) = blocks[i][a][j][b];
}

} // namespace tribogel
