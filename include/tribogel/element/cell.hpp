/// Reference geometry of one cell: everything at its quadrature points that does not change during a run.
#pragma once

#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"

#include <Eigen/Dense>

#include <array>

namespace tribogel
{

/// Quadrilateral (dim 2) or hexahedral (dim 3) Lagrange cell of order k with (k+1)^dim Gauss points and the
/// discontinuous polynomials P_(k-1) on which the dilatation is projected. Those are {1} or {1, (X_j -
/// centre_j)/size}: polynomials of the reference position, not of the parent coordinates, so that they stay
/// complete on skewed cells.
template <class Kinematics, int cell_order> struct Cell {
  static constexpr int dim = Kinematics::dim, order = cell_order;
  static constexpr int nodes = tensor_nodes<dim, order>, points = power(order + 1, dim);
  static constexpr int modes = order == 1 ? 1 : 1 + dim;
  using Position = std::array<double, dim>;

  struct Point {
    Position X;
    std::array<std::array<double, nodes>, 1 + dim> shape; ///< [0]: N_a, [1 + j]: d N_a / d X_j [1/mm]
    double weight;                                        ///< reference volume [mm^3]
    std::array<double, modes> psi;
  };
  std::array<Point, points> point;
  Eigen::Matrix<double, modes, modes> inverse_mass; ///< of the modes, [1/mm^3]

  /// Set up from the nodes' reference positions (lexicographic); false if the cell is degenerate or inside
  /// out.
  bool set(const std::array<Position, nodes> &X);
};

template <class Kinematics, int cell_order>
bool Cell<Kinematics, cell_order>::set(const std::array<Position, nodes> &X)
{
  static const auto gauss = gauss_rule<order + 1>();
  Position centre{}, size{};
  for (int j = 0; j < dim; ++j) {
    double low = X[0][j], high = X[0][j];
    for (const Position &x : X) low = std::min(low, x[j]), high = std::max(high, x[j]);
    centre[j] = 0.5 * (low + high);
    size[j] = 0.5 * (high - low);
  }
  Eigen::Matrix<double, modes, modes> mass = Eigen::Matrix<double, modes, modes>::Zero();
  for (int q = 0; q < points; ++q) {
    Position xi;
    double weight = 1;
    for (int j = 0, rest = q; j < dim; ++j, rest /= order + 1) {
      xi[j] = gauss.point[rest % (order + 1)];
      weight *= gauss.weight[rest % (order + 1)];
    }
    const auto shape = tensor_shape<dim, order>(xi);
    Eigen::Matrix<double, dim, dim> jacobian = Eigen::Matrix<double, dim, dim>::Zero();
    Point &p = point[q];
    p.X = {};
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        p.X[i] += shape.N[a] * X[a][i];
        for (int j = 0; j < dim; ++j) jacobian(i, j) += X[a][i] * shape.dN[a][j];
      }
    const double det = jacobian.determinant();
    if (!(det > 0)) return false;
    const Eigen::Matrix<double, dim, dim> inverse = jacobian.inverse();
    for (int a = 0; a < nodes; ++a)
      for (int j = 0; j < dim; ++j) {
        p.shape[1 + j][a] = 0;
        for (int k = 0; k < dim; ++k) p.shape[1 + j][a] += shape.dN[a][k] * inverse(k, j);
      }
    p.shape[0] = shape.N;
    p.weight = weight * det * Kinematics::measure(p.X);
    p.psi[0] = 1;
    for (int k = 1; k < modes; ++k) p.psi[k] = (p.X[k - 1] - centre[k - 1]) / size[k - 1];
    for (int k = 0; k < modes; ++k)
      for (int l = 0; l < modes; ++l) mass(k, l) += p.weight * p.psi[k] * p.psi[l];
  }
  inverse_mass = mass.inverse();
  return true;
}

} // namespace tribogel
