/// Gap, sliding velocity, nodal forces and conditions of one slave node of the axisymmetric contact,
/// templated on the scalar.
///
/// With D = D_a, M_m = M_am and the node's own radius r = r_a as the one arm of both sides:
///
///     G       = D x - sum_m M_m y_m,   gap = -n . G / D
///     v_r     = d/dt r   - sum_m M_m d/dt r_m / D                       (likewise v_z, plus the plates'
///     travel rates) v_theta = r [Omega_s - Omega_m + (d/dt w - sum_m M_m d/dt w_m / D) / L] residual rows
///     (internal minus external force):  slave  -D (lambda_r, r lambda_theta / L, lambda_z)
///                                                     master +M_m (lambda_r, r lambda_theta / L, lambda_z)
///                                                     condition  D C
///
/// A multiplier that is extended to a crease acts on two slave nodes: D x stands for D_aa x_a + D_ac x_c,
/// likewise the rates and the forces, and D for D_aa + D_ac elsewhere.
///
/// Both frame velocities are taken at the slave's point, so a common rotation is exactly no sliding; sum_m
/// M_m = D, so the forces and the torque about the axis balance exactly.
#pragma once

#include "tribogel/contact/curve/mortar.hpp"
#include "tribogel/contact/node/condition.hpp"

namespace tribogel
{

/// Row a of the mortar matrix and what follows from it.
template <class T> struct NodeContact {
  std::vector<int> masters; ///< master nodes m
  std::vector<T> M;         ///< [mm^2]
  PlanePoint<T> x, n;       ///< position, normal out of the slave
  T gap = 0;                ///< [mm], >= 0 when open
  Vector3<T> velocity;      ///< slave minus master [mm/s]
  T area_ratio = 1;         ///< current over reference area, set for laws that are not linear in the pressure
  T spin = 0;               ///< relative angular velocity, velocity_theta / r [rad/s]
};

/// Sum a slave node's row over its facets.
template <class T>
void add_mortar_row(const LineChain &chain, int a, const std::vector<FacetMortar<T>> &facets,
                    NodeContact<T> &node)
{
  for (int k = 0; k < chain.neighbours[a].count; ++k) {
    const auto [f, local] = chain.neighbours[a].of[k];
    for (std::size_t j = 0; j < facets[f].masters.size(); ++j) {
      const std::size_t m = index_in(node.masters, facets[f].masters[j]);
      if (m == node.M.size()) node.M.push_back(T(0));
      node.M[m] += facets[f].M[j][local];
    }
  }
}

/// Gap and velocity; the row, x and n are given.
template <class T>
void add_kinematics(const CurveGeometry &geometry, int a, const ContactState<T> &state,
                    const std::vector<PlanePoint<T>> &y, NodeContact<T> &node)
{
  const auto &constants = geometry.nodes[a];
  const double D = constants.weight();
  PlanePoint<T> projected, own = node.x;
  node.velocity = state.slave.rate[a];
  if (constants.tied >= 0) {
    const double share = constants.tied_D / D;
    const PlanePoint<T> crease = position(geometry.slave, state.slave, constants.tied);
    own = {(1 - share) * node.x.r + share * crease.r, (1 - share) * node.x.z + share * crease.z};
    node.velocity = (1 - share) * state.slave.rate[a] + share * state.slave.rate[constants.tied];
  }
  Vector3<T> master_rate = Vector3<T>::Zero();
  for (std::size_t k = 0; k < node.masters.size(); ++k) {
    const int m = node.masters[k];
    projected += PlanePoint<T>{node.M[k] * y[m].r, node.M[k] * y[m].z};
    master_rate += node.M[k] * state.master.rate[m];
  }
  node.gap = dot(node.n, PlanePoint<T>{projected.r / D, projected.z / D} - own);
  node.velocity -= master_rate / T(D);
  node.velocity[2] += state.slave.travel_rate - state.master.travel_rate;
  node.spin =
      state.slave.rotation_rate - state.master.rotation_rate + node.velocity[1] / geometry.twist_length;
  node.velocity[1] = node.x.r * node.spin;
}

/// Force per D (slave: with a minus sign) or per M that a multiplier exerts in the rows of (u_R, w, u_Z).
template <class T> Vector3<T> conjugate_force(const Vector3<T> &multiplier, const T &r, double twist_length)
{
  return {multiplier[0], r * multiplier[1] / twist_length, multiplier[2]};
}

template <class T> struct NodeResidual {
  Vector3<T> slave; ///< rows of u at the slave node [N]
  Vector3<T> tied;  ///< rows of u at the crease node to which the multiplier is extended, else 0 [N]
  std::vector<Vector3<T>> master; ///< rows of u at its masters [N]
  Vector3<T> condition;           ///< rows of the multiplier, D C [N]
  ContactStatus status;
};

template <class T, class Law>
NodeResidual<T> node_residual(const CurveGeometry &geometry, int a, const NodeContact<T> &node,
                              const Vector3<T> &multiplier, double stick_rate, const Law &law)
{
  const auto &constants = geometry.nodes[a];
  const ContactPoint<T> point{
      multiplier, {node.n.r, T(0), node.n.z}, node.gap, node.velocity, node.area_ratio};
  const auto condition =
      contact_condition<T>(point, {constants.c_N, constants.c_N / stick_rate}, law, constants.on_axis);
  const Vector3<T> force = conjugate_force<T>(multiplier, node.x.r, geometry.twist_length);
  NodeResidual<T> residual{-T(constants.D) * force,
                           -T(constants.tied_D) * force,
                           {},
                           T(constants.weight()) * condition.residual,
                           condition.status};
  for (const T &M : node.M) residual.master.push_back(M * force);
  return residual;
}

} // namespace tribogel
