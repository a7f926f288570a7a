/// Polynomial friction law, eqs. (3.10) and (3.12) of the paper: tau = mu(v) p with mu = sum_i b_i v^(m_i).
#pragma once

#include "tribogel/friction/law.hpp"
#include "tribogel/math/dual.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tribogel
{

/// b_i [(mm/s)^(-m_i)] and m_i [1], of equal length. An exponent is 0 (Coulomb) or at least 1: between them mu'(0) is
/// infinite, and tau_1 / v with it. No terms: frictionless. T is the type of the coefficients, Dual for sensitivities.
template <class T> struct PolynomialFriction {
  std::vector<T> coefficients;
  std::vector<double> exponents;

  static bool admissible(double exponent) { return exponent == 0 || exponent >= 1; }

  /// S is the type of v and p; what comes out carries the derivatives of both (S with T = double, T with S = double).
  template <class S> using Result = decltype(std::declval<T>() * std::declval<S>());

  template <class S> StaticStrength<Result<S>> static_strength(const S &p) const
  {
    Result<S> mu = 0;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] == 0) mu += coefficients[i];
    return {mu * p, mu};
  }

  template <class S> SlidingStress<Result<S>> sliding(const S &v, const S &p) const
  {
    Result<S> secant = 0, slope = 0; // (mu - mu(0)) / v and d mu / d v
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      const Result<S> term = coefficients[i] * power_of_speed(v, exponents[i] - 1);
      secant += term;
      slope += exponents[i] * term;
    }
    return {secant * p, slope * p, secant * v};
  }

  /// tau / p at v > 0, and its limit v -> 0+ at v = 0. It does not depend on p.
  template <class S> Result<S> coefficient(const S &v, const S &) const
  {
    const S one = 1;
    return static_strength(one).value + sliding(v, one).over_v * v;
  }

  template <class U> PolynomialFriction<U> cast() const
  {
    return {std::vector<U>(coefficients.begin(), coefficients.end()), exponents};
  }

private:
  /// v^e for e >= 0. The derivative of v^e at v = 0, infinite for e < 1, is left out: tau_1 is |v|^(m-1) times the
  /// velocity vector, whose derivative at v = 0 is |v|^(m-1) times the identity.
  template <class S> static S power_of_speed(const S &v, double e)
  {
    using std::pow;
    if (e == 0) return 1;
    if (e == 1) return v;
    return value(v) == 0 ? S(0) : S(pow(v, e));
  }
};

} // namespace tribogel
