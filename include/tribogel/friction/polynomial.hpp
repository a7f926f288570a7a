/// Polynomial friction law, eqs. (3.10) and (3.12) of the paper, with Kagata's pressure exponent (its
/// section 3.3):
///
///     tau = mu(v) q(p),    mu = sum_i b_i v^(m_i),    q = p^a for p >= p_0,    0 <= a <= 1
///
/// m = 0 is the static strength, m >= 1 is smooth, and the slope of 0 < m < 1 at v = 0 is infinite. With a
/// term of the last kind all rising terms form the steep part, which is asked for its inverse: that is smooth
/// at rest. (Leaving the terms with m > 1 in the smooth part fails more often and takes three times the
/// iterations: contact/node/condition.hpp.)
///
/// For a < 1 the slope of p^a at p = 0 is infinite too. Below the floor p_0 a parabola takes its place,
///
///     q = p_0^a x (2 - a - (1 - a) x),    x = p / p_0,
///
/// which has the value 0 at p = 0, the value and the slope of p^a at p_0, and rises in between. Above p_0 the
/// law is exact, and q has no kink (a straight line below p_0 would make one, with a jump of the slope by the
/// factor a).
#pragma once

#include "tribogel/friction/law.hpp"
#include "tribogel/math/dual.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace tribogel
{

/// b_i [MPa^(1-a) (mm/s)^(-m_i)] and m_i >= 0 [1], of equal length; b_i >= 0 where 0 < m_i < 1. No terms:
/// frictionless. T is the type of the coefficients, Dual for sensitivities.
template <class T> struct PolynomialFriction {
  std::vector<T> coefficients;
  std::vector<double> exponents;
  double pressure_exponent = 1; ///< a
  double pressure_floor = 1e-5; ///< p_0 [MPa], of no effect with a = 1

  static bool steep(double exponent) { return exponent > 0 && exponent < 1; }

  /// S is the type of v and p; what comes out carries the derivatives of both (S with T = double, T with S =
  /// double).
  template <class S> using Result = decltype(std::declval<T>() * std::declval<S>());

  bool linear_in_pressure() const { return pressure_exponent == 1; }

  bool has_steep_part() const
  {
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (steep(exponents[i]) && value(coefficients[i]) > 0) return true;
    return false;
  }

  /// q(p) [MPa^a].
  template <class S> S load(const S &p) const
  {
    using std::pow;
    const double a = pressure_exponent;
    if (a == 1) return p;
    if (!(value(p) < pressure_floor)) return pow(p, a);
    const S x = p / pressure_floor;
    return std::pow(pressure_floor, a) * x * (2 - a - (1 - a) * x);
  }

  /// d q / d p.
  template <class S> S load_slope(const S &p) const
  {
    using std::pow;
    const double a = pressure_exponent;
    if (a == 1) return 1;
    if (!(value(p) < pressure_floor)) return a * pow(p, a - 1);
    return std::pow(pressure_floor, a - 1) * (2 - a - 2 * (1 - a) * (p / pressure_floor));
  }

  template <class S> StaticStrength<Result<S>> static_strength(const S &p) const
  {
    Result<S> mu = 0;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] == 0) mu += coefficients[i];
    return {mu * load(p), mu * load_slope(p)};
  }

  template <class S> SlidingStress<Result<S>> sliding(const S &v, const S &p) const
  {
    Result<S> secant = 0, slope = 0; // of the smooth part
    const bool has_steep = has_steep_part();
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] < 1 || (has_steep && rises(i))) continue;
      const Result<S> term = coefficients[i] * power_of_speed(v, exponents[i] - 1);
      secant += term;
      slope += exponents[i] * term;
    }
    const S q = load(p);
    return {secant * q, slope * q, secant * v * load_slope(p)};
  }

  template <class S> Result<S> steep_stress(const S &v, const S &p) const
  {
    Result<S> mu = 0;
    if (!has_steep_part()) return mu;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (rises(i)) mu += coefficients[i] * power_of_speed(v, exponents[i]);
    return mu * load(p);
  }

  /// Only for a law with a steep part. Solved in double; a step of Newton's method from there gives the
  /// derivatives, exactly.
  template <class S> Result<S> steep_speed(const S &stress, const S &drag, const S &p) const
  {
    const S q = load(p);
    const double v = solve_for_speed(value(stress), value(drag), value(q));
    if (v == 0) return 0;
    Result<S> residual = drag * v - stress;
    double slope = value(drag);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (!rises(i)) continue;
      const Result<S> term = coefficients[i] * q * std::pow(v, exponents[i]);
      residual += term;
      slope += exponents[i] * value(term) / v;
    }
    return v - residual / slope;
  }

  /// tau / p at v > 0, and its limit v -> 0+ at v = 0; likewise at p = 0. With a = 1 it does not depend on p.
  template <class S> Result<S> coefficient(const S &v, const S &p) const
  {
    Result<S> mu = 0;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      mu += coefficients[i] * power_of_speed(v, exponents[i]);
    if (linear_in_pressure()) return mu;
    return mu * (value(p) == 0 ? load_slope(S(0)) : S(load(p) / p));
  }

  template <class U> PolynomialFriction<U> cast() const
  {
    return {std::vector<U>(coefficients.begin(), coefficients.end()), exponents, pressure_exponent,
            pressure_floor};
  }

private:
  bool rises(std::size_t i) const { return exponents[i] > 0 && value(coefficients[i]) > 0; }

  /// v^e for e >= 0. The derivative of v^e at v = 0, infinite for e < 1, is left out: tau_1 is |v|^(m-1)
  /// times the velocity vector, whose derivative at v = 0 is |v|^(m-1) times the identity.
  template <class S> static S power_of_speed(const S &v, double e)
  {
    using std::pow;
    if (e == 0) return 1;
    if (e == 1) return v;
    return value(v) == 0 ? S(0) : S(pow(v, e));
  }

  /// The v >= 0 with q sum b_i v^(m_i) + drag v = stress, for stress, drag > 0; 0 where it underflows. In log
  /// v the logarithm of the left side is convex with slopes between the least m_i and 1, so Newton's method
  /// from the right of the solution converges without fail; the right is where one term alone would be the
  /// stress.
  double solve_for_speed(double stress, double drag, double q) const;
};

template <class T> double PolynomialFriction<T>::solve_for_speed(double stress, double drag, double q) const
{
  constexpr int most_iterations = 60;
  const auto log_factor = [&](std::size_t i) { // of term i over the stress
    return std::log(value(coefficients[i])) + std::log(q) - std::log(stress);
  };
  const double log_drag = std::log(drag) - std::log(stress);
  double x = -log_drag;
  for (std::size_t i = 0; i < exponents.size(); ++i)
    if (rises(i) && q > 0) x = std::min(x, -log_factor(i) / exponents[i]);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double sum = std::exp(log_drag + x), slope = sum;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (!rises(i) || !(q > 0)) continue;
      const double term = std::exp(log_factor(i) + exponents[i] * x);
      sum += term;
      slope += exponents[i] * term;
    }
    const double step = std::log(sum) * sum / slope;
    x -= step;
    if (!(step > 4 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x)))) break;
  }
  return std::exp(x);
}

} // namespace tribogel
