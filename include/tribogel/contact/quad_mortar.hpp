/// Mortar integrals of one pair of facets in space, exact cells, with their derivatives.
///
///     M_ab = int psi_a(xi) N_b(eta(xi)) J(xi) dxi,     J the reference weight of the slave facet
///
/// over the part of the slave facet that faces the master facet: along the normals n(xi) = sum N_a n_a (THEORY, section
/// 3.7). The master's outline, as a polygon of points at fixed eta, is projected into the slave's parameter plane,
///
///     x(xi) + g n(xi) = y(eta)                                                                   for (xi, g),
///
/// clipped to the square [-1, 1]^2 and cut into triangles with Gauss points, whose eta follows from the same equation
/// for (eta, g). Master facets that share an outline thus tile the slave's square without gap or overlap, and sum_b
/// M_ab over all of them is D_a to round-off. A quadratic or distorted facet's projected outline is a curve, of which
/// the polygon takes the chords: Gauss points between the two lie just outside the master facet, where its shape
/// functions go on.
///
/// Derivatives are those of this very computation: dM/d(x_a, n_a, y_b).
#pragma once

#include "tribogel/contact/quad_point.hpp"

#include <utility>

namespace tribogel
{

/// Points of a master facet's sides beyond its corners in parameter space: 1 for order 1, 2 (the midside node) for
/// order 2.
template <int order> inline constexpr int outline_chords = order;

/// The master's outline is first cut to the slave facet's, so many times as wide, in the coordinates of QuadFrame:
/// points far from a distorted facet have no projection.
inline constexpr double outline_margin = 1.1;

/// And at most so many times, however the facet is distorted.
inline constexpr double widest_outline = 6;

/// Gauss points on a triangle as barycentric weights (product rule on the collapsed square); weights add up to 1. Exact
/// to degree 2 n - 2.
template <int n> struct TriangleRule {
  std::array<std::array<double, 3>, n * n> point;
  std::array<double, n * n> weight;
};

template <int n> TriangleRule<n> triangle_rule()
{
  const auto line = gauss_rule<n>();
  TriangleRule<n> rule;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double p = 0.5 * (1 + line.point[i]), q = 0.5 * (1 - p) * (1 + line.point[j]);
      rule.point[i * n + j] = {1 - p - q, p, q};
      rule.weight[i * n + j] = 0.5 * line.weight[i] * line.weight[j] * (1 - p);
    }
  return rule;
}

/// How wide the slave facet's outline must be for a pair: so wide that the facet is inside, and what its normals meet
/// on the master. In steps, since between them the cut depends on the facet through the frame only. All pairs of a
/// slave facet must be given the same: facets that share a side must be cut at the same point of it.
template <int order> double outline_width(const QuadMeasure<order> &measure, const QuadPair<order> &pair)
{
  const QuadFrame<order> frame(pair.x), master(pair.y);
  const Vector3<double> m = master.A.col(0).cross(master.A.col(1));
  double wider = 1;
  for (std::size_t a = 0; a < pair.x.size(); ++a) {
    const Vector3<double> met = pair.x[a] + way_to_plane(pair.x[a], pair.n[a], master.centre, m) * pair.n[a];
    for (const auto &side : measure.outline)
      for (const Vector3<double> &x : {pair.x[a], met})
        while (side.normal.dot(frame(x)) > wider * side.distance && wider < widest_outline) wider *= outline_margin;
  }
  return wider * outline_margin;
}

namespace quad_mortar
{

/// Degree 10 and 12 a triangle. On flat parallelograms psi_a N_b has degree 4 and 8; elsewhere it is no polynomial, and
/// what the rule misses changes as the surfaces slide and the cells are cut otherwise. On the paper scene, whose two
/// meshes begin with common lines where round-off decides about cuts, Newton's method stalled at 4 times its tolerance
/// with rules of degree 4, in 184 of 670 solves; with these no solve fails.
template <int order> inline constexpr int rule_points = order + 5;

/// A cut ends on its line, to so much of the square.
constexpr double cut_round_off = 1e-14;

template <int order> class Kernel
{
public:
  static constexpr int nodes = tensor_nodes<2, order>, inputs = 9 * nodes;
  using Result = QuadPairMortar<order>;

  Kernel(const QuadMeasure<order> &slave_measure, const QuadPair<order> &facet_pair, bool derivatives)
      : measure(slave_measure), pair(facet_pair), point(slave_measure, facet_pair), with_derivatives(derivatives)
  {
  }

  Result integrate()
  {
    if (!project_outline()) return out;
    clip();
    if (polygon.size() < 3) return out;
    if (with_derivatives) {
      out.dM.setZero(nodes * nodes, inputs);
      by_vertex.assign(polygon.size(), ByVertex::Zero());
    }
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) add_triangle({0, k, k + 1});
    if (with_derivatives)
      for (std::size_t k = 0; k < polygon.size(); ++k)
        if (polygon[k].moves) out.dM.noalias() += by_vertex[k] * polygon[k].d;
    return out;
  }

private:
  /// A corner of a polygon: in space at first, then in the slave's parameter plane.
  template <int dim> struct Corner {
    Eigen::Matrix<double, dim, 1> at = Eigen::Matrix<double, dim, 1>::Zero();
    bool moves = false;                                    ///< has derivatives
    Eigen::Matrix<double, dim, inputs, Eigen::RowMajor> d; ///< by the inputs, set if it moves
  };
  using Place = Corner<3>;
  using Vertex = Corner<2>;
  using ByVertex = typename Point<order>::ByXi;
  using Row = Eigen::Matrix<double, 1, inputs>;

  const QuadMeasure<order> &measure;
  const QuadPair<order> &pair;
  Point<order> point;
  bool with_derivatives;
  std::vector<Place> places;
  std::vector<Vertex> polygon;
  std::vector<ByVertex> by_vertex; ///< dM / d xi of each vertex
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

  /// Points at fixed eta.
  void outline()
  {
    constexpr int chords = outline_chords<order>;
    std::array<double, 4> end{-1, 1, -1, 1};
    for (int side = 0; side < 4; ++side)
      if (pair.on_edge[side]) end[side] += side % 2 == 0 ? -edge_extension : edge_extension;
    const double corner[5][2] = {
        {end[0], end[2]}, {end[1], end[2]}, {end[1], end[3]}, {end[0], end[3]}, {end[0], end[2]}};
    places.clear();
    for (int side = 0; side < 4; ++side)
      for (int k = 0; k < chords; ++k) {
        const double t = static_cast<double>(k) / chords;
        const auto shape = quad_shape<order>(
            {(1 - t) * corner[side][0] + t * corner[side + 1][0], (1 - t) * corner[side][1] + t * corner[side + 1][1]});
        Place place;
        place.at = interpolate(shape.N, pair.y);
        place.moves = with_derivatives;
        if (with_derivatives) {
          place.d.setZero();
          for (int m = 0; m < nodes; ++m)
            place.d.template middleCols<3>(3 * (2 * nodes + m)).diagonal().setConstant(shape.N[m]);
        }
        places.push_back(std::move(place));
      }
  }

  void cut_to_neighbourhood(const QuadFrame<order> &frame)
  {
    const double margin = pair.neighbourhood;
    for (const auto &side : measure.outline)
      cut(
          places, [&](const Place &p) { return margin * side.distance - side.normal.dot(frame(p.at)); },
          [&](const Place &p) {
            Row d = -side.normal.transpose() * frame.L * p.d;
            for (int a = 0; a < nodes; ++a)
              d.template segment<3>(3 * a) -= side.normal.transpose() * frame.slope(p.at, a);
            return d;
          });
  }

  static double cross(const Vector2<double> &a, const Vector2<double> &b) { return a[0] * b[1] - a[1] * b[0]; }

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
      const Vector3<double> step = limited(inverse * (place.at - interpolate(shape.N, pair.x) - g * normal));
      if (!step.allFinite()) return false;
      xi[0] += step[0];
      xi[1] += step[1];
      g += step[2];
      if (std::abs(step[0]) > projection_tolerance || std::abs(step[1]) > projection_tolerance) continue;
      vertex.at = {xi[0], xi[1]};
      vertex.moves = with_derivatives;
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
            if (p.moves) p.d.row(axis).setZero();
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
      v.moves = with_derivatives;
      if (with_derivatives) {
        const Row dt = (in_p * slope(q) - in_q * slope(p)) / ((in_p - in_q) * (in_p - in_q));
        v.d = (1 - t) * p.d + t * q.d + (q.at - p.at) * dt;
      }
      left.push_back(std::move(v));
    }
    points = std::move(left);
  }

  void add_triangle(const std::array<std::size_t, 3> &corner)
  {
    static const auto rule = triangle_rule<rule_points<order>>();
    const Vector2<double> &p = polygon[corner[0]].at, e1 = polygon[corner[1]].at - p, e2 = polygon[corner[2]].at - p;
    const double area = -0.5 * cross(e1, e2); // positive: the outline runs clockwise
    if (area == 0 && !with_derivatives) return;
    out.covered += area;
    typename Result::Matrix mean = Result::Matrix::Zero();
    for (std::size_t q = 0; q < rule.weight.size(); ++q) add_point(corner, rule.point[q], rule.weight[q], area, mean);
    out.M += area * mean;
    if (!with_derivatives) return;
    // d area / d vertex: half the opposite edge, turned
    const Vector2<double> edge[3] = {polygon[corner[2]].at - polygon[corner[1]].at, -e2, e1};
    for (int k = 0; k < 3; ++k) {
      const Vector2<double> slope(0.5 * edge[k][1], -0.5 * edge[k][0]);
      const Eigen::Map<const Eigen::Matrix<double, nodes * nodes, 1>> all(mean.data());
      by_vertex[corner[k]].noalias() += all * slope.transpose();
    }
  }

  void add_point(const std::array<std::size_t, 3> &corner, const std::array<double, 3> &share, double rule_weight,
                 double area, typename Result::Matrix &mean)
  {
    Vector2<double> xi = Vector2<double>::Zero();
    for (int k = 0; k < 3; ++k) xi += share[k] * polygon[corner[k]].at;
    const auto meeting = point.meet({xi[0], xi[1]});
    if (!meeting.found) {
      out.status = MortarStatus::no_projection;
      return;
    }
    double beyond = 0;
    point.add(meeting, rule_weight, mean, beyond);
    out.overhang += area * beyond;
    if (!with_derivatives) return;
    point.add_slope(meeting, rule_weight * area, out.dM);
    const ByVertex slope = rule_weight * area * point.slope_along(meeting); // the point moves with the triangle
    for (int k = 0; k < 3; ++k) by_vertex[corner[k]] += share[k] * slope;
  }
};

} // namespace quad_mortar

template <int order>
QuadPairMortar<order> quad_pair_mortar(const QuadMeasure<order> &slave, const QuadPair<order> &pair, bool derivatives)
{
  return quad_mortar::Kernel<order>(slave, pair, derivatives).integrate();
}

} // namespace tribogel
