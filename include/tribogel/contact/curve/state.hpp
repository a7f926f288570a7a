/// What the axisymmetric contact operator is told: two meridian curves, their nodal unknowns, the plates'
/// motions.
///
/// A node has the unknowns u = (u_R, w, u_Z) in mm, w = twist_length x twist, so that r = R + u_R, z = Z +
/// u_Z + travel and the twist is measured from the body's own plate. Vectors are in the frame (r, theta, z).
#pragma once

#include "tribogel/contact/curve/facet.hpp"
#include "tribogel/contact/node/state.hpp"

#include <vector>

namespace tribogel
{

/// Undeformed curve: facets ordered from the axis outwards, their nodes inner end, outer end, midside (order
/// 2).
struct SurfaceReference {
  std::vector<PlanePoint<double>> X;      ///< (R, Z) of each node [mm]
  std::vector<std::array<int, 3>> facets; ///< node numbers; the third is ignored in order 1
};

/// Current position of node a.
template <class T>
PlanePoint<T> position(const SurfaceReference &surface, const SurfaceState<T> &state, int a)
{
  return {surface.X[a].r + state.u[a][0], surface.X[a].z + state.u[a][2] + state.travel};
}

template <class T>
std::vector<PlanePoint<T>> positions(const SurfaceReference &surface, const SurfaceState<T> &state)
{
  std::vector<PlanePoint<T>> x;
  for (std::size_t a = 0; a < surface.X.size(); ++a)
    x.push_back(position(surface, state, static_cast<int>(a)));
  return x;
}

} // namespace tribogel
