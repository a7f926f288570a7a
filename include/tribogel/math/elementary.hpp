/// Elementary functions written so that no digit is lost near zero and no case distinction is visible in the
/// result. T is double, Dual<N> or Lanes.
#pragma once

#include "tribogel/math/dual.hpp"
#include "tribogel/math/lanes.hpp"

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
  using std::abs, std::sinh;
  return choose(
      abs(value(x)) < 0.5, [&]() -> T { return sinhc_series(x); }, [&]() -> T { return sinh(x) / x; });
}

/// exp(x) - 1 - x to round-off for |x| < 1/2.
template <class T> T exp_minus_tangent_series(const T &x)
{
  T sum = 1;
  for (double factor : {1.0 / 15, 1.0 / 14, 1.0 / 13, 1.0 / 12, 1.0 / 11, 1.0 / 10, 1.0 / 9, 1.0 / 8, 1.0 / 7,
                        1.0 / 6, 1.0 / 5, 1.0 / 4, 1.0 / 3})
    sum = 1 + factor * x * sum;
  return x * x * sum * 0.5;
}

/// exp(x) - 1 - x, relative to round-off also where it is tiny.
template <class T> T exp_minus_tangent(const T &x)
{
  using std::abs, std::exp;
  return choose(
      abs(value(x)) > 0.5, [&]() -> T { return exp(x) - 1 - x; },
      [&]() -> T { return exp_minus_tangent_series(x); });
}

/// exp(x) - 1.
inline Lanes expm1(const Lanes &x)
{
  return choose(
      abs(x) > 0.5, [&]() -> Lanes { return exp(x) - 1; },
      [&]() -> Lanes { return x + exp_minus_tangent_series(x); });
}

inline Lanes tanh(const Lanes &x)
{
  const Lanes e = expm1(-2 * abs(x)), t = -e / (2 + e);
  return where(x < 0, -t, t);
}

/// x coth(x), 1 at x = 0.
template <class T> T x_coth(const T &x)
{
  using std::tanh;
  return where(x == 0, T(1), T(x / tanh(x)));
}

} // namespace tribogel
