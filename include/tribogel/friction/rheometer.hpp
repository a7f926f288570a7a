/// What rheologists read from a torque: closed forms that assume a planar contact of radius R, the sliding speed
/// omega r, and uniform pressure. Section 2 of the paper assumes more, a traction proportional to the speed;
/// section 3.3 a polynomial law. They are undefined, and then NaN, without normal force. A coefficient is |traction| /
/// pressure, so the torque's sign is ignored. Units mm, N, rad, s; torque N mm.
#pragma once

#include "tribogel/friction/polynomial.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace tribogel
{

/// Sum of the tractions c omega r over the disc, whatever their direction, eq. (2.1) [N]; c is the traction over the
/// sliding speed [MPa s/mm].
inline double viscous_friction_force(double c, double rate, double radius)
{
  return 2 * std::numbers::pi / 3 * c * std::abs(rate) * radius * radius * radius;
}

/// Their torque, eq. (2.2) [N mm].
inline double viscous_torque(double c, double rate, double radius)
{
  return std::numbers::pi / 2 * c * std::abs(rate) * radius * radius * radius * radius;
}

/// The friction force that goes with a torque according to (2.1) and (2.2), 4 T / (3 R) [N].
inline double gong_friction_force(double torque, double radius)
{
  return 4 * std::abs(torque) / (3 * radius);
}

/// Apparent coefficient of Gong et al., eq. (2.3): the friction force over N.
inline double gong_coefficient(double torque, double normal_force, double radius)
{
  if (!(normal_force > 0 && radius > 0)) return std::numeric_limits<double>::quiet_NaN();
  return gong_friction_force(torque, radius) / normal_force;
}

/// Area mean of mu(omega r) over the disc; the numerator of (3.13) times 2 / R^2.
template <class T> T mean_coefficient(const PolynomialFriction<T> &law, double radius, double rate)
{
  const double rim_speed = std::abs(rate) * radius;
  T sum = 0;
  for (std::size_t i = 0; i < law.exponents.size(); ++i)
    sum += law.coefficients[i] * (2 * std::pow(rim_speed, law.exponents[i]) / (law.exponents[i] + 2));
  return sum;
}

/// T / N of a law proportional to the pressure, for a uniform one [mm]; the denominator of (3.13) times 2 / R^2.
template <class T> T torque_over_force(const PolynomialFriction<T> &law, double radius, double rate)
{
  const double rim_speed = std::abs(rate) * radius;
  T sum = 0;
  for (std::size_t i = 0; i < law.exponents.size(); ++i)
    sum += law.coefficients[i] * (2 * radius * std::pow(rim_speed, law.exponents[i]) / (law.exponents[i] + 3));
  return sum;
}

/// Apparent coefficient for a polynomial law, eq. (3.13): the area mean of mu, scaled as the torque T is to the one
/// that the law gives, for a rotation at `rate` [rad/s]. (3.11) is its case of the exponents 0, 1, 2, corrected as
/// src/PAPER.md says. NaN also where the law gives no torque, and where tau is not proportional to p.
inline double apparent_coefficient(const PolynomialFriction<double> &law, double torque, double normal_force,
                                   double radius, double rate)
{
  const double per_force = torque_over_force(law, radius, rate);
  const bool defined = normal_force > 0 && radius > 0 && per_force != 0 && law.linear_in_pressure();
  if (!defined) return std::numeric_limits<double>::quiet_NaN();
  return mean_coefficient(law, radius, rate) / per_force * std::abs(torque) / normal_force;
}

} // namespace tribogel
