/// The integrand of the mortar integrals of a pair of facets in space at one point of the slave facet, with
/// its derivatives:
///
///     psi_a(xi) N_b(eta) J(xi),     x(xi) + g n(xi) = y(eta)
///
/// with J the reference weight and n(xi) = sum N_a n_a (THEORY, section 3.7). Whoever chooses the points sums
/// it up.
#pragma once

#include "tribogel/contact/node/report.hpp"
#include "tribogel/contact/surface/facet.hpp"
#include "tribogel/contact/surface/samples.hpp"

#include <algorithm>

namespace tribogel
{

template <int order> struct QuadPair {
  QuadPoints<order> x, n, y; ///< slave positions and normals, master positions
  EdgeExtension beyond{};    ///< of the master facet
  double neighbourhood = 1;  ///< the master's outline is cut to the slave's, at least so many times as wide
};

template <int order> struct QuadPairMortar {
  static constexpr int nodes = tensor_nodes<2, order>;
  using Matrix = Eigen::Matrix<double, nodes, nodes, Eigen::RowMajor>;
  MortarStatus status = MortarStatus::ok;
  double covered = 0;        ///< area in xi: 4 when summed over the master surface
  double overhang = 0;       ///< reference area beyond the master's edge [mm^2]
  Matrix M = Matrix::Zero(); ///< [slave node][master node] [mm^2]
  /// dM, row a nodes + b; columns: slave positions, normals, master positions, three components each. Empty
  /// unless asked for.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> dM;
};

namespace quad_mortar
{

// Newton's method for x(xi) + g n(xi) = y(eta).
constexpr double projection_tolerance = 1e-9; ///< of the last step; what is left is its square
constexpr int most_iterations = 30;
constexpr double longest_step = 0.5; ///< where half a facet has length 1

/// The measure of Newton's steps in a facet's xi: half its longer extent has length 1 in either direction.
/// Over a facet that is long and narrow a small way leads across many of its widths, and round-off is a part
/// of its width that is as many times larger.
template <int order> class StepMeasure
{
public:
  explicit StepMeasure(const QuadPoints<order> &x)
  {
    const auto shape = quad_shape<order>({0, 0});
    const double length[2] = {tangent(shape.dN, x, 0).norm(), tangent(shape.dN, x, 1).norm()};
    for (int j = 0; j < 2; ++j) extent[j] = length[j] / std::max(length[0], length[1]);
  }

  double operator()(const Vector3<double> &step) const
  {
    return std::max(extent[0] * std::abs(step[0]), extent[1] * std::abs(step[1]));
  }

  /// Shortened where it leaves the neighbourhood in which the facet is nearly plane.
  Vector3<double> limited(const Vector3<double> &step) const
  {
    return step * std::min(1.0, longest_step / (*this)(step));
  }

private:
  std::array<double, 2> extent; ///< over the longer
};

template <int order> class Point
{
public:
  static constexpr int nodes = tensor_nodes<2, order>;

  Point(const QuadMeasure<order> &slave_measure, const QuadPair<order> &facet_pair)
      : measure(slave_measure), pair(facet_pair), measured(facet_pair.y)
  {
    for (int b = 0; b < nodes; ++b) y.col(b) << pair.y[b], 0;
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

  /// Newton's method, which starts where the last one ended, and would be by then if facets were flat.
  Meeting meet(const std::array<double, 2> &xi)
  {
    Meeting at;
    at.xi = xi;
    at.slave = quad_shape<order>(xi);
    const Vector3<double> point = interpolate(at.slave.N, pair.x), normal = interpolate(at.slave.N, pair.n);
    at.eta = start(point, normal);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      at.master = quad_shape<order>(at.eta);
      const MasterPlace place = master_place(at.master);
      Matrix3<double> A;
      A << place.t1.template head<3>(), place.t2.template head<3>(), -normal;
      const Matrix3<double> inverse = A.inverse();
      const Vector3<double> step =
          measured.limited(inverse * (point + at.g * normal - place.y.template head<3>()));
      if (!step.allFinite()) return at;
      at.eta[0] += step[0];
      at.eta[1] += step[1];
      at.g += step[2];
      if (measured(step) > projection_tolerance) continue;
      at.master = quad_shape<order>(at.eta);
      at.slope = inverse.template topRows<2>();
      at.found = true;
      at.from_front = A.col(0).cross(A.col(1)).dot(normal) < 0;
      last = {at.eta, at.g, point + at.g * normal, at.slope};
      return at;
    }
    return at;
  }

  /// Adds a row to the samples: all that sums of the integrand times `weight` are made of, or of its values
  /// only. Returns the weight if the point is beyond the master's edge [mm^2].
  double sample(const Meeting &at, double weight, bool with_derivatives, Samples<order> &out) const
  {
    const int q = out.count++;
    const auto psi = measure.basis(at.slave.N);
    const auto J = measure.weight(at.xi);
    for (int a = 0; a < nodes; ++a) {
      out.psi(q, a) = weight * J.value * psi[a];
      out.N(q, a) = at.master.N[a];
    }
    if (with_derivatives) {
      sample_inputs(at, weight * J.value, q, out);
      for (int j = 0; j < 2; ++j)
        for (int a = 0; a < nodes; ++a) {
          double d_psi = 0;
          for (int c = 0; c < nodes; ++c) d_psi += measure.basis.A(a, c) * at.slave.dN[c][j];
          out.d_psi[j](q, a) = weight * (J.slope[j] * psi[a] + J.value * d_psi);
        }
    }
    return is_beyond_edge(at.eta) ? weight * J.value : 0;
  }

private:
  using Padded = Eigen::Matrix<double, 4, 1>; ///< a vector and 0: a register's worth
  struct MasterPlace {
    Padded y, t1, t2; ///< position and tangents
  };
  struct Last {
    std::array<double, 2> eta{};
    double g = 0;
    Vector3<double> y = Vector3<double>::Zero();
    Eigen::Matrix<double, 2, 3> slope = Eigen::Matrix<double, 2, 3>::Zero();
  };
  const QuadMeasure<order> &measure;
  const QuadPair<order> &pair;
  StepMeasure<order> measured; ///< in eta
  Eigen::Matrix<double, 4, nodes> y;
  Last last;

  std::array<double, 2> start(const Vector3<double> &point, const Vector3<double> &normal) const
  {
    const Vector2<double> on = last.slope * (point + last.g * normal - last.y);
    const Vector3<double> step = measured.limited({on[0], on[1], 0});
    if (!step.allFinite()) return last.eta;
    return {last.eta[0] + step[0], last.eta[1] + step[1]};
  }

  MasterPlace master_place(const QuadShape<order> &shape) const
  {
    MasterPlace at{shape.N[0] * y.col(0), shape.dN[0][0] * y.col(0), shape.dN[0][1] * y.col(0)};
    for (int b = 1; b < nodes; ++b) {
      at.y += shape.N[b] * y.col(b);
      at.t1 += shape.dN[b][0] * y.col(b);
      at.t2 += shape.dN[b][1] * y.col(b);
    }
    return at;
  }

  /// How N follows the position of the meeting point, what that follows, and both when the point moves along
  /// xi.
  void sample_inputs(const Meeting &at, double W, int q, Samples<order> &out) const
  {
    Eigen::Matrix<double, 3, 2> along;
    for (int j = 0; j < 2; ++j)
      along.col(j) = tangent(at.slave.dN, pair.x, j) + at.g * tangent(at.slave.dN, pair.n, j);
    const Eigen::Matrix2d moved = at.slope * along;
    for (int b = 0; b < nodes; ++b) {
      for (int i = 0; i < 3; ++i)
        out.by_x(q, 3 * b + i) =
            W * (at.master.dN[b][0] * at.slope(0, i) + at.master.dN[b][1] * at.slope(1, i));
      for (int j = 0; j < 2; ++j)
        out.d_N[j](q, b) = at.master.dN[b][0] * moved(0, j) + at.master.dN[b][1] * moved(1, j);
      out.slave(q, b) = at.slave.N[b];
      out.slave_g(q, b) = at.g * at.slave.N[b];
    }
  }

  bool is_beyond_edge(const std::array<double, 2> &eta) const
  {
    const auto passed = [&](int side) { return (side % 2 == 0 ? -1 : 1) * eta[side / 2] > 1; };
    for (int side = 0; side < 4; ++side)
      if (pair.beyond[side][0] > 0 && passed(side)) return true;
    return false;
  }
};

} // namespace quad_mortar

} // namespace tribogel
