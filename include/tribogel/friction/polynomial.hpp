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
/// pressure.hpp has q.
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/pressure.hpp"
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

  static bool is_steep(double exponent) { return exponent > 0 && exponent < 1; }

  /// S is the type of v and p; what comes out carries the derivatives of both (S with T = double, T with S =
  /// double).
  template <class S> using Result = decltype(std::declval<T>() * std::declval<S>());

  bool linear_in_pressure() const { return pressure_exponent == 1; }

  bool has_steep_part() const
  {
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (is_steep(exponents[i]) && value(coefficients[i]) > 0) return true;
    return false;
  }

  /// q(p) [MPa^a], and d q / d p.
  template <class S> S load(const S &p) const { return pressure_power(p, pressure_exponent, pressure_floor); }
  template <class S> S load_slope(const S &p) const
  {
    return pressure_power_slope(p, pressure_exponent, pressure_floor);
  }

  template <class S> Result<S> threshold(const S &p) const
  {
    Result<S> mu = 0;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] == 0) mu += coefficients[i];
    return mu * load(p);
  }

  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    Result<S> secant = 0;
    const bool has_steep = has_steep_part();
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] >= 1 && !(has_steep && rises(i)))
        secant += coefficients[i] * power_of_speed(v, exponents[i] - 1);
    return secant * load(p);
  }

  template <class S> Result<S> steep(const S &v, const S &p) const
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

  bool may_fall() const
  {
    return std::any_of(coefficients.begin(), coefficients.end(), [](const T &b) { return value(b) < 0; });
  }

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{"polynomial",
                                    "mu = sum_i b_i v^m_i with the sliding speed v in mm/s",
                                    "paper",
                                    {{.name = "coefficients",
                                      .fallback = "0,8e-4",
                                      .unit = "MPa^(1-a) (mm/s)^-m_i",
                                      .meaning = "b_i; a negative one (weakening) is taken with a note",
                                      .lowest = -std::numeric_limits<double>::infinity(),
                                      .is_list = true,
                                      .rule = ">= 0 where 0 < m_i < 1",
                                      .source = "paper"},
                                     {.name = "exponents",
                                      .fallback = "0,1",
                                      .unit = "-",
                                      .meaning = "m_i",
                                      .is_list = true,
                                      .rule = "as many as coefficients",
                                      .as_long_as = 0,
                                      .source = "paper"},
                                     pressure_exponent_parameter("paper"),
                                     pressure_floor_parameter()},
                                    "",
                                    &objection};
    return all;
  }

  static LawObjection objection(const LawValues &values)
  {
    double at_rest = 0;
    for (std::size_t i = 0; i < values[1].size(); ++i) {
      const double b = values[0][i], m = values[1][i];
      if (is_steep(m) && b < 0)
        return {0, six_digits(b) + " with exponent " + six_digits(m) +
                       "; allowed: >= 0 with an exponent between 0 and 1"};
      if (m == 0) at_rest += b;
    }
    if (at_rest < 0)
      return {0, "the coefficient at rest is " + six_digits(at_rest) +
                     "; allowed: the terms with exponent 0 add up to >= 0"};
    return {};
  }

  std::string in_numbers() const
  {
    std::string text = "mu =";
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
      const double b = value(coefficients[i]), m = exponents[i];
      text += (i ? (b < 0 ? " - " : " + ") : (b < 0 ? " -" : " ")) + six_digits(std::abs(b));
      if (m != 0) text += " v" + (m == 1 ? std::string() : "^" + six_digits(m));
    }
    text += " (v in mm/s)";
    if (linear_in_pressure()) return text;
    return text + ", |traction| = mu p^" + six_digits(pressure_exponent) + " (p in MPa, above " +
           six_digits(pressure_floor) + ")";
  }

  void set(const LawValuesOf<T> &values)
  {
    *this = {values[0], {}, value(values[2][0]), value(values[3][0])};
    for (const T &m : values[1]) exponents.push_back(value(m));
  }
  LawValuesOf<T> values() const
  {
    return {coefficients, {exponents.begin(), exponents.end()}, {T(pressure_exponent)}, {T(pressure_floor)}};
  }

  template <class U> PolynomialFriction<U> cast() const
  {
    return {std::vector<U>(coefficients.begin(), coefficients.end()), exponents, pressure_exponent,
            pressure_floor};
  }

private:
  bool rises(std::size_t i) const { return exponents[i] > 0 && value(coefficients[i]) > 0; }

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
