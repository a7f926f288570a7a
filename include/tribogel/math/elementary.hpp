/// Elementary functions written so that no digit is lost near zero and no case distinction is visible in the result.
/// T is double or Dual<N>.
#pragma once

#include "tribogel/math/dual.hpp"

#include <cmath>

namespace tribogel
{

/// 1 + x^2/3! + x^4/5! + ...: sinh(x)/x to round-off for |x| < 1/2.
template <class T> T sinhc_series(const T &x)
{
  const T y = x * x;
  T sum = 1;
  for (double factor : {1.0 / 210, 1.0 / 156, 1.0 / 110, 1.0 / 72, 1.0 / 42, 1.0 / 20, 1.0 / 6})
    sum = 1 + factor * y * sum;
  return sum;
}

/// sinh(x)/x, 1 at x = 0.
template <class T> T sinhc(const T &x)
{
  using std::sinh;
  return std::abs(value(x)) < 0.5 ? sinhc_series(x) : T(sinh(x) / x);
}

/// exp(x) - 1 - x, relative to round-off also where it is tiny.
template <class T> T exp_minus_tangent(const T &x)
{
  using std::exp;
  if (std::abs(value(x)) > 0.5) return exp(x) - 1 - x;
  T sum = 1;
  for (double factor : {1.0 / 15, 1.0 / 14, 1.0 / 13, 1.0 / 12, 1.0 / 11, 1.0 / 10, 1.0 / 9, 1.0 / 8, 1.0 / 7, 1.0 / 6,
                        1.0 / 5, 1.0 / 4, 1.0 / 3})
    sum = 1 + factor * x * sum;
  return x * x * sum * 0.5;
}

/// x coth(x), 1 at x = 0.
inline double x_coth(double x)
{
  return x == 0 ? 1 : x / std::tanh(x);
}

} // namespace tribogel
