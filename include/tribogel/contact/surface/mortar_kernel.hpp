/// Mortar integrals of one pair of facets in space, exact cells, with their derivatives.
///
///     M_ab = int psi_a(xi) N_b(eta(xi)) J(xi) dxi,     J the reference weight of the slave facet
///
/// over the part of the slave facet that faces the master facet: along the normals n(xi) = sum N_a n_a
/// (THEORY, section 3.7). The master's outline, as a polygon of points at fixed eta, is projected into the
/// slave's parameter plane,
///
///     x(xi) + g n(xi) = y(eta)                                                                   for (xi,
///     g),
///
/// clipped to the square [-1, 1]^2 and cut into triangles (Fan) with Gauss points, whose eta follows from the
/// same equation for (eta, g). Master facets that share an outline thus tile the slave's square without gap
/// or overlap, and sum_b M_ab over all of them is D_a to round-off. A quadratic or distorted facet's
/// projected outline is a curve, of which the polygon takes the chords: Gauss points between the two lie just
/// outside the master facet, where its shape functions go on.
///
/// Derivatives are those of this very computation: dM/d(x_a, n_a, y_b).
#pragma once

#include "tribogel/contact/surface/fan.hpp"

#include <utility>

namespace tribogel
{

/// The master's outline is first cut to the slave facet's, so many times as wide, in the coordinates of
/// QuadFrame: points far from a distorted facet have no projection.
inline constexpr double outline_margin = 1.1;

namespace quad_mortar
{

/// A cut ends on its line, to so much of the square.
constexpr double cut_round_off = 1e-14;

template <int order> class Kernel
{
public:
  static constexpr int nodes = tensor_nodes<2, order>, inputs = 9 * nodes;
  using Result = QuadPairMortar<order>;

  Kernel(const QuadMeasure<order> &slave_measure, const QuadPair<order> &facet_pair, bool derivatives)
      : measure(slave_measure), pair(facet_pair), measured(facet_pair.x), with_derivatives(derivatives)
  {
  }

  Result integrate()
  {
    if (!project_outline()) return out;
    clip();
    if (polygon.size() < 3) return out;
    std::vector<Vector2<double>> corners;
    for (const Vertex &vertex : polygon) corners.push_back(vertex.at);
    if (with_derivatives) out.dM.setZero(nodes * nodes, inputs);
    Fan<order> fan(measure, pair, with_derivatives);
    fan.integrate(corners, out);
    if (with_derivatives)
      for (std::size_t k = 0; k < polygon.size(); ++k) out.dM.noalias() += fan.by_vertex[k] * polygon[k].d;
    return out;
  }

private:
  /// A corner of a polygon: in space at first, then in the slave's parameter plane.
  template <int dim> struct Corner {
    Eigen::Matrix<double, dim, 1> at = Eigen::Matrix<double, dim, 1>::Zero();
    Eigen::Matrix<double, dim, inputs, Eigen::RowMajor> d; ///< by the inputs, set if asked for
  };
  using Place = Corner<3>;
  using Vertex = Corner<2>;
  using Row = Eigen::Matrix<double, 1, inputs>;

  const QuadMeasure<order> &measure;
  const QuadPair<order> &pair;
  StepMeasure<order> measured; ///< in xi
  bool with_derivatives;
  std::vector<Place> places;
  std::vector<Vertex> polygon;
  Result out;

  /// Whether the master's outline meets the slave facet's square, seen from the front.
  bool project_outline()
  {
    const QuadFrame<order> frame(pair.x);
    outline();
    cut_to_neighbourhood(frame);
    polygon.clear();
    Vector2<double> low(2, 2), high(-2, -2);
    for (const Place &place : places) {
      Vertex vertex;
      if (!project_on_slave(place, frame(place.at), vertex) && !project_on_slave(place, {0, 0}, vertex)) {
        out.status = MortarStatus::no_projection;
        return false;
      }
      low = low.cwiseMin(vertex.at);
      high = high.cwiseMax(vertex.at);
      polygon.push_back(std::move(vertex));
    }
    const bool apart = low[0] >= 1 || low[1] >= 1 || high[0] <= -1 || high[1] <= -1;
    return !apart && area_of(polygon) < 0; // out of the master is into the slave: its outline runs clockwise
  }

  /// Points at fixed eta: corners, nodes of the sides, and where an extension begins.
  void outline()
  {
    const EdgeExtension &beyond = pair.beyond;
    const double corner[5][2] = {{-1 - beyond[0][0], -1 - beyond[2][0]},
                                 {1 + beyond[1][0], -1 - beyond[2][1]},
                                 {1 + beyond[1][1], 1 + beyond[3][1]},
                                 {-1 - beyond[0][1], 1 + beyond[3][0]},
                                 {-1 - beyond[0][0], -1 - beyond[2][0]}};
    places.clear();
    for (int side = 0; side < 4; ++side) {
      const double *const from = corner[side], *const to = corner[side + 1];
      add_place({from[0], from[1]});
      const int along = side % 2;
      for (int k = 0; k <= order; ++k) {
        const double node = (side < 2 ? 1 : -1) * (2.0 * k / order - 1);
        const double t = (node - from[along]) / (to[along] - from[along]);
        if (t > 0 && t < 1) add_place({(1 - t) * from[0] + t * to[0], (1 - t) * from[1] + t * to[1]});
      }
    }
  }

  void add_place(const std::array<double, 2> &eta)
  {
    const auto shape = quad_shape<order>(eta);
    Place place;
    place.at = interpolate(shape.N, pair.y);
    if (with_derivatives) {
      place.d.setZero();
      for (int m = 0; m < nodes; ++m)
        place.d.template middleCols<3>(3 * (2 * nodes + m)).diagonal().setConstant(shape.N[m]);
    }
    places.push_back(std::move(place));
  }

  /// d l / d (the slave facet's positions) of its node b.
  Eigen::Matrix<double, 2, 3 * nodes> node_slope(const QuadFrame<order> &frame, int b) const
  {
    Eigen::Matrix<double, 2, 3 * nodes> d;
    for (int a = 0; a < nodes; ++a) d.template middleCols<3>(3 * a) = frame.slope(pair.x[b], a);
    d.template middleCols<3>(3 * b) += frame.L;
    return d;
  }

  void cut_to_neighbourhood(const QuadFrame<order> &frame)
  {
    const double margin = outline_margin * pair.neighbourhood;
    for (int number = 0; number < 4; ++number) {
      const QuadSide<order> side(frame, pair.x, number);
      const Vector2<double> &normal = side.normal, reach = margin * frame(pair.x[side.outermost]);
      Eigen::Matrix<double, 1, 3 * nodes> d_reach;
      Eigen::Matrix<double, 2, 3 * nodes> d_along;
      if (with_derivatives) {
        d_reach = margin * normal.transpose() * node_slope(frame, side.outermost);
        d_along = node_slope(frame, side.to) - node_slope(frame, side.from);
      }
      cut(
          places, [&](const Place &p) { return normal.dot(reach - frame(p.at)); },
          [&](const Place &p) {
            const Vector2<double> arm = reach - frame(p.at);
            Row d = -normal.transpose() * frame.L * p.d;
            d.template head<3 * nodes>() += d_reach + arm[0] * d_along.row(1) - arm[1] * d_along.row(0);
            for (int a = 0; a < nodes; ++a)
              d.template segment<3>(3 * a) -= normal.transpose() * frame.slope(p.at, a);
            return d;
          });
    }
  }

  static double cross(const Vector2<double> &a, const Vector2<double> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  static double area_of(const std::vector<Vertex> &vertices)
  {
    double sum = 0;
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k)
      sum += cross(vertices[k].at - vertices[0].at, vertices[k + 1].at - vertices[0].at);
    return 0.5 * sum;
  }

  /// Newton's method for (xi, g) from a guess.
  bool project_on_slave(const Place &place, const Vector2<double> &guess, Vertex &vertex) const
  {
    double g = 0;
    std::array<double, 2> xi{guess[0], guess[1]};
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const auto shape = quad_shape<order>(xi);
      const Vector3<double> normal = interpolate(shape.N, pair.n);
      Matrix3<double> A;
      for (int j = 0; j < 2; ++j) A.col(j) = tangent(shape.dN, pair.x, j) + g * tangent(shape.dN, pair.n, j);
      A.col(2) = normal;
      const Matrix3<double> inverse = A.inverse();
      const Vector3<double> step =
          measured.limited(inverse * (place.at - interpolate(shape.N, pair.x) - g * normal));
      if (!step.allFinite()) return false;
      xi[0] += step[0];
      xi[1] += step[1];
      g += step[2];
      if (measured(step) > projection_tolerance) continue;
      vertex.at = {xi[0], xi[1]};
      if (!with_derivatives) return true;
      const Eigen::Matrix<double, 2, 3> B = inverse.topRows<2>();
      vertex.d.noalias() = B * place.d;
      for (int a = 0; a < nodes; ++a) {
        vertex.d.template middleCols<3>(3 * a) -= shape.N[a] * B;
        vertex.d.template middleCols<3>(3 * (nodes + a)) -= g * shape.N[a] * B;
      }
      return true;
    }
    return false;
  }

  /// To the square.
  void clip()
  {
    for (int axis = 0; axis < 2; ++axis)
      for (const double side : {-1.0, 1.0}) {
        cut(
            polygon, [&](const Vertex &p) { return 1 - side * p.at[axis]; },
            [&](const Vertex &p) { return Row(-side * p.d.row(axis)); });
        for (Vertex &p : polygon)
          if (1 - side * p.at[axis] < cut_round_off) { // on the side, exactly
            p.at[axis] = side;
            if (with_derivatives) p.d.row(axis).setZero();
          }
      }
  }

  /// One step of Sutherland and Hodgman's algorithm: what of a polygon lies where `inside` is not negative.
  template <class Point, class Inside, class Slope>
  void cut(std::vector<Point> &points, const Inside &inside, const Slope &slope) const
  {
    std::vector<Point> left;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point &p = points[k], &q = points[(k + 1) % points.size()];
      const double in_p = inside(p), in_q = inside(q);
      if (in_p >= 0) left.push_back(p);
      if ((in_p >= 0) == (in_q >= 0)) continue;
      const double t = in_p / (in_p - in_q);
      Point v;
      v.at = p.at + t * (q.at - p.at);
      if (with_derivatives) {
        const Row dt = (in_p * slope(q) - in_q * slope(p)) / ((in_p - in_q) * (in_p - in_q));
        v.d = (1 - t) * p.d + t * q.d + (q.at - p.at) * dt;
      }
      left.push_back(std::move(v));
    }
    points = std::move(left);
  }
};

} // namespace quad_mortar

template <int order>
QuadPairMortar<order> quad_pair_mortar(const QuadMeasure<order> &slave, const QuadPair<order> &pair,
                                       bool derivatives)
{
  return quad_mortar::Kernel<order>(slave, pair, derivatives).integrate();
}

} // namespace tribogel
