/// The current area that belongs to a slave node, int N_a 2 pi r ds: a nodal force over it is a Cauchy
/// traction.
#pragma once

#include "tribogel/contact/curve/facet.hpp"
#include "tribogel/math/dual.hpp"

#include <algorithm>

namespace tribogel
{

/// Of one facet, of its node number `local`, and of its first node as well if `with_first` [mm^2].
template <int nodes, class T> T facet_area(const FacetPoints<nodes, T> &points, int local, bool with_first)
{
  static const auto rule = gauss_rule<5>();
  T area = 0;
  for (int q = 0; q < 5; ++q) {
    const auto shape = facet_shape<nodes>(rule.point[q]);
    const double N = shape.N[local] + (with_first ? shape.N[0] : 0);
    area += rule.weight[q] * N * 2 * std::numbers::pi * interpolate(shape.N, points).r *
            length(interpolate(shape.dN, points));
  }
  return area;
}

/// x are the positions of all nodes; `tied` is the crease node whose share of the first facet is a's too, -1:
/// none [mm^2].
template <class T> T nodal_area(const LineChain &chain, int a, int tied, const std::vector<PlanePoint<T>> &x)
{
  T area = 0;
  for (int k = 0; k < chain.neighbours[a].count; ++k) {
    const auto [f, local] = chain.neighbours[a].of[k];
    const bool with_crease = chain.facets[f][0] == tied;
    area += chain.facet_nodes == 2 ? facet_area<2, T>(chain.on_facet<2>(f, x), local, with_crease)
                                   : facet_area<3, T>(chain.on_facet<3>(f, x), local, with_crease);
  }
  return area;
}

/// d nodal_area / d (r, z) of each node in a list that contains those of a's facets [mm].
template <int nodes>
std::vector<PlanePoint<double>> nodal_area_derivative(const LineChain &chain, int a, int tied,
                                                      const std::vector<PlanePoint<double>> &x,
                                                      const std::vector<int> &list)
{
  using D = Dual<2 * nodes>;
  std::vector<PlanePoint<double>> slope(list.size());
  for (int k = 0; k < chain.neighbours[a].count; ++k) {
    const auto [f, local] = chain.neighbours[a].of[k];
    FacetPoints<nodes, D> points;
    for (int b = 0; b < nodes; ++b) {
      const PlanePoint<double> &at = x[chain.facets[f][b]];
      points[b] = {D::seed(at.r, 2 * b), D::seed(at.z, 2 * b + 1)};
    }
    const D area = facet_area<nodes, D>(points, local, chain.facets[f][0] == tied);
    for (int b = 0; b < nodes; ++b) {
      const auto at = std::find(list.begin(), list.end(), chain.facets[f][b]);
      slope[static_cast<std::size_t>(at - list.begin())] +=
          PlanePoint<double>{area.d[2 * b], area.d[2 * b + 1]};
    }
  }
  return slope;
}

} // namespace tribogel
