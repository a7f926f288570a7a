/// Functions of friction formulas that must not lose digits, nor their slopes, as the speed goes to 0.
#pragma once

#include "tribogel/math/dual.hpp"

#include <cmath>
#include <numbers>

namespace tribogel
{

namespace smooth
{
/// f(x) with its slope, for double and Dual.
template <class S> S with_slope(const S &x, double f, double slope)
{
  if constexpr (is_dual<S>)
    return x.chain(f, slope);
  else
    return f;
}

/// Below it a series of ten terms is exact to round-off.
inline constexpr double small = 0.1;
} // namespace smooth

/// (1 - exp(-x)) / x, 1 at x = 0; x >= 0.
template <class S> S decay_over(const S &x)
{
  const double t = value(x);
  if (t > smooth::small) {
    const double f = -std::expm1(-t) / t;
    return smooth::with_slope(x, f, (std::exp(-t) - f) / t);
  }
  double f = 0, slope = 0, term = 1; // term = (-t)^k / (k + 1)!, its slope in t -(k) (-t)^(k-1) / (k + 1)!
  double power = 1, factorial = 1;   // (-t)^k, (k + 1)!
  for (int k = 0; k < 11; ++k) {
    term = power / factorial;
    f += term;
    slope += -(k + 1) * power / (factorial * (k + 2)); // of the term k + 1
    power *= -t;
    factorial *= k + 2;
  }
  return smooth::with_slope(x, f, slope);
}

/// asinh(x) / x, 1 at x = 0; x >= 0.
template <class S> S asinh_over(const S &x)
{
  const double t = value(x);
  if (t > smooth::small) {
    const double f = std::asinh(t) / t;
    return smooth::with_slope(x, f, (1 / std::sqrt(1 + t * t) - f) / t);
  }
  double f = 0, slope = 0, c = 1; // c = (-1)^k (2k)! / (4^k (k!)^2)
  double power = 1;               // t^(2k)
  for (int k = 0; k < 11; ++k) {
    f += c * power / (2 * k + 1);
    const double next = -c * (2 * k + 1) / (2 * k + 2);
    slope += (2 * k + 2) * next * power * t / (2 * k + 3); // of the term k + 1
    c = next;
    power *= t * t;
  }
  return smooth::with_slope(x, f, slope);
}

/// asinh(exp(x)), where exp(x) may overflow or underflow.
template <class S> S asinh_of_exp(const S &x)
{
  constexpr double far = 20; // beyond it exp(-2 far) is less than round-off
  const double t = value(x), e = std::exp(t < 0 ? t : -t);
  const double f = t > far ? t + std::numbers::ln2 : t < -far ? e : std::asinh(std::exp(t));
  return smooth::with_slope(x, f, (t < 0 ? e : 1) / std::sqrt(1 + e * e));
}

/// [(1 + x)^n - 1] / x, n at x = 0; x >= 0. X and N are double or Dual.
template <class X, class N> auto power_over(const X &x, const N &n)
{
  using std::expm1, std::log1p;
  using Result = decltype(n * x);
  constexpr double small = 0.02;
  if (value(x) > small) return Result(expm1(Result(n * log1p(x))) / x);
  Result sum = 0, term = n; // binomial coefficients times powers of x
  for (int k = 1; k < 11; ++k) {
    sum += term;
    term *= (n - k) / (k + 1.0) * x;
  }
  return sum;
}

} // namespace tribogel
