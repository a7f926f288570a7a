/// From static to kinetic friction, mu = mu_k + (mu_s - mu_k) exp(-v / v_d).
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/smooth.hpp"

namespace tribogel
{

template <class T> struct ExponentialDecayFriction : NumbersOf<T, 3> {
  template <class S> using Result = typename NumbersOf<T, 3>::template Result<S>;
  using NumbersOf<T, 3>::b; ///< mu_s, mu_k, v_d

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "exponential_decay",
        "mu = mu_k + (mu_s - mu_k) exp(-v / v_d)",
        "standard in finite-element programs",
        {{.name = "static_coefficient", .fallback = "", .unit = "-", .meaning = "mu_s"},
         {.name = "kinetic_coefficient", .fallback = "", .unit = "-", .meaning = "mu_k"},
         {.name = "speed", .fallback = "", .unit = "mm/s", .meaning = "v_d", .lowest_excluded = true}},
        "exponential_decay"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const { return b[0] * p; }
  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    return (b[1] - b[0]) / b[2] * p * decay_over(Result<S>(v / b[2]));
  }
  bool linear_in_pressure() const { return true; }
  bool may_fall() const { return value(b[1]) < value(b[0]); }
};

} // namespace tribogel
