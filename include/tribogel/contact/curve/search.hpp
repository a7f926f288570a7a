/// Candidate facet pairs of two meridian curves, from a bounding-volume tree (Boost.Geometry) over the
/// master's facets.
#pragma once

#include "tribogel/contact/curve/facet.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace tribogel
{

namespace search
{
using Corner = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;
using Tree = boost::geometry::index::rtree<std::pair<Box, int>, boost::geometry::index::quadratic<16>>;

inline void extend(Box &box, const PlanePoint<double> &p)
{
  boost::geometry::expand(box, Corner(p.r, p.z));
}

/// Of the facet's nodes: a quadratic facet bulges out of it by less than an eighth of its length.
inline Box facet_box(const LineChain &chain, int f, const std::vector<PlanePoint<double>> &x)
{
  Box box;
  boost::geometry::assign_inverse(box);
  for (int a = 0; a < chain.facet_nodes; ++a) extend(box, x[chain.facets[f][a]]);
  return box;
}

inline void inflate(Box &box, double by)
{
  using boost::geometry::get;
  box =
      Box(Corner(get<0, 0>(box) - by, get<0, 1>(box) - by), Corner(get<1, 0>(box) + by, get<1, 1>(box) + by));
}
} // namespace search

/// Pairs (slave facet, master facet) that the mortar integrals need, sorted: for each slave facet an unbroken
/// run of master facets that covers it along its nodal normals n, up to the master's edges. The tree gives
/// the facets within the slave facet's box swept to the master's distance; the run is then extended until the
/// normals at both ends of the slave facet are passed, so that no reach has to be guessed. `margin` [mm]
/// widens the box: the pairs found stay sufficient while the surfaces slide by less than that.
inline std::vector<std::pair<int, int>>
candidate_pairs(const LineChain &slave, const std::vector<PlanePoint<double>> &x,
                const std::vector<PlanePoint<double>> &n, const LineChain &master,
                const std::vector<PlanePoint<double>> &y, double margin)
{
  namespace index = boost::geometry::index;
  std::vector<std::pair<search::Box, int>> boxes;
  for (int m = 0; m < master.facet_count(); ++m) boxes.emplace_back(search::facet_box(master, m, y), m);
  const search::Tree tree(boxes); // packed

  std::vector<std::pair<int, int>> pairs;
  for (int f = 0; f < slave.facet_count(); ++f) {
    search::Box box = search::facet_box(slave, f, x);
    int first = 0;
    for (auto it = tree.qbegin(index::nearest(box, 1)); it != tree.qend(); ++it) first = it->second;
    int last = first;
    const double reach = boost::geometry::distance(box, boxes[first].first);
    for (int a = 0; a < 2; ++a) {
      const int node = slave.facets[f][a];
      search::extend(box, {x[node].r + reach * n[node].r, x[node].z + reach * n[node].z});
    }
    search::inflate(box, margin);
    for (auto it = tree.qbegin(index::intersects(box)); it != tree.qend(); ++it) {
      first = std::min(first, it->second);
      last = std::max(last, it->second);
    }
    // y lies beyond the normal line of the slave's end (0 inner, 1 outer), seen in the direction of
    // increasing R
    const auto outside = [&](int end, const PlanePoint<double> &point, double slack) {
      const int node = slave.facets[f][end];
      const double ahead = -cross(point - x[node], n[node]);
      return end == 0 ? ahead <= -slack : ahead >= slack;
    };
    while (first > 0 && !outside(0, y[master.facets[first][0]], margin)) --first;
    while (last + 1 < master.facet_count() && !outside(1, y[master.facets[last][1]], margin)) ++last;
    for (int m = first; m <= last; ++m) pairs.emplace_back(f, m);
  }
  return pairs;
}

} // namespace tribogel
