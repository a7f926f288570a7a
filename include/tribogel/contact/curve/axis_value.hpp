/// What stands on the axis of a surface of order 2. Its node there takes no part in the contact: int N R dR =
/// 0 where the midside node lies in the middle, so it carries no multiplier, no force reaches it, and the two
/// surfaces' nodes there pass through one another by a length of third order in the facet's. By symmetry
/// dp/dr = dz/dr = 0 there, and the two nodes next to it, which do take part, determine the parabola p_0 +
/// p_2 r^2 and its like for z.
///
/// A height is a node's own. A pressure is a nodal force over a nodal area, thus a mean,
///
///     p_a = int N_a p r ds / int N_a r ds = p_0 + p_2 q_a,    q_a = int N_a r^2 r ds / int N_a r ds,
///
/// over the facets around the node. So both are exact for parabolas, and of fourth order in the facet's
/// length.
#pragma once

#include "tribogel/contact/curve/area.hpp"

#include <span>

namespace tribogel
{

/// f_0 of f_0 + f_2 q, which is f[k] at q[k].
inline double even_intercept(const std::array<double, 2> &q, const std::array<double, 2> &f)
{
  return (f[0] * q[1] - f[1] * q[0]) / (q[1] - q[0]);
}

/// Height of the curve on the axis [mm]. `x`: current places of its nodes from the axis, where the first one
/// is, outwards; of order 2.
inline double height_on_axis(std::span<const PlanePoint<double>> x)
{
  return even_intercept({x[1].r * x[1].r, x[2].r * x[2].r}, {x[1].z, x[2].z});
}

/// The mean of r^2 over the current area of the curve's node `a` [mm^2].
inline double mean_square_radius(std::span<const PlanePoint<double>> x, std::size_t a)
{
  static const auto rule = gauss_rule<5>();
  double area = 0, moment = 0;
  for (std::size_t first = 0; first + 2 < x.size(); first += 2) {
    if (a < first || a > first + 2) continue;
    const FacetPoints<3, double> facet{x[first], x[first + 2], x[first + 1]};
    const std::size_t local = a == first ? 0 : a == first + 2 ? 1 : 2;
    for (int q = 0; q < 5; ++q) {
      const auto shape = facet_shape<3>(rule.point[q]);
      const double r = interpolate(shape.N, facet).r;
      const double weight = rule.weight[q] * shape.N[local] * r * length(interpolate(shape.dN, facet));
      area += weight;
      moment += weight * r * r;
    }
  }
  return moment / area;
}

/// Pressure on the axis [MPa], given those of the two nodes next to it; a gel does not pull: at least zero.
inline double pressure_on_axis(std::span<const PlanePoint<double>> x, const std::array<double, 2> &p)
{
  return std::max(0.0, even_intercept({mean_square_radius(x, 1), mean_square_radius(x, 2)}, p));
}

} // namespace tribogel
