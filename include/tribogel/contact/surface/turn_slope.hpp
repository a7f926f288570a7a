/// How the rows of SurfaceContact change when the slave's plate turns (its last part).
///
/// In the slave's frame, which turns with its plate by d theta, the master turns back: with e = e_z,
///
///     d y / d theta = -e x y,    d R / d theta = -[e x] R,    d Omega_s / d theta = shift,
///
/// while x, lambda and the slave's normals stay. Moving the master's unknowns by d u_m = -R^T (e x y_m) gives
/// the same places y, so the Jacobian's columns give their part; with it come rates shift du_m, which turn
/// the master about the axis as seen at the projected point p = sum_m M_m y_m / D, where the spin is taken at
/// x. What is left of the velocity (surface/operator.hpp) and of the forces on the master is
///
///     d v = -shift e x (p - x) + e x sum_m M_m R du_m/dt / D + Omega_m (-Q_s^T c)
///     d (M_m R^T lambda) = M_m R^T (e x lambda)
#pragma once

#include "tribogel/contact/surface/jacobian.hpp"

namespace tribogel
{

template <class Add> void SurfaceContact::turn_slope(const Friction &law, const Add &add) const
{
  const auto turned_by = [](const Vector3<double> &a) { return Vector3<double>(-a[1], a[0], 0); }; // e x a
  jacobian(law, [&](const ContactBlock &block) {
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      if (block.columns[k].kind != ContactUnknown::master) continue;
      const Vector3<double> du = -placed.R.transpose() * turned_by(placed.y[block.columns[k].node]);
      for (std::size_t i = 0; i < block.rows.size(); ++i)
        add(block.rows[i], Vector3<double>(block.values.block<3, 3>(3 * static_cast<Eigen::Index>(i),
                                                                    3 * static_cast<Eigen::Index>(k)) *
                                           du));
    }
  });
  for (int a = first_node; a < last_node; ++a) {
    if (!geometry.nodes[a].carries) continue;
    const NodeContact contact = contact_of(a, !law.linear_in_pressure(), false);
    const double weight = geometry.nodes[a].weight();
    Vector3<double> master_rate = Vector3<double>::Zero();
    for (std::size_t k = 0; k < contact.masters.size(); ++k) {
      const int m = contact.masters[k];
      master_rate += contact.M[k] / weight * placed.R * now.master.rate[m];
      add({ContactUnknown::master, m},
          Vector3<double>(contact.M[k] * placed.R.transpose() * turned_by(now.multiplier[a])));
    }
    const Matrix3<double> by_velocity =
        condition_slope<11>(point_of(a, contact), scale_of(a), now.friction_at(a, law)).middleCols<3>(4);
    const Vector3<double> dv =
        turned_by(master_rate) - now.shift * turned_by(contact.arm) + now.master.rotation_rate * placed.shift;
    add({ContactUnknown::multiplier, a}, Vector3<double>(weight * by_velocity * dv));
  }
}

} // namespace tribogel
