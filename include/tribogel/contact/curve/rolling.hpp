/// Which part of a body's side wall may touch the other body.
///
/// The wall stands on the lower face at an edge, the crease, where the two make a right angle in the
/// undeformed body: it is a slave curve of its own, without a common normal at the edge. It starts at the
/// crease and its facets roll onto the master one after the other as the wall bulges. A facet that stands
/// upright has no sensible projection on the master, and one that is far from it no need of one: only the
/// first facets, as long as they lean over and are near, are tested for contact.
#pragma once

#include "tribogel/contact/curve/normals.hpp"
#include "tribogel/contact/curve/state.hpp"
#include "tribogel/contact/node/facing.hpp"

#include <algorithm>
#include <limits>

namespace tribogel
{

namespace rolling
{
/// Distance of a point from a segment.
inline double distance(const PlanePoint<double> &p, const PlanePoint<double> &a, const PlanePoint<double> &b)
{
  const PlanePoint<double> along = b - a, to = p - a;
  const double t = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0);
  return length(to - PlanePoint<double>{t * along.r, t * along.z});
}
} // namespace rolling

/// Number of wall facets, counted from the crease, that lean over the master and whose nearer end is within
/// their own length of it, measured along their normal. Curves as for CurveContact; the wall is
/// ordered from the crease upwards.
inline int rolling_facets(const LineChain &wall, const std::vector<PlanePoint<double>> &x,
                          const LineChain &master, const std::vector<PlanePoint<double>> &y)
{
  int count = 0;
  for (; count < wall.facet_count(); ++count) {
    const auto &facet = wall.facets[count];
    const PlanePoint<double> along = x[facet[1]] - x[facet[0]], n = normal_of(along);
    double nearest = std::numeric_limits<double>::infinity(), facing = 0;
    for (const auto &m : master.facets) {
      const PlanePoint<double> down =
          normal_of(y[m[1]] - y[m[0]]); // into the master: its curve runs outwards
      const double d = std::min(rolling::distance(x[facet[0]], y[m[0]], y[m[1]]),
                                rolling::distance(x[facet[1]], y[m[0]], y[m[1]]));
      if (d < nearest) nearest = d, facing = dot(n, down);
    }
    if (!(facing > least_facing) || nearest > facing * length(along)) break;
  }
  return count;
}

} // namespace tribogel
