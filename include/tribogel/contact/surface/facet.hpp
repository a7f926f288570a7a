/// Facets of a surface in space: quadrilaterals with 4 (order 1) or 9 nodes (order 2), lexicographic in (xi,
/// eta) on
/// [-1, 1]^2, oriented such that dx/dxi x dx/deta points out of the body.
#pragma once

#include "tribogel/contact/node/dual_basis.hpp"
#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"
#include "tribogel/math/tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace tribogel
{

template <int order> using QuadPoints = std::array<Vector3<double>, tensor_nodes<2, order>>;
template <int order> using QuadShape = TensorShape<2, order>;

/// Shape functions of a facet. Beyond the square they go on linearly in each direction, with a continuous
/// slope: a quadratic facet that went on as a parabola would soon fold back over itself.
template <int order> QuadShape<order> quad_shape(const std::array<double, 2> &xi)
{
  LineShape<order> line[2];
  for (int j = 0; j < 2; ++j) {
    const double inside = std::clamp(xi[j], -1.0, 1.0);
    line[j] = line_shape<order>(inside);
    for (int a = 0; a <= order; ++a) line[j].value[a] += (xi[j] - inside) * line[j].slope[a];
  }
  QuadShape<order> shape;
  for (int a = 0; a < tensor_nodes<2, order>; ++a) {
    const int i = a % (order + 1), k = a / (order + 1);
    shape.N[a] = line[0].value[i] * line[1].value[k];
    shape.dN[a] = {line[0].slope[i] * line[1].value[k], line[0].value[i] * line[1].slope[k]};
  }
  return shape;
}

/// Where node `local` lies in a facet.
template <int order> std::array<double, 2> quad_corner(int local)
{
  const int column = local % (order + 1), row = local / (order + 1);
  return {2.0 * column / order - 1, 2.0 * row / order - 1};
}

/// sum_a N_a x_a
template <std::size_t nodes>
Vector3<double> interpolate(const std::array<double, nodes> &N, const std::array<Vector3<double>, nodes> &x)
{
  Vector3<double> sum = N[0] * x[0];
  for (std::size_t a = 1; a < nodes; ++a) sum += N[a] * x[a];
  return sum;
}

/// sum_a x_a dN_a/dxi_j
template <std::size_t nodes>
Vector3<double> tangent(const std::array<std::array<double, 2>, nodes> &dN,
                        const std::array<Vector3<double>, nodes> &x, int j)
{
  Vector3<double> sum = dN[0][j] * x[0];
  for (std::size_t a = 1; a < nodes; ++a) sum += dN[a][j] * x[a];
  return sum;
}

/// The reference weight dS/(dxi deta) of a facet as a polynomial, and the dual basis that belongs to it. The
/// weight is replaced by its interpolant at (order + 1)^2 Gauss points (exact on a flat facet of order 1):
/// its integrals with the basis are then exact in whatever polygons the facet is cut.
template <int order> struct QuadMeasure {
  static constexpr int nodes = tensor_nodes<2, order>;
  std::array<double, nodes> sample; ///< dS/(dxi deta) at the Gauss points [mm^2]
  DualBasis<nodes> basis;
  double area;                      ///< int dS [mm^2]
  std::array<double, nodes> extent; ///< int |N_a| dS [mm^2]

  struct Weight {
    double value;
    std::array<double, 2> slope; ///< d/dxi, d/deta
  };
  Weight weight(const std::array<double, 2> &xi) const
  {
    static const double outermost = gauss_rule<order + 1>().point[order];
    const auto shape = tensor_shape<2, order>({xi[0] / outermost, xi[1] / outermost});
    Weight w{};
    for (int q = 0; q < nodes; ++q) {
      w.value += shape.N[q] * sample[q];
      for (int j = 0; j < 2; ++j) w.slope[j] += shape.dN[q][j] / outermost * sample[q];
    }
    return w;
  }
};

/// Coordinates l of points near a facet in the plane that touches it at its centre: those of the square if
/// the facet is a parallelogram, and linear in the position, x - c = A l + e with A the tangents at the
/// centre c and e normal to them. Unlike xi they are defined everywhere.
template <int order> struct QuadFrame {
  QuadShape<order> at_centre = quad_shape<order>({0, 0});
  Vector3<double> centre;
  Eigen::Matrix<double, 3, 2> A;
  Eigen::Matrix<double, 2, 2> S; ///< (A^T A)^-1
  Eigen::Matrix<double, 2, 3> L; ///< l = L (x - c)

  explicit QuadFrame(const QuadPoints<order> &x) : centre(interpolate(at_centre.N, x))
  {
    A << tangent(at_centre.dN, x, 0), tangent(at_centre.dN, x, 1);
    S = (A.transpose() * A).inverse();
    L = S * A.transpose();
  }
  Vector2<double> operator()(const Vector3<double> &point) const { return L * (point - centre); }

  /// dl / dx_a of a fixed point. A^T A dl = dA^T e - A^T (dc + dA l).
  Eigen::Matrix<double, 2, 3> slope(const Vector3<double> &point, int a) const
  {
    const Vector2<double> l = (*this)(point);
    const Vector3<double> e = point - centre - A * l;
    const double moved = at_centre.N[a] + at_centre.dN[a][0] * l[0] + at_centre.dN[a][1] * l[1];
    Eigen::Matrix<double, 2, 3> turn;
    turn << at_centre.dN[a][0] * e.transpose(), at_centre.dN[a][1] * e.transpose();
    return S * turn - moved * L;
  }
};

/// A line parallel to that through two corners of a facet which has all its nodes on one side, in the
/// coordinates of its frame: normal . l <= normal . l(outermost).
template <int order> struct QuadSide {
  int from, to; ///< the corners
  Vector2<double> normal;
  int outermost; ///< the node on the line

  QuadSide(const QuadFrame<order> &frame, const QuadPoints<order> &x, int number)
  {
    constexpr int nodes = tensor_nodes<2, order>;
    constexpr int around[5] = {0, order, nodes - 1, nodes - 1 - order, 0};
    from = outermost = around[number];
    to = around[number + 1];
    const Vector2<double> along = frame(x[to]) - frame(x[from]);
    normal = {along[1], -along[0]};
    for (int b = 0; b < nodes; ++b)
      if (normal.dot(frame(x[b])) > normal.dot(frame(x[outermost]))) outermost = b;
  }
};

/// How far along n from x the plane through c with the normal m is [mm]; 0 if n hardly meets it.
inline double way_to_plane(const Vector3<double> &x, const Vector3<double> &n, const Vector3<double> &c,
                           const Vector3<double> &m)
{
  constexpr double least_slope = 0.1; // the line is 6 degrees off the plane
  const double slope = n.dot(m) / m.norm();
  return std::abs(slope) > least_slope ? (c - x).dot(m) / m.norm() / slope : 0;
}

template <int order> QuadMeasure<order> quad_measure(const QuadPoints<order> &X)
{
  constexpr int nodes = tensor_nodes<2, order>, points = 2 * order + 1; // exact for N_a N_b w
  static const auto sample = gauss_rule<order + 1>();
  static const auto rule = gauss_rule<points>();
  QuadMeasure<order> facet{};
  for (int q = 0; q < nodes; ++q) {
    const auto shape = tensor_shape<2, order>({sample.point[q % (order + 1)], sample.point[q / (order + 1)]});
    facet.sample[q] = tangent(shape.dN, X, 0).cross(tangent(shape.dN, X, 1)).norm();
  }
  std::array<double, nodes> D{};
  Eigen::Matrix<double, nodes, nodes> M = Eigen::Matrix<double, nodes, nodes>::Zero();
  for (int q = 0; q < points * points; ++q) {
    const std::array<double, 2> xi{rule.point[q % points], rule.point[q / points]};
    const auto N = tensor_shape<2, order>(xi).N;
    const double w = rule.weight[q % points] * rule.weight[q / points] * facet.weight(xi).value;
    facet.area += w;
    for (int a = 0; a < nodes; ++a) {
      D[a] += w * N[a];
      facet.extent[a] += w * std::abs(N[a]);
      for (int b = 0; b < nodes; ++b) M(a, b) += w * N[a] * N[b];
    }
  }
  facet.basis = dual_basis<nodes>(D, M);
  return facet;
}

/// How far a facet goes on beyond its sides xi = -1, xi = 1, eta = -1, eta = 1, in xi, at either end of each
/// side; 0 where the side is not the surface's edge.
using EdgeExtension = std::array<std::array<double, 2>, 4>;

/// A surface in its undeformed state.
struct QuadReference {
  std::vector<Vector3<double>> X;         ///< of each node [mm]
  std::vector<std::array<int, 9>> facets; ///< node numbers; order 1 uses the first four
};

/// Which facets meet at a node, and which of their sides are the surface's edge. Facets may be left out: they
/// are no node's neighbours and meet nothing.
struct QuadSurface {
  struct FacetNode {
    int facet, local; ///< the node is number `local` of `facet`
  };
  std::vector<std::array<int, 9>> facets;
  int order = 1;
  std::vector<std::vector<FacetNode>> neighbours; ///< of each node
  /// Sides xi = -1, xi = 1, eta = -1, eta = 1 of each facet that no other facet shares.
  std::vector<std::array<bool, 4>> on_edge;
  std::vector<bool> left_out; ///< of each facet; empty: none

  QuadSurface() = default;
  QuadSurface(std::vector<std::array<int, 9>> all_facets, int facet_order, int node_count,
              std::vector<bool> facets_left_out = {})
      : facets(std::move(all_facets)), order(facet_order), neighbours(static_cast<std::size_t>(node_count)),
        on_edge(facets.size()), left_out(std::move(facets_left_out))
  {
    std::map<std::array<int, 2>, int> uses;
    for (int f = 0; f < facet_count(); ++f) {
      for (int side = 0; side < 4; ++side) ++uses[ends(f, side)];
      if (!takes_part(f)) continue;
      for (int a = 0; a < facet_nodes(); ++a) neighbours[facets[f][a]].push_back({f, a});
    }
    for (int f = 0; f < facet_count(); ++f)
      for (int side = 0; side < 4; ++side) on_edge[f][side] = uses[ends(f, side)] == 1;
  }

  bool takes_part(int f) const { return left_out.empty() || !left_out[static_cast<std::size_t>(f)]; }

  int facet_count() const { return static_cast<int>(facets.size()); }
  int node_count() const { return static_cast<int>(neighbours.size()); }
  int facet_nodes() const { return (order + 1) * (order + 1); }

  /// Local numbers of the nodes on side `side` of a facet (as in on_edge), for depth > 0 of the row of nodes
  /// so many steps away from it.
  std::vector<int> nodes_along(int side, int depth = 0) const
  {
    const int across = side % 2 == 0 ? depth : order - depth;
    std::vector<int> local;
    for (int k = 0; k <= order; ++k)
      local.push_back(side < 2 ? across + k * (order + 1) : across * (order + 1) + k);
    return local;
  }

  /// The values of a nodal field on one facet.
  template <int facet_order, class Field> auto on_facet(int f, const Field &field) const
  {
    std::array<typename Field::value_type, tensor_nodes<2, facet_order>> values;
    for (std::size_t a = 0; a < values.size(); ++a) values[a] = field[facets[f][a]];
    return values;
  }

  /// The side's corners, which name it.
  std::array<int, 2> ends(int f, int side) const
  {
    const std::vector<int> along = nodes_along(side);
    const int a = facets[f][along.front()], b = facets[f][along.back()];
    return {std::min(a, b), std::max(a, b)};
  }
};

} // namespace tribogel
