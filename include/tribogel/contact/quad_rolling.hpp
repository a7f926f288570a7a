/// Which facets of a body's side wall may touch the other body in space: rolling.hpp says why not all.
#pragma once

#include "tribogel/contact/quad_search.hpp"
#include "tribogel/contact/rolling.hpp"

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

/// Whether wall facet f leans over the master and is within its own extent (the smaller one) of it, measured along its
/// normal.
template <int order>
bool may_touch(const QuadPoints<order> &facet, const QuadSurface &master, const std::vector<Vector3<double>> &y,
               const quad_search::Tree &tree)
{
  const QuadFrame<order> frame(facet);
  const Vector3<double> n = frame.A.col(0).cross(frame.A.col(1)).normalized();
  const double extent = 2 * std::min(frame.A.col(0).norm(), frame.A.col(1).norm());
  quad_search::Box box;
  boost::geometry::assign_inverse(box);
  for (const auto &x : facet) quad_search::extend(box, x);
  quad_search::inflate(box, extent);
  double nearest = std::numeric_limits<double>::infinity(), facing = 0;
  for (auto it = tree.qbegin(boost::geometry::index::intersects(box)); it != tree.qend(); ++it) {
    const auto other = master.on_facet<order>(it->second, y);
    const QuadFrame<order> at(other);
    for (const auto &x : facet) {
      const double distance = (x - nearest_point<order>(other, x)).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      facing = -n.dot(at.A.col(0).cross(at.A.col(1)).normalized());
    }
  }
  return facing > least_facing && nearest <= facing * extent;
}
} // namespace quad_rolling

/// Those of the facets marked that are connected with the crease by sides that marked facets share. `on_crease` marks
/// nodes.
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
      const bool at_crease = std::all_of(edge.begin(), edge.end(), [&](int b) { return on_crease[wall.facets[f][b]]; });
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

/// The facets that lean over the master, are near it and connected with the crease. Positions as SolidContact places
/// them.
inline std::vector<bool> rolling_facets(const QuadSurface &wall, const std::vector<Vector3<double>> &x,
                                        const std::vector<bool> &on_crease, const QuadSurface &master,
                                        const std::vector<Vector3<double>> &y)
{
  const quad_search::Tree tree = quad_search::tree_of(master, y);
  std::vector<bool> near(static_cast<std::size_t>(wall.facet_count()));
  for (int f = 0; f < wall.facet_count(); ++f)
    near[f] = wall.order == 1 ? quad_rolling::may_touch<1>(wall.on_facet<1>(f, x), master, y, tree)
                              : quad_rolling::may_touch<2>(wall.on_facet<2>(f, x), master, y, tree);
  return connected_to_crease(wall, on_crease, near);
}

} // namespace tribogel
