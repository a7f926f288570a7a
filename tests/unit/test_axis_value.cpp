/// Pressure and height on the axis of a curve of order 2, from the two nodes next to it: right for parabolas,
/// on uniform, graded and curved facets, and of fourth order in the facets' length for what is none.
#include "tribogel/contact/curve/axis_value.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace tribogel
{

namespace
{

using Curve = std::vector<PlanePoint<double>>;

/// Nodes of the facets between these radii, midside nodes at `middle` of each, on z(r).
Curve curve(const std::vector<double> &ends, double middle, const std::function<double(double)> &z)
{
  Curve x{{ends[0], z(ends[0])}};
  for (std::size_t k = 1; k < ends.size(); ++k)
    for (const double r : {ends[k - 1] + middle * (ends[k] - ends[k - 1]), ends[k]}) x.push_back({r, z(r)});
  return x;
}

/// What a contact's node a reports of p(r): its share of the force over its share of the area, by the
/// midpoint rule.
double nodal_mean(const Curve &x, std::size_t a, const std::function<double(double)> &p)
{
  constexpr int points = 20000;
  double force = 0, area = 0;
  for (std::size_t first = a < 2 || a % 2 ? a - a % 2 : a - 2; first + 2 < x.size() && first <= a; first += 2)
    for (int q = 0; q < points; ++q) {
      const double s = (q + 0.5) / points, N[] = {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)},
                   dN[] = {4 * s - 3, 4 - 8 * s, 4 * s - 1};
      double r = 0, dr = 0, dz = 0;
      for (std::size_t b = 0; b < 3; ++b)
        r += N[b] * x[first + b].r, dr += dN[b] * x[first + b].r, dz += dN[b] * x[first + b].z;
      const double share = N[a - first] * r * std::hypot(dr, dz);
      force += share * p(r);
      area += share;
    }
  return force / area;
}

double on_axis(const Curve &x, const std::function<double(double)> &p)
{
  return pressure_on_axis(x, {nodal_mean(x, 1, p), nodal_mean(x, 2, p)});
}

} // namespace

TEST(axis_value, OfAParabolaIsExact)
{
  const auto flat = [](double) { return 0.3; };
  const auto bowl = [](double r) { return -0.4 + 0.03 * r * r; };
  const auto uniform = [](double) { return 1.7; };
  const auto parabola = [](double r) { return 1.7 * (1 - 0.08 * r * r); };
  for (const Curve &x :
       {curve({0, 1}, 0.5, flat), curve({0, 1, 2, 3}, 0.5, flat), curve({0, 1.3, 2.1, 2.5}, 0.5, flat),
        curve({0, 1, 2}, 0.47, bowl), curve({0, 1.3, 1.6}, 0.52, bowl)}) {
    EXPECT_NEAR(height_on_axis(x), x.front().z, 1e-14);
    EXPECT_NEAR(on_axis(x, uniform), 1.7, 1e-12);
    EXPECT_NEAR(on_axis(x, parabola), 1.7, 1e-7); // the means are those of the midpoint rule
  }
}

/// The nodes' own places in the place of their means' would be 0.3 c h^2 off.
TEST(axis_value, OfAnEvenFunctionIsOfFourthOrder)
{
  const auto hertz = [](double r) { return std::sqrt(1 - r * r / 25); };
  const auto dome = [](double r) { return -std::cosh(0.3 * r); };
  double before[2] = {};
  for (const double h : {0.8, 0.4, 0.2}) {
    const Curve x = curve({0, h, 2 * h}, 0.5, dome);
    const double error[] = {on_axis(x, hertz) - 1, height_on_axis(x) + 1};
    for (int k = 0; k < 2; ++k) {
      if (before[k] != 0) {
        EXPECT_NEAR(before[k] / error[k], 16, 1.5);
      }
      before[k] = error[k];
    }
  }
  EXPECT_NEAR(before[0], 0, 2e-5);
}

TEST(axis_value, DoesNotPull)
{
  const Curve x = curve({0, 1, 2}, 0.5, [](double) { return 0.0; });
  EXPECT_EQ(pressure_on_axis(x, {0.0, 0.0}), 0);
  EXPECT_EQ(pressure_on_axis(x, {0.0, 0.1}), 0);
}

} // namespace tribogel
