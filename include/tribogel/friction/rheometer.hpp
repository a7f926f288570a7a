/// What rheologists read from a torque: closed forms that assume a planar contact of radius R and uniform pressure.
/// They are undefined, and then NaN, without normal force. A coefficient is |traction| / pressure, so the torque's sign
/// is ignored. Units mm, N, rad, s; torque N mm.
#pragma once

#include "tribogel/friction/polynomial.hpp"

#include <cmath>
#include <limits>

namespace tribogel
{

/// Apparent coefficient of Gong et al., eqs. (2.1) to (2.3): tau proportional to r gives F = 4 T / (3 R), mu = F / N.
inline double gong_coefficient(double torque, double normal_force, double radius)
{
  if (!(normal_force > 0 && radius > 0)) return std::numeric_limits<double>::quiet_NaN();
  return 4 * std::abs(torque) / (3 * radius * normal_force);
}

/// Apparent coefficient for a polynomial law, eq. (3.13): the area mean of mu that goes with the torque T, for a
/// rotation at `rate` [rad/s]. For exponents 0, 1, 2 it is eq. (3.11) once the factor R is put back into the first term
/// of its denominator (b0 R / 3, as the general formula gives; the paper prints b0 / 3). NaN also where the law gives
/// no torque, and where tau is not proportional to p.
inline double apparent_coefficient(const PolynomialFriction<double> &law, double torque, double normal_force,
                                   double radius, double rate)
{
  const double rim_speed = std::abs(rate) * radius;
  double force = 0, moment = 0; // of tau / (2 pi p), over R^2 and R^3
  for (std::size_t i = 0; i < law.exponents.size(); ++i) {
    const double m = law.exponents[i], mu = law.coefficients[i] * std::pow(rim_speed, m);
    force += mu / (m + 2);
    moment += mu / (m + 3);
  }
  const bool defined = normal_force > 0 && radius > 0 && moment != 0 && law.linear_in_pressure();
  if (!defined) return std::numeric_limits<double>::quiet_NaN();
  return force / (moment * radius) * std::abs(torque) / normal_force;
}

} // namespace tribogel
