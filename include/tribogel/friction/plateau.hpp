/// A plateau at low speed and a power above it, mu = mu_0 [1 + (v / v*)^n].
#pragma once

#include "tribogel/friction/formula_law.hpp"

namespace tribogel
{

template <class T> struct PlateauFriction : NumbersOf<T, 3> {
  template <class S> using Result = typename NumbersOf<T, 3>::template Result<S>;
  using NumbersOf<T, 3>::b; ///< mu_0, v*, n

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "plateau",
        "mu = mu_0 [1 + (v / v*)^n]",
        "own formula for a shape that is reported of hydrogels that face each other",
        {{.name = "coefficient", .fallback = "", .unit = "-", .meaning = "mu_0"},
         {.name = "speed",
          .fallback = "",
          .unit = "mm/s",
          .meaning = "v*, where mu has doubled",
          .lowest_excluded = true},
         {.name = "exponent", .fallback = "0.5", .unit = "-", .meaning = "n", .lowest_excluded = true}},
        "plateau"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const { return b[0] * p; }

  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    using std::pow;
    if (value(b[2]) < 1) return 0;
    if (value(v) == 0) return value(b[2]) == 1 ? Result<S>(b[0] * p / b[1]) : Result<S>(0);
    return b[0] * p / b[1] * pow(Result<S>(v / b[1]), Result<S>(b[2] - 1));
  }

  template <class S> Result<S> steep(const S &v, const S &p) const
  {
    using std::pow;
    return b[0] * p * pow(Result<S>(v / b[1]), Result<S>(b[2]));
  }
  bool has_steep_part() const { return value(b[0]) > 0 && value(b[2]) < 1; }
  bool linear_in_pressure() const { return true; }
  bool may_fall() const { return false; }
};

} // namespace tribogel
