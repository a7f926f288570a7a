/// The numbers a rheometer user looks at, as functions of the state: axial force and torque from the plate's
/// reactions and from the contact tractions, the friction coefficients, the contact patch.
#pragma once

#include "time/problem.hpp"

#include <array>
#include <limits>

namespace tribogel
{

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

struct Measurement {
  double normal_force = 0; ///< reaction of the top plate, positive in compression [N]
  double torque = 0;       ///< of the top plate, positive when it opposes a rotation about +z [N mm]
  double contact_force = undefined, contact_torque = undefined; ///< the same from the contact tractions
  double contact_radius = undefined;                            ///< [mm]
  double mu_apparent = undefined, mu_gong = undefined;          ///< eqs. (3.13), (2.3)
  double mu_mean = undefined;                                   ///< over the patch's nodes, unweighted
  double mu_area_weighted = undefined, mu_pressure_weighted = undefined;
  /// Of the gel on the top plate, in space; the moment's about the point where the plate's face meets its
  /// axis.
  std::array<double, 2> transverse_force{}; ///< along x, y [N]
  std::array<double, 2> bending_moment{};   ///< about x, y [N mm]
  double friction_power = 0;                ///< that the sliding nodes turn into heat, >= 0 [N mm/s]

  double force_mismatch() const { return normal_force - contact_force; }
  double torque_mismatch() const { return torque - contact_torque; }
};

/// One node of a contact surface at a phase's end: r about the axis of its own plate, theta in space. On the
/// axis of a curve of order 2, whose node there takes no part in the contact, z and the pressure are those of
/// the parabola through the two nodes next to it (contact/curve/axis_value.hpp).
struct ProfileRow {
  const char *surface;                              ///< top or bottom
  double reference_r, reference_theta, reference_z; ///< [mm], [rad]
  double r, theta, z;                               ///< [mm], [rad]
  double pressure = undefined, traction_radial = undefined,
         traction_circumferential = undefined; ///< Cauchy [MPa]
  double sliding_velocity = undefined;         ///< [mm/s]
  double mu = undefined;
  const char *status = "";
  const char *part = ""; ///< of the surface: face, or the wall beside it that may roll onto the other gel
};

/// Collective. `profile` may be null.
PetscErrorCode Measure(const Problem &problem, Measurement &measurement, std::vector<ProfileRow> *profile);

} // namespace tribogel
