/// The current area that belongs to a slave node in space, int N_a |t_1 x t_2|: a nodal force over it is a
/// Cauchy traction.
#pragma once

#include "tribogel/contact/surface/facet.hpp"

#include <utility>
#include <vector>

namespace tribogel
{

/// An area and its derivatives by the positions of the nodes listed.
struct QuadArea {
  double value = 0;                               ///< [mm^2]
  std::vector<std::pair<int, Vector3<double>>> d; ///< (node, d value/dx) [mm]; empty unless asked for
};

namespace quad_area
{
template <int order>
void add_facet(const QuadSurface &surface, const QuadSurface::FacetNode &at, int tied,
               const std::vector<Vector3<double>> &x, bool with_derivatives, QuadArea &sum)
{
  static const auto rule = gauss_rule<order + 1>();
  constexpr int nodes = tensor_nodes<2, order>;
  const QuadPoints<order> points = surface.on_facet<order>(at.facet, x);
  std::array<Vector3<double>, nodes> slope;
  slope.fill(Vector3<double>::Zero());
  for (int q = 0; q < nodes; ++q) {
    const int i = q % (order + 1), j = q / (order + 1);
    const auto shape = tensor_shape<2, order>({rule.point[i], rule.point[j]});
    double N = shape.N[at.local];
    for (int b = 0; b < nodes; ++b)
      if (surface.facets[at.facet][b] == tied) N += shape.N[b];
    N *= rule.weight[i] * rule.weight[j];
    const Vector3<double> t1 = tangent(shape.dN, points, 0), t2 = tangent(shape.dN, points, 1),
                          c = t1.cross(t2);
    sum.value += N * c.norm();
    const Vector3<double> n = c.normalized(), by_t1 = N * t2.cross(n), by_t2 = N * n.cross(t1);
    for (int b = 0; b < nodes; ++b) slope[b] += shape.dN[b][0] * by_t1 + shape.dN[b][1] * by_t2;
  }
  if (!with_derivatives) return;
  for (int b = 0; b < nodes; ++b) sum.d.emplace_back(surface.facets[at.facet][b], slope[b]);
}
} // namespace quad_area

/// x are the positions of all nodes; `tied` is the crease node whose share of the facets is a's too, -1:
/// none. A node of several facets is listed several times.
inline QuadArea nodal_area(const QuadSurface &surface, int a, int tied, const std::vector<Vector3<double>> &x,
                           bool with_derivatives)
{
  QuadArea area;
  for (const auto &at : surface.neighbours[a])
    if (surface.order == 1)
      quad_area::add_facet<1>(surface, at, tied, x, with_derivatives, area);
    else
      quad_area::add_facet<2>(surface, at, tied, x, with_derivatives, area);
  return area;
}

} // namespace tribogel
