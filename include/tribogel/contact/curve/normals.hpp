/// Averaged nodal normals of the slave curve.
///
/// The normal of a facet whose tangent t = dx/dxi points away from the axis is n = (t_z, -t_r) / |t|: out of
/// a body that lies above the curve, so it points down. At a node shared by two facets their unit normals are
/// added and the sum is normalised; at the curve's outer end (the rim, where a side wall begins) only the
/// curve's own facet counts. On the axis the neighbour is the facet's mirror image: n_r = 0 exactly, n = (0,
/// -1), whatever the facet does.
#pragma once

#include "tribogel/contact/curve/facet.hpp"
#include "tribogel/math/dual.hpp"

namespace tribogel
{

/// Unit normal to the right of a tangent vector.
template <class T> PlanePoint<T> normal_of(const PlanePoint<T> &tangent)
{
  const T inverse = 1 / length(tangent);
  return {tangent.z * inverse, -tangent.r * inverse};
}

/// The nodes whose positions a nodal normal depends on: those of its facets, none on the axis.
struct NormalStencil {
  int count = 0;
  std::array<int, 5> node;
};

inline NormalStencil normal_stencil(const LineChain &chain, int a, bool on_axis)
{
  NormalStencil stencil;
  if (on_axis) return stencil;
  for (int k = 0; k < chain.neighbours[a].count; ++k)
    for (int b = 0; b < chain.facet_nodes; ++b) {
      const int node = chain.facets[chain.neighbours[a].of[k].facet][b];
      if (k == 1 && node == a) continue;
      stencil.node[stencil.count++] = node;
    }
  return stencil;
}

/// `position(b)` gives the PlanePoint<T> of node b.
template <class T, class Position>
PlanePoint<T> nodal_normal(const LineChain &chain, int a, bool on_axis, const Position &position)
{
  if (on_axis) return {T(0), T(-1)};
  const auto facet_normal = [&]<int nodes>(LineChain::FacetNode at) {
    constexpr std::array<double, 3> xi{-1, 1, 0};
    FacetPoints<nodes, T> x;
    for (int b = 0; b < nodes; ++b) x[b] = position(chain.facets[at.facet][b]);
    return normal_of(interpolate(facet_shape<nodes>(xi[at.local]).dN, x));
  };
  PlanePoint<T> sum;
  const LineChain::Neighbours &facets = chain.neighbours[a];
  for (int k = 0; k < facets.count; ++k)
    sum += chain.facet_nodes == 2 ? facet_normal.template operator()<2>(facets.of[k])
                                  : facet_normal.template operator()<3>(facets.of[k]);
  if (facets.count < 2) return sum;
  const T inverse = 1 / length(sum);
  return {sum.r * inverse, sum.z * inverse};
}

/// A normal with its derivatives: dr[k], dz[k] with respect to coordinate k % 2 (r, z) of node stencil.node[k
/// / 2].
struct NormalWithDerivative {
  NormalStencil stencil;
  PlanePoint<Dual<10>> n;
};

inline NormalWithDerivative nodal_normal_derivative(const LineChain &chain, int a, bool on_axis,
                                                    const std::vector<PlanePoint<double>> &x)
{
  NormalWithDerivative normal{normal_stencil(chain, a, on_axis), {}};
  normal.n = nodal_normal<Dual<10>>(chain, a, on_axis, [&](int b) {
    int k = 0;
    while (normal.stencil.node[k] != b) ++k;
    return PlanePoint<Dual<10>>{Dual<10>::seed(x[b].r, 2 * k), Dual<10>::seed(x[b].z, 2 * k + 1)};
  });
  return normal;
}

} // namespace tribogel
