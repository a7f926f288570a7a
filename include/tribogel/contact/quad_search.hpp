/// Candidate pairs of facets of two surfaces in space, from a bounding-volume tree (Boost.Geometry) over the master's
/// facets.
#pragma once

#include "tribogel/contact/quad_facet.hpp"

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
} // namespace quad_search

/// Pairs (slave facet, master facet) that may meet along the slave's nodal normals n, sorted. Each slave facet's box is
/// swept along its normals to and fro by its distance from the master and its own size, and widened by `margin` [mm]:
/// the pairs found stay sufficient while the surfaces slide by less than that. More pairs than needed cost little; the
/// mortar integrals tell when the master facets found do not cover a slave facet.
inline std::vector<std::pair<int, int>> candidate_pairs(const QuadSurface &slave, const std::vector<Vector3<double>> &x,
                                                        const std::vector<Vector3<double>> &n,
                                                        const QuadSurface &master,
                                                        const std::vector<Vector3<double>> &y, double margin)
{
  namespace index = boost::geometry::index;
  std::vector<std::pair<quad_search::Box, int>> boxes;
  for (int m = 0; m < master.facet_count(); ++m) {
    quad_search::Box box = quad_search::facet_box(master, m, y);
    const auto &edge = master.on_edge[m];
    if (std::any_of(edge.begin(), edge.end(), [](bool b) { return b; }))
      quad_search::inflate(box, 0.5 * quad_search::size_of(box)); // the facet is extended
    boxes.emplace_back(box, m);
  }
  const quad_search::Tree tree(boxes); // packed

  std::vector<std::pair<int, int>> pairs;
  for (int f = 0; f < slave.facet_count(); ++f) {
    quad_search::Box box = quad_search::facet_box(slave, f, x);
    double distance = 0;
    for (auto it = tree.qbegin(index::nearest(box, 1)); it != tree.qend(); ++it)
      distance = boost::geometry::distance(box, it->first);
    const double reach = distance + 0.5 * quad_search::size_of(box);
    for (int a = 0; a < slave.facet_nodes(); ++a) {
      const int node = slave.facets[f][a];
      quad_search::extend(box, x[node] + reach * n[node]);
      quad_search::extend(box, x[node] - reach * n[node]);
    }
    quad_search::inflate(box, margin);
    for (auto it = tree.qbegin(index::intersects(box)); it != tree.qend(); ++it) pairs.emplace_back(f, it->second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace tribogel
