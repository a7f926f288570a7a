/// How much of the top gel's face may lie beyond the bottom gel's.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribogel
{

/// A face that hangs over the other's edge presses on that one's extension; that is a good picture of a rim
/// that only just overhangs, and of nothing else. Of its length or area.
inline constexpr double largest_overhang = 0.1;

/// The part of a disc's area that is not in another disc of `other` radius with the centre at `distance`;
/// radii > 0.
inline double disc_overhang(double radius, double other, double distance)
{
  const double d = std::abs(distance), r = radius, R = other;
  if (d + r <= R) return 0;
  if (d >= r + R) return 1;
  if (d + R <= r) return 1 - R * R / (r * r);
  const auto half_angle = [d](double near, double far) { // of the near disc's arc in the far one
    return std::acos(std::clamp((d * d + near * near - far * far) / (2 * d * near), -1.0, 1.0));
  };
  const double a = half_angle(r, R), b = half_angle(R, r);
  const double common = r * r * (a - std::sin(a) * std::cos(a)) + R * R * (b - std::sin(b) * std::cos(b));
  return 1 - common / (std::numbers::pi * r * r);
}

} // namespace tribogel
