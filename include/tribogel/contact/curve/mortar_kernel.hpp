/// Mortar integrals of one slave and one master facet in the half plane,
///
///     M_am = int psi_a(xi) N_m(eta(xi)) 2 pi R(xi) dS
///
/// over the cell: the part of the slave facet that faces the master facet. eta is the projection along the
/// slave's interpolated normal n(xi) = sum_a N_a n_a, that is (y(eta) - x(xi)) x n(xi) = 0. The cell's ends
/// are the projections of the master's ends, or the slave's own. Summed over a chain of master facets the
/// cells cover the slave facet once, and sum_m M_am = D_a to round-off.
///
/// Where a slave facet hangs over the master's edge, the outermost master facet is continued along its end
/// tangent (the innermost one likewise inwards), so that sum_m M_am = D_a still holds and neither tends to
/// zero. What is integrated there is a fiction; its length is reported so that it can be refused.
///
/// T = double, or Dual with derivatives with respect to slave positions, slave normals and master positions.
#pragma once

#include "tribogel/contact/curve/facet.hpp"
#include "tribogel/contact/node/report.hpp"
#include "tribogel/math/dual.hpp"

namespace tribogel
{

template <int nodes, class T> struct LinePair {
  FacetPoints<nodes, T> x, n, y;               ///< slave positions and normals, master positions
  bool inner_edge = false, outer_edge = false; ///< the master facet is the first, the last of its chain
};

template <int nodes, class T> struct LinePairMortar {
  MortarStatus status = MortarStatus::ok;
  std::array<std::array<T, nodes>, nodes> M{}; ///< [slave node][master node], mm^2
  double covered = 0;  ///< length of the cells in xi: 2 when summed over the master chain
  double overhang = 0; ///< reference length beyond the master's edge [mm]
};

/// Root of an increasing function in [low, high]: Newton's method kept inside the shrinking bracket. `f`
/// returns the value and the slope.
template <class Function> bool bracketed_root(const Function &f, double low, double high, double &x)
{
  constexpr double tolerance = 1e-10; // of the last step; what is left is its square
  for (int iteration = 0; iteration < 100; ++iteration) {
    const auto [residual, slope] = f(x);
    (residual < 0 ? low : high) = x;
    double next = x - residual / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = std::abs(next - x);
    x = next;
    if (step <= tolerance) return std::isfinite(residual);
  }
  return false;
}

namespace line_mortar
{

template <class T> struct SlaveLine {
  T offset, slope; ///< of a point from the normal line at xi, and its derivative with respect to xi
};

/// (y - x(xi)) x n(xi), and its derivative with respect to xi. It increases with xi on a sound facet.
template <int nodes, class T>
SlaveLine<T> offset_from_slave(const FacetPoints<nodes, T> &x, const FacetPoints<nodes, T> &n,
                               const PlanePoint<T> &y, double xi)
{
  const auto shape = facet_shape<nodes>(xi);
  const PlanePoint<T> normal = interpolate(shape.N, n), arm = y - interpolate(shape.N, x);
  return {cross(arm, normal), cross(arm, interpolate(shape.dN, n)) - cross(interpolate(shape.dN, x), normal)};
}

template <int nodes, class T> FacetPoints<nodes, double> values(const FacetPoints<nodes, T> &points)
{
  FacetPoints<nodes, double> plain;
  for (int a = 0; a < nodes; ++a) plain[a] = {value(points[a].r), value(points[a].z)};
  return plain;
}

/// One facet pair, with its values apart: projections are found in double, then one Newton step in T makes
/// them exact to first order.
template <int nodes, class T> class Kernel
{
public:
  Kernel(const FacetMeasure<nodes> &slave_measure, const LinePair<nodes, T> &facet_pair)
      : measure(slave_measure), pair(facet_pair), x(values<nodes>(pair.x)), n(values<nodes>(pair.n)),
        y(values<nodes>(pair.y))
  {
  }

  LinePairMortar<nodes, T> integrate()
  {
    const T inner = clip(0), outer = clip(1);
    if (out.status != MortarStatus::ok) return out;
    if (value(outer) < value(inner) - length_round_off) {
      out.status = MortarStatus::folded;
      return out;
    }
    add_cell(inner, outer, 0);
    if (pair.inner_edge) add_cell(T(-1), inner, -1);
    if (pair.outer_edge) add_cell(outer, T(1), 1);
    return out;
  }

private:
  static constexpr double length_round_off = 1e-14;
  const FacetMeasure<nodes> &measure;
  const LinePair<nodes, T> &pair;
  FacetPoints<nodes, double> x, n, y;
  LinePairMortar<nodes, T> out;

  /// Where the master's end projects to on the slave facet, -1 or 1 if that is beyond. Neighbouring slave
  /// facets decide this from the same numbers at their shared node, and so do neighbouring master facets: no
  /// cell is lost or doubled.
  T clip(int end)
  {
    const double low = offset_from_slave<nodes>(x, n, y[end], -1).offset;
    const double high = offset_from_slave<nodes>(x, n, y[end], 1).offset;
    const bool before = !(low < 0), beyond = !(high > 0);
    if (before && beyond)
      out.status = std::isfinite(low + high) ? MortarStatus::folded : MortarStatus::no_projection;
    if (before) return T(-1);
    if (beyond) return T(1);
    double xi = 0;
    const bool found = bracketed_root(
        [&](double at) {
          const auto line = offset_from_slave<nodes>(x, n, y[end], at);
          return std::pair(line.offset, line.slope);
        },
        -1, 1, xi);
    const auto line = offset_from_slave<nodes>(pair.x, pair.n, pair.y[end], xi);
    if (!found)
      out.status = MortarStatus::no_projection;
    else if (!(value(line.slope) > 0))
      out.status = MortarStatus::folded;
    const T root = xi - line.offset / line.slope;
    if (value(root) < -1) return T(-1); // by round-off, which short facets far from the axis magnify
    return value(root) > 1 ? T(1) : root;
  }

  /// Shape functions of the master facet where the normal line from `point` meets it.
  std::array<T, nodes> on_facet(const PlanePoint<T> &point, const PlanePoint<T> &normal, double guess)
  {
    const PlanePoint<double> p{value(point.r), value(point.z)}, m{value(normal.r), value(normal.z)};
    double eta = guess;
    const bool found = bracketed_root(
        [&](double at) {
          const auto shape = facet_shape<nodes>(at);
          return std::pair(cross(p - interpolate(shape.N, y), m), -cross(interpolate(shape.dN, y), m));
        },
        -1, 1, eta);
    const auto shape = facet_shape<nodes>(eta);
    const T slope = cross(interpolate(shape.dN, pair.y), normal);
    if (!found)
      out.status = MortarStatus::no_projection;
    else if (!(value(slope) < 0))
      out.status = MortarStatus::folded;
    return facet_shape<nodes>(T(eta + cross(point - interpolate(shape.N, pair.y), normal) / slope)).N;
  }

  /// The same on the tangent line through the master's end `edge` (-1 or 1).
  std::array<T, nodes> on_extension(const PlanePoint<T> &point, const PlanePoint<T> &normal, int edge)
  {
    const auto shape = facet_shape<nodes>(double(edge));
    const T slope = cross(interpolate(shape.dN, pair.y), normal);
    if (!(value(slope) < 0)) out.status = MortarStatus::folded;
    const T beyond = cross(point - pair.y[edge < 0 ? 0 : 1], normal) / slope;
    std::array<T, nodes> N;
    for (int m = 0; m < nodes; ++m) N[m] = shape.N[m] + beyond * shape.dN[m];
    return N;
  }

  /// Gauss points between two values of xi; edge = 0: facing the facet, else its extension. Three points
  /// (order 1) and five (order 2) are exact where both facets are straight: psi N_m R dS/dxi has degree 3
  /// and 8.
  void add_cell(const T &from, const T &to, int edge)
  {
    constexpr int points = nodes == 2 ? 3 : 5;
    static const auto rule = gauss_rule<points>();
    const T half = 0.5 * (to - from), middle = 0.5 * (to + from);
    if (2 * value(half) <= length_round_off) return;
    out.covered += 2 * value(half);
    for (int q = 0; q < points; ++q) {
      const T xi = middle + half * rule.point[q];
      const auto shape = facet_shape<nodes>(xi);
      const PlanePoint<T> point = interpolate(shape.N, pair.x), normal = interpolate(shape.N, pair.n);
      const T facing = cross(interpolate(shape.dN, pair.x), normal);
      if (!(value(facing) < 0)) out.status = MortarStatus::folded;
      const auto N = edge == 0 ? on_facet(point, normal, rule.point[q]) : on_extension(point, normal, edge);
      const T weight = half * rule.weight[q] * measure.weight(shape.N, xi);
      const auto psi = measure.basis(shape.N);
      for (int a = 0; a < nodes; ++a) {
        const T weighted = weight * psi[a];
        for (int m = 0; m < nodes; ++m) out.M[a][m] += weighted * N[m];
      }
      if (edge != 0) out.overhang += value(half) * rule.weight[q] * measure.stretch_at(value(xi));
    }
  }
};

} // namespace line_mortar

template <int nodes, class T>
LinePairMortar<nodes, T> line_pair_mortar(const FacetMeasure<nodes> &slave, const LinePair<nodes, T> &pair)
{
  return line_mortar::Kernel<nodes, T>(slave, pair).integrate();
}

} // namespace tribogel
