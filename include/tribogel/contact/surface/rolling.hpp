/// Which facets of a body's side wall may touch the other body in space: curve/rolling.hpp says why not all.
#pragma once

#include "tribogel/contact/node/facing.hpp"
#include "tribogel/contact/surface/search.hpp"

#include <map>
#include <vector>

namespace tribogel
{

namespace quad_rolling
{
/// Nearly the facet's point that is nearest to p: exactly, if it is a parallelogram and p above it.
template <int order> Vector3<double> nearest_point(const QuadPoints<order> &facet, const Vector3<double> &p)
{
  const Vector2<double> l = QuadFrame<order>(facet)(p);
  return interpolate(quad_shape<order>({std::clamp(l[0], -1.0, 1.0), std::clamp(l[1], -1.0, 1.0)}).N, facet);
}

/// How many times as wide as the facet the part of the master is that the normals at its nodes meet, taken as
/// a plane through c with the normal m.
template <int order>
double width_met(const QuadPoints<order> &facet, const Vector3<double> &c, const Vector3<double> &m)
{
  constexpr double widest = 6;
  const QuadFrame<order> frame(facet);
  double width = 1;
  for (std::size_t a = 0; a < facet.size(); ++a) {
    const auto dN = tensor_shape<2, order>(quad_corner<order>(static_cast<int>(a))).dN;
    const Vector3<double> n = tangent(dN, facet, 0).cross(tangent(dN, facet, 1)).normalized();
    const Vector3<double> met = facet[a] + way_to_plane(facet[a], n, c, m) * n;
    for (int number = 0; number < 4; ++number) {
      const QuadSide<order> side(frame, facet, number);
      width = std::max(width, side.normal.dot(frame(met)) / side.normal.dot(frame(facet[side.outermost])));
    }
  }
  return std::min(width, widest);
}

/// Whether a wall's facet leans over the master and is within its own extent (the smaller one) of it,
/// measured along its normal, and the width of its neighbourhood.
template <int order>
std::pair<bool, double> may_touch(const QuadPoints<order> &facet, const QuadSurface &master,
                                  const std::vector<Vector3<double>> &y, const quad_search::Tree &tree)
{
  const QuadFrame<order> frame(facet);
  const Vector3<double> n = frame.A.col(0).cross(frame.A.col(1)).normalized();
  const double extent = 2 * std::min(frame.A.col(0).norm(), frame.A.col(1).norm());
  quad_search::Box box;
  boost::geometry::assign_inverse(box);
  for (const auto &x : facet) quad_search::extend(box, x);
  quad_search::inflate(box, extent);
  double nearest = std::numeric_limits<double>::infinity();
  Vector3<double> centre = Vector3<double>::Zero(), normal = centre;
  for (auto it = tree.qbegin(boost::geometry::index::intersects(box)); it != tree.qend(); ++it) {
    const auto other = master.on_facet<order>(it->second, y);
    const QuadFrame<order> at(other);
    for (const auto &x : facet) {
      const double distance = (x - nearest_point<order>(other, x)).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      centre = at.centre;
      normal = at.A.col(0).cross(at.A.col(1)).normalized();
    }
  }
  const double facing = -n.dot(normal);
  if (!(facing > least_facing) || nearest > facing * extent) return {false, 1};
  return {true, width_met<order>(facet, centre, normal)};
}
} // namespace quad_rolling

/// Those of the facets marked that are connected with the crease by sides that marked facets share.
/// `on_crease` marks nodes.
inline std::vector<bool> connected_to_crease(const QuadSurface &wall, const std::vector<bool> &on_crease,
                                             const std::vector<bool> &marked)
{
  std::vector<bool> connected(marked.size(), false);
  std::map<std::array<int, 2>, std::vector<int>> meeting; // marked facets at each side
  std::vector<int> front;
  for (int f = 0; f < wall.facet_count(); ++f) {
    if (!marked[f]) continue;
    for (int side = 0; side < 4; ++side) {
      const std::vector<int> edge = wall.nodes_along(side);
      meeting[wall.ends(f, side)].push_back(f);
      const bool at_crease =
          std::all_of(edge.begin(), edge.end(), [&](int b) { return on_crease[wall.facets[f][b]]; });
      if (!at_crease || connected[f]) continue;
      connected[f] = true;
      front.push_back(f);
    }
  }
  while (!front.empty()) {
    const int f = front.back();
    front.pop_back();
    for (int side = 0; side < 4; ++side)
      for (int other : meeting[wall.ends(f, side)])
        if (!connected[other]) {
          connected[other] = true;
          front.push_back(other);
        }
  }
  return connected;
}

/// Of each facet of a wall: whether it may touch, and how wide its neighbourhood is then (QuadPair).
struct RollingFacets {
  std::vector<bool> touch;
  std::vector<double> neighbourhood;
};

/// The facets that lean over the master, are near it and connected with the crease. Positions as
/// SurfaceContact places them.
inline RollingFacets rolling_facets(const QuadSurface &wall, const std::vector<Vector3<double>> &x,
                                    const std::vector<bool> &on_crease, const QuadSurface &master,
                                    const std::vector<Vector3<double>> &y)
{
  const quad_search::Tree tree = quad_search::tree_of(master, y);
  RollingFacets rolling;
  for (int f = 0; f < wall.facet_count(); ++f) {
    const auto [touches, width] = wall.order == 1
                                      ? quad_rolling::may_touch<1>(wall.on_facet<1>(f, x), master, y, tree)
                                      : quad_rolling::may_touch<2>(wall.on_facet<2>(f, x), master, y, tree);
    rolling.touch.push_back(touches);
    rolling.neighbourhood.push_back(width);
  }
  rolling.touch = connected_to_crease(wall, on_crease, rolling.touch);
  return rolling;
}

} // namespace tribogel
