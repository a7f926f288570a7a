/// The mortar integrals of a pair of facets over a polygon in the slave's parameter plane, as a sum over the
/// triangles between its edges and a point in its middle, with Gauss points on each.
///
/// psi_a N_b J is no polynomial in general, so the triangles' rule misses something, and what it misses
/// depends on where the triangles lie. They move continuously with the surfaces, also where a corner of the
/// polygon is cut off or two meet: a side may become short and vanish, and its triangle with it. (Triangles
/// from one of the corners do not: another corner takes its place when it leaves the slave facet, and the
/// integrals jump by what the rule misses. Newton's method then has no solution to find, below that.)
#pragma once

#include "tribogel/contact/surface/point.hpp"

#include <vector>

namespace tribogel
{

/// Gauss points on a triangle as barycentric weights (product rule on the collapsed square); weights add up
/// to 1. Exact to degree 2 n - 2.
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

namespace quad_mortar
{

/// Degree 8 and 10 a triangle. On flat parallelograms psi_a N_b has degree 4 and 8. Beyond that the degree is
/// seen where lines of both meshes lie on each other to round-off, as on coaxial cylinders before they turn:
/// a master's vertex on a slave's side divides a triangle or does not. With degree 8 at order 2 the paper
/// scene's residual then jumps by 1e-9 of the forces, with degree 10 by less than round-off.
template <int order> inline constexpr int rule_points = order + 4;

template <int order> class Fan
{
public:
  static constexpr int nodes = tensor_nodes<2, order>;
  using Result = QuadPairMortar<order>;
  using ByXi = typename CornerSlopes<order>::ByXi;

  std::vector<ByXi> by_vertex; ///< dM / d xi of each vertex of the polygon

  Fan(const QuadMeasure<order> &slave_measure, const QuadPair<order> &facet_pair, bool derivatives)
      : point(slave_measure, facet_pair), basis(slave_measure.basis.A), with_derivatives(derivatives)
  {
    if (derivatives) slopes.clear();
  }

  /// Adds the integrals over a clockwise polygon, and to dM what it changes by when the polygon stays.
  void integrate(const std::vector<Vector2<double>> &polygon, Result &out)
  {
    by_vertex.assign(polygon.size(), ByXi::Zero());
    by_middle.setZero();
    find_middle(polygon);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t next = (k + 1) % polygon.size();
      add_triangle({middle, polygon[k], polygon[next]}, {&by_middle, &by_vertex[k], &by_vertex[next]}, out);
    }
    if (!with_derivatives) return;
    share_middle(polygon);
    slopes.add_to(basis, out.dM);
  }

private:
  using Triangle = std::array<Vector2<double>, 3>;

  Point<order> point;
  const Eigen::Matrix<double, nodes, nodes> &basis; ///< psi = basis N
  Samples<order> samples;                           ///< of one triangle
  typename CornerSlopes<order>::Shares shares;
  SampleSlopes<order> slopes;
  CornerSlopes<order> corner_slopes;
  bool with_derivatives;
  Vector2<double> middle;
  ByXi by_middle;

  static double cross(const Vector2<double> &a, const Vector2<double> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /// The mean of the outline: a vertex that divides, or two that meet, do not move it.
  void find_middle(const std::vector<Vector2<double>> &polygon)
  {
    double length = 0;
    middle.setZero();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector2<double> &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      length += (q - p).norm();
      middle += 0.5 * (q - p).norm() * (p + q);
    }
    if (length > 0)
      middle /= length;
    else
      middle = polygon[0];
  }

  /// The middle's share of the derivatives goes to the vertices.
  void share_middle(const std::vector<Vector2<double>> &polygon)
  {
    double length = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      length += (polygon[(k + 1) % polygon.size()] - polygon[k]).norm();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t next = (k + 1) % polygon.size();
      const Vector2<double> along = polygon[next] - polygon[k];
      const double edge = along.norm();
      if (edge == 0) continue;
      const Vector2<double> arm = 0.5 * (polygon[k] + polygon[next]) - middle;
      const Eigen::Matrix2d longer = arm * along.transpose() / (edge * length),
                            shifted = 0.5 * edge / length * Eigen::Matrix2d::Identity();
      by_vertex[k] += by_middle * (shifted - longer);
      by_vertex[next] += by_middle * (shifted + longer);
    }
  }

  /// `by_corner`: sums of dM / d xi of the corners.
  void add_triangle(const Triangle &corner, const std::array<ByXi *, 3> &by_corner, Result &out)
  {
    static const auto rule = triangle_rule<rule_points<order>>();
    const Vector2<double> e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const double area = -0.5 * cross(e1, e2); // positive: the outline runs clockwise
    if (area == 0 && !with_derivatives) return;
    out.covered += area;
    double beyond = 0;
    samples.count = 0;
    for (std::size_t q = 0; q < rule.weight.size(); ++q) {
      Vector2<double> xi = Vector2<double>::Zero();
      for (int c = 0; c < 3; ++c) xi += rule.point[q][c] * corner[c];
      const auto meeting = point.meet({xi[0], xi[1]});
      if (!meeting.found) {
        out.status = MortarStatus::no_projection;
        continue;
      }
      for (int c = 0; c < 3; ++c) shares(samples.count, c) = rule.point[q][c];
      beyond += point.sample(meeting, rule.weight[q], with_derivatives, samples);
    }
    const typename Result::Matrix mean = samples.integral();
    out.overhang += area * beyond;
    out.M += area * mean;
    if (!with_derivatives) return;
    slopes.add(samples, area);
    corner_slopes.add(samples, shares, area, by_corner);
    // d area / d corner: half the opposite edge, turned
    const Vector2<double> edge[3] = {corner[2] - corner[1], -e2, e1};
    for (int c = 0; c < 3; ++c) {
      const Vector2<double> slope(0.5 * edge[c][1], -0.5 * edge[c][0]);
      const Eigen::Map<const Eigen::Matrix<double, nodes * nodes, 1>> all(mean.data());
      by_corner[c]->noalias() += all * slope.transpose();
    }
  }
};

} // namespace quad_mortar

} // namespace tribogel
