/// Stribeck's curve, mu = mu_k + (mu_s - mu_k) exp(-(v / v_s)^d) + k_v v, d >= 1.
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/smooth.hpp"

namespace tribogel
{

template <class T> struct StribeckFriction : NumbersOf<T, 5> {
  template <class S> using Result = typename NumbersOf<T, 5>::template Result<S>;
  using NumbersOf<T, 5>::b; ///< mu_s, mu_k, v_s, d, k_v

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "stribeck",
        "mu = mu_k + (mu_s - mu_k) exp(-(v / v_s)^d) + k_v v",
        "standard in tribology",
        {{.name = "static_coefficient", .fallback = "", .unit = "-", .meaning = "mu_s"},
         {.name = "kinetic_coefficient", .fallback = "", .unit = "-", .meaning = "mu_k"},
         {.name = "speed", .fallback = "", .unit = "mm/s", .meaning = "v_s", .lowest_excluded = true},
         {.name = "exponent", .fallback = "1", .unit = "-", .meaning = "d", .lowest = 1},
         {.name = "viscous_coefficient", .fallback = "0", .unit = "s/mm", .meaning = "k_v"}},
        "stribeck"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const { return b[0] * p; }

  /// With x = (v / v_s)^d: [exp(-x) - 1] / v = -(1 - exp(-x)) / x (v / v_s)^(d - 1) / v_s.
  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    using std::pow;
    if (value(v) == 0 && value(b[3]) > 1) return b[4] * p;
    const Result<S> u = v / b[2];
    const Result<S> per_speed = pow(u, Result<S>(b[3] - 1)) / b[2];
    return (b[4] + (b[1] - b[0]) * decay_over(Result<S>(pow(u, Result<S>(b[3])))) * per_speed) * p;
  }
  bool linear_in_pressure() const { return true; }
  bool may_fall() const { return value(b[1]) < value(b[0]); }
};

} // namespace tribogel
