/// Dual (biorthogonal) basis of the contact multiplier on one facet, for any facet shape and dimension.
///
/// psi_a = sum_b A_ab N_b with A = diag(D) M^-1, D_a = int N_a w, M_ab = int N_a N_b w and w the reference
/// weight (2 pi R dS in the half plane, dS in 3-D). Then int psi_a N_b w = D_a delta_ab, so a multiplier's
/// coupling to its own surface is diagonal, and sum_a psi_a = 1, so constants are reproduced.
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cmath>

namespace tribogel
{

template <int nodes> struct DualBasis {
  std::array<double, nodes> D;           ///< int N_a w = int psi_a w [mm^2]
  Eigen::Matrix<double, nodes, nodes> A; ///< psi = A N [1]

  /// psi_a where the shape functions are N; T is double or Dual.
  template <class T> std::array<T, nodes> operator()(const std::array<T, nodes> &N) const
  {
    std::array<T, nodes> psi;
    for (int a = 0; a < nodes; ++a) {
      psi[a] = A(a, 0) * N[0];
      for (int b = 1; b < nodes; ++b) psi[a] += A(a, b) * N[b];
    }
    return psi;
  }
};

/// From the integrals above. A node whose D_a is zero up to round-off gets exactly D_a = 0 and psi_a = 0:
/// that is the axis node of a quadratic facet whose midside node lies in the middle, where int N_axis R dR =
/// 0. The other functions stay biorthogonal and still add up to one.
template <int nodes>
DualBasis<nodes> dual_basis(const std::array<double, nodes> &D, const Eigen::Matrix<double, nodes, nodes> &M)
{
  constexpr double round_off = 1e-13;
  DualBasis<nodes> basis{D, M.fullPivLu().inverse()};
  double scale = 0;
  for (double d : D) scale += std::abs(d);
  for (int a = 0; a < nodes; ++a) {
    if (std::abs(D[a]) <= round_off * scale) basis.D[a] = 0;
    basis.A.row(a) *= basis.D[a];
  }
  return basis;
}

} // namespace tribogel
