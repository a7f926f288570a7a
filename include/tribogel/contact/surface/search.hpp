/// Candidate pairs of facets of two surfaces in space, from a bounding-volume tree (Boost.Geometry) over the
/// master's facets.
#pragma once

#include "tribogel/contact/surface/facet.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace tribogel
{

namespace quad_search
{
using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;
using Tree = boost::geometry::index::rtree<std::pair<Box, int>, boost::geometry::index::quadratic<16>>;

inline void extend(Box &box, const Vector3<double> &p)
{
  boost::geometry::expand(box, Corner(p[0], p[1], p[2]));
}

/// Of the facet's nodes: a quadratic facet bulges out of it by less than an eighth of its length.
inline Box facet_box(const QuadSurface &surface, int f, const std::vector<Vector3<double>> &x)
{
  Box box;
  boost::geometry::assign_inverse(box);
  for (int a = 0; a < surface.facet_nodes(); ++a) extend(box, x[surface.facets[f][a]]);
  return box;
}

inline double size_of(const Box &box)
{
  return boost::geometry::distance(box.min_corner(), box.max_corner());
}

inline void inflate(Box &box, double by)
{
  using boost::geometry::get;
  box = Box(Corner(get<0, 0>(box) - by, get<0, 1>(box) - by, get<0, 2>(box) - by),
            Corner(get<1, 0>(box) + by, get<1, 1>(box) + by, get<1, 2>(box) + by));
}

/// Of all facets; those at the surface's edge are extended.
inline Tree tree_of(const QuadSurface &surface, const std::vector<Vector3<double>> &x)
{
  std::vector<std::pair<Box, int>> boxes;
  for (int f = 0; f < surface.facet_count(); ++f) {
    Box box = facet_box(surface, f, x);
    const auto &edge = surface.on_edge[f];
    if (std::any_of(edge.begin(), edge.end(), [](bool b) { return b; })) inflate(box, 0.5 * size_of(box));
    boxes.emplace_back(box, f);
  }
  return Tree(boxes); // packed
}
} // namespace quad_search

/// Pairs (slave facet, master facet) that may meet along the slave's nodal normals n, sorted. Each slave
/// facet's box is swept along its normals to and fro by the way to the master (where they meet the plane of
/// the nearest facet, and its distance at least) and half its own size, and widened by `margin` [mm]: the
/// pairs found stay sufficient while the surfaces slide by less than that. More pairs than needed cost
/// little; the mortar integrals tell when the master facets found do not cover a slave facet.
inline std::vector<std::pair<int, int>> candidate_pairs(const QuadSurface &slave,
                                                        const std::vector<Vector3<double>> &x,
                                                        const std::vector<Vector3<double>> &n,
                                                        const QuadSurface &master,
                                                        const std::vector<Vector3<double>> &y, double margin)
{
  namespace index = boost::geometry::index;
  const quad_search::Tree tree = quad_search::tree_of(master, y);

  std::vector<std::pair<int, int>> pairs;
  for (int f = 0; f < slave.facet_count(); ++f) {
    if (!slave.takes_part(f)) continue;
    quad_search::Box box = quad_search::facet_box(slave, f, x);
    const double size = quad_search::size_of(box);
    double distance = 0;
    int nearest = 0;
    for (auto it = tree.qbegin(index::nearest(box, 1)); it != tree.qend(); ++it) {
      distance = boost::geometry::distance(box, it->first);
      nearest = it->second;
    }
    const auto &corner = master.facets[nearest];
    const int last = master.facet_nodes() - 1;
    const Vector3<double> m =
        (y[corner[last]] - y[corner[0]]).cross(y[corner[last - master.order]] - y[corner[master.order]]);
    for (int a = 0; a < slave.facet_nodes(); ++a) {
      const int node = slave.facets[f][a];
      const double way = std::abs(way_to_plane(x[node], n[node], y[corner[0]], m));
      const double reach = std::max(distance, way) + 0.5 * size;
      quad_search::extend(box, x[node] + reach * n[node]);
      quad_search::extend(box, x[node] - reach * n[node]);
    }
    quad_search::inflate(box, margin);
    for (auto it = tree.qbegin(index::intersects(box)); it != tree.qend(); ++it)
      pairs.emplace_back(f, it->second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace tribogel
