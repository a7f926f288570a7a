/// The integrand of the mortar integrals of a pair of facets in space at one point of the slave facet, with its
/// derivatives:
///
///     psi_a(xi) N_b(eta) J(xi),     x(xi) + g n(xi) = y(eta)
///
/// with J the reference weight and n(xi) = sum N_a n_a (THEORY, section 3.7). Whoever chooses the points sums it up.
#pragma once

#include "tribogel/contact/quad_facet.hpp"
#include "tribogel/contact/report.hpp"

#include <algorithm>

namespace tribogel
{

/// How far a master facet is extended beyond a side that is the surface's edge, in eta (the facet has length 2).
inline constexpr double edge_extension = 1;

template <int order> struct QuadPair {
  QuadPoints<order> x, n, y;     ///< slave positions and normals, master positions
  std::array<bool, 4> on_edge{}; ///< sides of the master facet that are extended
  double neighbourhood = 0;      ///< the master's outline is cut to the slave's, so many times as wide
};

template <int order> struct QuadPairMortar {
  static constexpr int nodes = tensor_nodes<2, order>;
  using Matrix = Eigen::Matrix<double, nodes, nodes, Eigen::RowMajor>;
  MortarStatus status = MortarStatus::ok;
  double covered = 0;        ///< area in xi: 4 when summed over the master surface
  double overhang = 0;       ///< reference area beyond the master's edge [mm^2]
  Matrix M = Matrix::Zero(); ///< [slave node][master node] [mm^2]
  /// dM, row a nodes + b; columns: slave positions, normals, master positions, three components each. Empty unless
  /// asked for.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> dM;
};

namespace quad_mortar
{

// Newton's method for x(xi) + g n(xi) = y(eta).
constexpr double projection_tolerance = 1e-9; ///< of the last step; what is left is its square
constexpr int most_iterations = 30;
constexpr double longest_step = 0.5; ///< in xi and eta, where half a facet has length 1

/// Newton's step, shortened where it leaves the neighbourhood in which the facet is nearly plane.
inline Vector3<double> limited(const Vector3<double> &step)
{
  return step * std::min(1.0, longest_step / std::max(std::abs(step[0]), std::abs(step[1])));
}

template <int order> class Point
{
public:
  static constexpr int nodes = tensor_nodes<2, order>, inputs = 9 * nodes;
  using Result = QuadPairMortar<order>;
  using ByXi = Eigen::Matrix<double, nodes * nodes, 2, Eigen::RowMajor>;

  Point(const QuadMeasure<order> &slave_measure, const QuadPair<order> &facet_pair)
      : measure(slave_measure), pair(facet_pair)
  {
  }

  /// The master's point that the slave's normal line at xi meets.
  struct Meeting {
    QuadShape<order> slave;  ///< shape functions at xi
    QuadShape<order> master; ///< and at eta
    std::array<double, 2> xi{}, eta{};
    double g = 0;                          ///< along the normal [mm]
    Eigen::Matrix<double, 2, 3> slope;     ///< d eta / d x [1/mm]
    bool found = false, from_front = true; ///< the normal enters the master's body
  };

  /// Newton's method, which starts where the last one ended.
  Meeting meet(const std::array<double, 2> &xi)
  {
    Meeting at;
    at.xi = xi;
    at.slave = quad_shape<order>(xi);
    const Vector3<double> point = interpolate(at.slave.N, pair.x), normal = interpolate(at.slave.N, pair.n);
    at.eta = last_eta;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      at.master = quad_shape<order>(at.eta);
      Matrix3<double> A;
      for (int j = 0; j < 2; ++j) A.col(j) = tangent(at.master.dN, pair.y, j);
      A.col(2) = -normal;
      const Matrix3<double> inverse = A.inverse();
      const Vector3<double> step = limited(inverse * (point + at.g * normal - interpolate(at.master.N, pair.y)));
      if (!step.allFinite()) return at;
      at.eta[0] += step[0];
      at.eta[1] += step[1];
      at.g += step[2];
      if (std::abs(step[0]) > projection_tolerance || std::abs(step[1]) > projection_tolerance) continue;
      at.master = quad_shape<order>(at.eta);
      at.slope = inverse.template topRows<2>();
      at.found = true;
      at.from_front = A.col(0).cross(A.col(1)).dot(normal) < 0;
      last_eta = at.eta;
      return at;
    }
    return at;
  }

  /// Adds the integrand times `weight` to `M`, and to `overhang` its share beyond the master's edge.
  void add(const Meeting &at, double weight, typename Result::Matrix &M, double &overhang) const
  {
    const double W = weight * measure.weight(at.xi).value;
    const auto psi = measure.basis(at.slave.N);
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) M(a, b) += W * psi[a] * at.master.N[b];
    if (is_beyond_edge(at.eta)) overhang += W;
  }

  /// With W = weight J psi_a: through eta of the data, W dN_b/deta deta/dx (N_c dx_c + g N_c dn_c - N_c(eta) dy_c).
  template <class Slope> void add_slope(const Meeting &at, double weight, Slope &dM) const
  {
    const auto psi = measure.basis(at.slave.N);
    const double J = measure.weight(at.xi).value;
    const auto by_x = position_slope(at);
    Eigen::Matrix<double, nodes, inputs, Eigen::RowMajor> row; // of each b, without psi_a
    for (int b = 0; b < nodes; ++b)
      for (int c = 0; c < nodes; ++c)
        for (int i = 0; i < 3; ++i) {
          const double d = weight * J * at.slave.N[c] * by_x[b][i];
          row(b, 3 * c + i) = d;
          row(b, 3 * (nodes + c) + i) = at.g * d;
          row(b, 3 * (2 * nodes + c) + i) = -weight * J * at.master.N[c] * by_x[b][i];
        }
    for (int a = 0; a < nodes; ++a) dM.template middleRows<nodes>(a * nodes) += psi[a] * row;
  }

  /// The integrand's derivative by xi, for points that move in the slave facet.
  ByXi slope_along(const Meeting &at) const
  {
    const auto psi = measure.basis(at.slave.N);
    const auto J = measure.weight(at.xi);
    const auto by_x = position_slope(at);
    ByXi slope;
    for (int j = 0; j < 2; ++j) {
      const Vector3<double> along = tangent(at.slave.dN, pair.x, j) + at.g * tangent(at.slave.dN, pair.n, j);
      for (int a = 0; a < nodes; ++a) {
        double d_psi = 0;
        for (int c = 0; c < nodes; ++c) d_psi += measure.basis.A(a, c) * at.slave.dN[c][j];
        for (int b = 0; b < nodes; ++b)
          slope(a * nodes + b, j) =
              (J.slope[j] * psi[a] + J.value * d_psi) * at.master.N[b] + J.value * psi[a] * by_x[b].dot(along);
      }
    }
    return slope;
  }

private:
  const QuadMeasure<order> &measure;
  const QuadPair<order> &pair;
  std::array<double, 2> last_eta{};

  /// Of the master's shape functions by the position of the meeting point.
  std::array<Vector3<double>, nodes> position_slope(const Meeting &at) const
  {
    std::array<Vector3<double>, nodes> by_x;
    for (int b = 0; b < nodes; ++b)
      by_x[b] = (at.master.dN[b][0] * at.slope.row(0) + at.master.dN[b][1] * at.slope.row(1)).transpose();
    return by_x;
  }

  bool is_beyond_edge(const std::array<double, 2> &eta) const
  {
    return (pair.on_edge[0] && eta[0] < -1) || (pair.on_edge[1] && eta[0] > 1) || (pair.on_edge[2] && eta[1] < -1) ||
           (pair.on_edge[3] && eta[1] > 1);
  }
};

} // namespace quad_mortar

} // namespace tribogel
