/// Gauss-Legendre rules on [-1, 1]; a rule of n points is exact for polynomials of degree 2 n - 1.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace tribogel
{

template <int n> struct GaussRule {
  std::array<double, n> point, weight;
};

/// Nodes by Newton's method on the Legendre polynomial P_n from the Chebyshev estimate; full double
/// precision.
template <int n> GaussRule<n> gauss_rule()
{
  GaussRule<n> rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    if (2 * i + 1 == n) x = 0;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = x, before = 1; // P_1, P_0 of the three-term recurrence
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      if (2 * i + 1 != n) x -= p / slope;
    }
    rule.point[i] = x;
    rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

} // namespace tribogel
