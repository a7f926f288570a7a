/// Contact of one wall node with a rigid flat plate, without friction.
///
/// With a dual multiplier the weighted gap int psi_a g of a flat master is D_a times the node's own distance,
/// so the condition is the node's. Direction of gap and traction is the plate's normal: the wall's own is
/// perpendicular to it at the start. A node that is bonded to the plate has no multiplier (its pressure
/// belongs to the glue).
#pragma once

#include "tribogel/contact/node/condition.hpp"
#include "tribogel/friction/friction.hpp"

namespace tribogel
{

/// Rows of one wall node.
struct PlateNodeBlock {
  Vector3<double> force;      ///< rows of u, -D (lambda . n) n [N]
  Vector3<double> condition;  ///< D C, rows of the multiplier [N]
  Matrix3<double> d_force;    ///< of `force` with respect to the multiplier [mm^2]
  Matrix3<double> d_gap;      ///< of `condition` with respect to u [N/mm]
  Matrix3<double> d_traction; ///< of `condition` with respect to the multiplier [mm^2]
  ContactStatus status;
};

/// `normal` is the unit normal into the plate, `gap` the node's distance from it, negative inside [mm].
inline PlateNodeBlock plate_node(double gap, const Vector3<double> &normal, const Vector3<double> &multiplier,
                                 double D, double c_N)
{
  using Scalar = Dual<4>; // multiplier 0..2, gap
  ContactPoint<Scalar> point;
  point.normal = normal.cast<Scalar>();
  point.velocity = Vector3<Scalar>::Zero();
  for (int i = 0; i < 3; ++i) point.multiplier[i] = Scalar::seed(multiplier[i], i);
  point.gap = Scalar::seed(gap, 3);
  static const Friction frictionless;
  const auto C = contact_condition<Scalar>(point, {c_N, c_N}, frictionless); // c_T has no part without a law
  const Matrix3<double> onto = normal * normal.transpose();
  PlateNodeBlock block{-D * onto * multiplier, {}, -D * onto, {}, {}, C.status};
  for (int i = 0; i < 3; ++i) {
    block.condition[i] = D * C.residual[i].v;
    block.d_gap.row(i) = -D * C.residual[i].d[3] * normal.transpose();
    for (int j = 0; j < 3; ++j) block.d_traction(i, j) = D * C.residual[i].d[j];
  }
  return block;
}

} // namespace tribogel
