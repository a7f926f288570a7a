/// What the axisymmetric contact operator is told: two meridian curves, their nodal unknowns, the plates' motions.
///
/// A node has the unknowns u = (u_R, w, u_Z) in mm, w = twist_length x twist, so that r = R + u_R, z = Z + u_Z + travel
/// and the twist is measured from the body's own plate. Vectors are in the frame (r, theta, z).
#pragma once

#include "tribogel/contact/line_facet.hpp"
#include "tribogel/math/tensor.hpp"

#include <vector>

namespace tribogel
{

/// Undeformed curve: facets ordered from the axis outwards, their nodes inner end, outer end, midside (order 2).
struct SurfaceReference {
  std::vector<PlanePoint<double>> X;      ///< (R, Z) of each node [mm]
  std::vector<std::array<int, 3>> facets; ///< node numbers; the third is ignored in order 1
};

/// Of one body and its plate. T is double, or Dual in tests and sensitivities.
template <class T> struct SurfaceState {
  std::vector<Vector3<T>> u;    ///< unknowns of each node [mm]
  std::vector<Vector3<T>> rate; ///< their time derivatives [mm/s]
  double travel = 0;            ///< of the plate along z [mm]
  double travel_rate = 0;       ///< [mm/s]
  double rotation_rate = 0;     ///< of the plate about z [rad/s]; the angle itself is never needed
};

template <class T> struct ContactState {
  SurfaceState<T> slave, master;
  std::vector<Vector3<T>>
      multiplier;   ///< of each slave node: nominal traction on the slave [MPa]; 0 where none is carried
  double shift = 1; ///< d rate / d u of the time rule [1/s], for the Jacobian only
  /// Sets c_T = c_N / stick_rate [1/s], say 1/dt. It is part of the equation: the residual and the Jacobian of one step
  /// must be given the same value.
  double stick_rate = 1;
};

/// Current position of node a.
template <class T> PlanePoint<T> position(const SurfaceReference &surface, const SurfaceState<T> &state, int a)
{
  return {surface.X[a].r + state.u[a][0], surface.X[a].z + state.u[a][2] + state.travel};
}

template <class T> std::vector<PlanePoint<T>> positions(const SurfaceReference &surface, const SurfaceState<T> &state)
{
  std::vector<PlanePoint<T>> x;
  for (std::size_t a = 0; a < surface.X.size(); ++a) x.push_back(position(surface, state, static_cast<int>(a)));
  return x;
}

} // namespace tribogel
