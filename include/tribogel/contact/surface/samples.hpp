/// The integrand of the mortar integrals at several points, as the factors of which all sums over points are
/// made: products of matrices with a row for each point. Point by point the derivatives (52 kB at order 2)
/// would go through the cache at each.
#pragma once

#include "tribogel/element/shape.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>

namespace tribogel::quad_mortar
{

/// Of a triangle's Gauss points, or fewer.
template <int order> struct Samples {
  static constexpr int nodes = tensor_nodes<2, order>, most = (order + 4) * (order + 4);
  template <int columns> using Rows = Eigen::Matrix<double, most, columns>;

  int count = 0;
  Rows<nodes> psi; ///< times the point's weight and J [mm^2]
  Rows<nodes> N;   ///< the master's
  // For derivatives only:
  Rows<nodes> slave, slave_g;            ///< the slave's shape functions; times g [mm]
  Rows<3 * nodes> by_x;                  ///< d N_b / d x_i times weight and J [mm], column 3 b + i
  std::array<Rows<nodes>, 2> d_psi, d_N; ///< of psi and N by xi_j, for points that move in the slave facet

  /// sum_q psi_a N_b
  Eigen::Matrix<double, nodes, nodes, Eigen::RowMajor> integral() const
  {
    return psi.topRows(count).transpose() * N.topRows(count);
  }
};

/// dM / d(slave positions, normals, master positions) of points that do not move: sum_q psi_a dN_b/dx_i
/// input_c, with psi = A N; products of two of the slave's shape functions are symmetric, and summed up once.
template <int order> class SampleSlopes
{
public:
  static constexpr int nodes = tensor_nodes<2, order>;

  void clear() { sum.setZero(); }

  void add(const Samples<order> &at, double weight)
  {
    int column = 0;
    const auto multiply = [&](const auto &a, const auto &b) {
      product.col(column++).head(at.count) = a.head(at.count).cwiseProduct(b.head(at.count));
    };
    for (int a = 0; a < nodes; ++a) {
      for (int c = 0; c <= a; ++c) multiply(at.slave.col(a), at.slave.col(c));
      for (int c = 0; c <= a; ++c) multiply(at.slave.col(a), at.slave_g.col(c));
      for (int c = 0; c < nodes; ++c) multiply(at.slave.col(a), at.N.col(c));
    }
    sum.noalias() += weight * product.topRows(at.count).transpose() * at.by_x.topRows(at.count);
  }

  /// Adds the sum to dM, as in QuadPairMortar.
  template <class Slope> void add_to(const Eigen::Matrix<double, nodes, nodes> &A, Slope &dM) const
  {
    Eigen::Matrix<double, nodes, 9 * nodes * nodes, Eigen::RowMajor>
        by_slave; // N in place of psi; columns b, input, i
    for (int a = 0; a < nodes; ++a)
      for (int c = 0; c < nodes; ++c) {
        const int high = std::max(a, c), place = start(high) + std::min(a, c);
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < 3; ++i) {
            double *const row = &by_slave(a, 9 * nodes * b + i);
            row[3 * c] = sum(place, 3 * b + i);
            row[3 * (nodes + c)] = sum(place + high + 1, 3 * b + i);
            row[3 * (2 * nodes + c)] = -sum(start(a) + 2 * (a + 1) + c, 3 * b + i);
          }
      }
    Eigen::Map<decltype(by_slave)>(dM.data()).noalias() += A * by_slave;
  }

private:
  static constexpr int start(int a) { return a * (a + 1) + nodes * a; }
  static constexpr int columns = start(nodes);
  typename Samples<order>::template Rows<columns>
      product;                                   ///< of two factors; of slave node a from start(a) on
  Eigen::Matrix<double, columns, 3 * nodes> sum; ///< by dN_b/dx_i: column 3 b + i
};

/// dM / d xi of a triangle's corners, with which its points move in proportion to their barycentric
/// coordinates.
template <int order> class CornerSlopes
{
public:
  static constexpr int nodes = tensor_nodes<2, order>;
  using ByXi = Eigen::Matrix<double, nodes * nodes, 2, Eigen::RowMajor>;
  using Shares = typename Samples<order>::template Rows<3>;

  void add(const Samples<order> &at, const Shares &share, double weight,
           const std::array<ByXi *, 3> &by_corner)
  {
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < 2; ++j)
        for (int a = 0; a < nodes; ++a) {
          const auto w = share.col(c).head(at.count);
          d_psi.col(place(c, j, a)).head(at.count) = w.cwiseProduct(at.d_psi[j].col(a).head(at.count));
          d_N.col(place(c, j, a)).head(at.count) = w.cwiseProduct(at.d_N[j].col(a).head(at.count));
        }
    by_N.noalias() = weight * at.psi.topRows(at.count).transpose() * d_N.topRows(at.count);
    by_psi.noalias() = weight * at.N.topRows(at.count).transpose() * d_psi.topRows(at.count);
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          for (int j = 0; j < 2; ++j)
            (*by_corner[c])(a * nodes + b, j) += by_N(a, place(c, j, b)) + by_psi(b, place(c, j, a));
  }

private:
  typename Samples<order>::template Rows<6 * nodes> d_psi, d_N; ///< times the corner's share
  Eigen::Matrix<double, nodes, 6 * nodes> by_N, by_psi;

  static int place(int corner, int axis, int node) { return nodes * (2 * corner + axis) + node; }
};

} // namespace tribogel::quad_mortar
