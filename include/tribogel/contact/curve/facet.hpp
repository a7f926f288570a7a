/// Facets of a meridian curve in the (r, z) half plane: shape functions, reference weight, chains of facets.
///
/// A facet has 2 nodes (order 1) or 3 (order 2): its ends first, the one nearer the axis before the other,
/// then the midside node; xi runs from -1 to 1 in the same direction. Surfaces are chains of facets ordered
/// from the axis outwards.
#pragma once

#include "tribogel/contact/node/dual_basis.hpp"
#include "tribogel/element/quadrature.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace tribogel
{

/// A point or vector of the half plane.
template <class T> struct PlanePoint {
  T r = 0, z = 0;

  PlanePoint &operator+=(const PlanePoint &b)
  {
    r += b.r, z += b.z;
    return *this;
  }
  friend PlanePoint operator-(const PlanePoint &a, const PlanePoint &b) { return {a.r - b.r, a.z - b.z}; }
  friend T dot(const PlanePoint &a, const PlanePoint &b) { return a.r * b.r + a.z * b.z; }
  friend T cross(const PlanePoint &a, const PlanePoint &b) { return a.r * b.z - a.z * b.r; }
  friend T length(const PlanePoint &a)
  {
    using std::sqrt;
    return sqrt(dot(a, a));
  }
};

template <int nodes, class T> using FacetPoints = std::array<PlanePoint<T>, nodes>;

template <int nodes, class T> struct FacetShape {
  std::array<T, nodes> N, dN; ///< values and derivatives with respect to xi
};

template <int nodes, class T> FacetShape<nodes, T> facet_shape(const T &xi)
{
  static_assert(nodes == 2 || nodes == 3);
  if constexpr (nodes == 2)
    return {{0.5 * (1 - xi), 0.5 * (1 + xi)}, {T(-0.5), T(0.5)}};
  else
    return {{0.5 * xi * (xi - 1), 0.5 * xi * (xi + 1), (1 - xi) * (1 + xi)}, {xi - 0.5, xi + 0.5, -2 * xi}};
}

/// sum_a N_a x_a. The weights may be constants while the points carry derivatives.
template <class W, class T, std::size_t nodes>
PlanePoint<T> interpolate(const std::array<W, nodes> &N, const std::array<PlanePoint<T>, nodes> &x)
{
  PlanePoint<T> sum{N[0] * x[0].r, N[0] * x[0].z};
  for (std::size_t a = 1; a < nodes; ++a) sum.r += N[a] * x[a].r, sum.z += N[a] * x[a].z;
  return sum;
}

/// Reference weight 2 pi R dS/dxi of a facet as a polynomial in xi, and the dual basis that belongs to it.
/// dS/dxi is replaced by its quadratic interpolant at three Gauss points (exact on a straight facet): every
/// integral of the weight with polynomials is then exact in whatever cells the facet is cut, so that the
/// cells add up to the facet to round-off.
template <int nodes> struct FacetMeasure {
  std::array<double, nodes> R;   ///< reference radii [mm]
  std::array<double, 3> stretch; ///< dS/dxi = stretch[0] + stretch[1] xi + stretch[2] xi^2 [mm]
  DualBasis<nodes> basis;
  double length;                    ///< int dS [mm]
  std::array<double, nodes> extent; ///< int |N_a| w, positive also where D_a = 0 [mm^2]

  /// dS/dxi [mm]
  template <class T> T stretch_at(const T &xi) const
  {
    return stretch[0] + xi * (stretch[1] + xi * stretch[2]);
  }

  /// 2 pi R dS/dxi [mm^2], given the shape functions at xi.
  template <class T> T weight(const std::array<T, nodes> &N, const T &xi) const
  {
    T radius = N[0] * R[0];
    for (int a = 1; a < nodes; ++a) radius += N[a] * R[a];
    return 2 * std::numbers::pi * radius * stretch_at(xi);
  }
};

template <int nodes> FacetMeasure<nodes> facet_measure(const FacetPoints<nodes, double> &X)
{
  static const auto sample = gauss_rule<3>();
  static const auto rule = gauss_rule<5>(); // exact for N_a N_b w, of degree 2 + 2 + 2 + 2
  FacetMeasure<nodes> facet{};
  std::array<double, 3> J;
  for (int q = 0; q < 3; ++q) J[q] = length(interpolate(facet_shape<nodes>(sample.point[q]).dN, X));
  const double g = sample.point[2];
  facet.stretch = {J[1], (J[2] - J[0]) / (2 * g), (J[2] - 2 * J[1] + J[0]) / (2 * g * g)};
  facet.length = 2 * (facet.stretch[0] + facet.stretch[2] / 3);
  for (int a = 0; a < nodes; ++a) facet.R[a] = X[a].r;

  std::array<double, nodes> D{};
  Eigen::Matrix<double, nodes, nodes> M = Eigen::Matrix<double, nodes, nodes>::Zero();
  for (int q = 0; q < 5; ++q) {
    const auto N = facet_shape<nodes>(rule.point[q]).N;
    const double w = rule.weight[q] * facet.weight(N, rule.point[q]);
    for (int a = 0; a < nodes; ++a) {
      D[a] += w * N[a];
      facet.extent[a] += w * std::abs(N[a]);
      for (int b = 0; b < nodes; ++b) M(a, b) += w * N[a] * N[b];
    }
  }
  facet.basis = dual_basis<nodes>(D, M);
  return facet;
}

/// A curve as a chain of facets, ordered from the axis outwards.
struct LineChain {
  struct FacetNode {
    int facet, local; ///< the node is number `local` of `facet`
  };
  struct Neighbours {
    int count = 0; ///< 1 at the curve's ends and at midside nodes, else 2 (inner facet first)
    std::array<FacetNode, 2> of;
  };

  std::vector<std::array<int, 3>> facets; ///< node numbers; the third is unused in order 1
  int facet_nodes = 2;                    ///< 2 or 3
  std::vector<Neighbours> neighbours;     ///< of each node

  LineChain() = default;
  LineChain(std::vector<std::array<int, 3>> ordered_facets, int nodes_per_facet, int node_count)
      : facets(std::move(ordered_facets)), facet_nodes(nodes_per_facet), neighbours(node_count)
  {
    for (int f = 0; f < facet_count(); ++f)
      for (int a = 0; a < facet_nodes; ++a) {
        Neighbours &node = neighbours[facets[f][a]];
        node.of[node.count++] = {f, a};
      }
  }

  int facet_count() const { return static_cast<int>(facets.size()); }
  int node_count() const { return static_cast<int>(neighbours.size()); }

  /// The values of a nodal field on one facet.
  template <int nodes, class Field> auto on_facet(int f, const Field &field) const
  {
    std::array<typename Field::value_type, nodes> values;
    for (int a = 0; a < nodes; ++a) values[a] = field[facets[f][a]];
    return values;
  }
};

} // namespace tribogel
