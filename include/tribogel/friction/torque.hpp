/// What rheologists read from a torque: closed forms that assume a planar contact, the sliding speed omega r,
/// and uniform pressure. Section 2 of the paper assumes more, a traction proportional to the speed;
/// section 3.3 a polynomial law. They are undefined, and then NaN, without normal force. A coefficient is
/// |traction| / pressure, so the torque's sign is ignored. Units mm, N, rad, s; torque N mm.
///
/// The paper's contact is a disc of radius R. Under the same assumptions tractions on a face of any shape
/// stand across the radius, so that its integrals over the disc become means of powers of r over the face:
/// with <f> the area mean, N = p A, T = A p <r mu(omega r)>, and the coefficient is <mu(omega r)>.
#pragma once

#include "tribogel/friction/friction.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace tribogel
{

/// The undeformed contact face of the gel that turns.
class ContactFace
{
public:
  /// A part of it: distance from the axis about which the face turns [mm], and area [mm^2].
  struct Part {
    double radius, area;
  };

  ContactFace(double radius) : R(radius) {} ///< a disc about the axis, in closed form
  explicit ContactFace(std::vector<Part> all) : parts(std::move(all)) {}

  /// Area mean of r^power [mm^power], power >= 0; that of a disc is 2 R^power / (power + 2).
  double mean_power(double power) const
  {
    if (parts.empty()) return 2 * std::pow(R, power) / (power + 2);
    double area = 0, sum = 0;
    for (const Part &part : parts) {
      area += part.area;
      sum += part.area * std::pow(part.radius, power);
    }
    return sum / area;
  }

  /// Area mean of f(r), by a rule for which powers of r below 1 are smooth enough (tanh-sinh).
  template <class F> double mean(const F &f) const
  {
    if (parts.empty()) {
      if (!(R > 0)) return f(0.0);
      constexpr double accuracy = 1e-12;
      thread_local boost::math::quadrature::tanh_sinh<double> rule;
      return 2 / (R * R) * rule.integrate([&](double r) { return f(r) * r; }, 0.0, R, accuracy);
    }
    double area = 0, sum = 0;
    for (const Part &part : parts) {
      area += part.area;
      sum += part.area * f(part.radius);
    }
    return sum / area;
  }

private:
  double R = 0;
  std::vector<Part> parts; ///< empty: a disc
};

/// Sum of the tractions c omega r over the disc, whatever their direction, eq. (2.1) [N]; c is the traction
/// over the sliding speed [MPa s/mm].
inline double viscous_friction_force(double c, double rate, double radius)
{
  return 2 * std::numbers::pi / 3 * c * std::abs(rate) * radius * radius * radius;
}

/// Their torque, eq. (2.2) [N mm].
inline double viscous_torque(double c, double rate, double radius)
{
  return std::numbers::pi / 2 * c * std::abs(rate) * radius * radius * radius * radius;
}

/// The friction force that goes with a torque when tractions grow as r: the ratio of their sum, as (2.1), to
/// their moment, as (2.2), over the face; 4 T / (3 R) on a disc [N].
inline double gong_friction_force(double torque, const ContactFace &face)
{
  return std::abs(torque) * face.mean_power(1) / face.mean_power(2);
}

/// Apparent coefficient of Gong et al., eq. (2.3): the friction force over N.
inline double gong_coefficient(double torque, double normal_force, const ContactFace &face)
{
  if (!(normal_force > 0 && face.mean_power(1) > 0)) return std::numeric_limits<double>::quiet_NaN();
  return gong_friction_force(torque, face) / normal_force;
}

/// Apparent coefficient for any law, eq. (3.13): the area mean of mu, scaled as the torque T is to the one
/// that the law gives under uniform pressure, T/N = <r mu(omega r)>, for a rotation at `rate` [rad/s]. The
/// paper has it for a polynomial law; (3.11) is its case of the exponents 0, 1, 2, corrected as src/PAPER.md
/// says. NaN also where the law gives no torque, and where tau is not proportional to p.
inline double apparent_coefficient(const Friction &law, double torque, double normal_force,
                                   const ContactFace &face, double rate)
{
  if (!(normal_force > 0 && law.linear_in_pressure())) return std::numeric_limits<double>::quiet_NaN();
  const auto mu = [&](double r) { return law.coefficient(std::abs(rate) * r, 1); };
  const double per_force = face.mean([&](double r) { return r * mu(r); }); // T / N [mm]
  if (!(std::abs(per_force) > 0)) return std::numeric_limits<double>::quiet_NaN();
  return face.mean(mu) / per_force * std::abs(torque) / normal_force;
}

} // namespace tribogel
