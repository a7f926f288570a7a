/// The part of a disc beyond another, against sums over rings of the arc that lies outside.
#include "tribogel/scene/overhang.hpp"

#include <gtest/gtest.h>

#include <array>

namespace tribogel
{
namespace
{

double by_rings(double r, double R, double d)
{
  constexpr int rings = 200000;
  double beyond = 0;
  for (int k = 0; k < rings; ++k) {
    const double s = r * (k + 0.5) / rings;
    // points at s and angle phi are beyond where s^2 + d^2 + 2 s d cos(phi) > R^2
    const double c = std::clamp((R * R - s * s - d * d) / (2 * s * d), -1.0, 1.0);
    beyond += 2 * s * std::acos(c) * r / rings;
  }
  return beyond / (std::numbers::pi * r * r);
}

TEST(Overhang, IsTheAreaBeyondTheOtherDisc)
{
  const std::array<double, 3> cases[] = {
      {10, 12.5, 5}, {10, 12.5, 3}, {10, 12.5, 14}, {12.5, 10, 5}, {1, 1, 0.3}};
  for (const auto &[r, R, d] : cases) EXPECT_NEAR(disc_overhang(r, R, d), by_rings(r, R, d), 1e-6);
  EXPECT_EQ(disc_overhang(10, 12.5, 2.5), 0);
  EXPECT_EQ(disc_overhang(10, 12.5, 0), 0);
  EXPECT_EQ(disc_overhang(10, 12.5, 22.5), 1);
  EXPECT_NEAR(disc_overhang(12.5, 10, 1), 1 - 0.64, 1e-15);
  EXPECT_EQ(disc_overhang(10, 12.5, -7), disc_overhang(10, 12.5, 7));
}

} // namespace
} // namespace tribogel
