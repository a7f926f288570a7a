/// A power of the speed and of the pressure, tau = k q (v + v_0)^n with q = p^a (pressure.hpp).
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/pressure.hpp"
#include "tribogel/friction/smooth.hpp"

namespace tribogel
{

template <class T> struct PowerFriction : NumbersOf<T, 5> {
  template <class S> using Result = typename NumbersOf<T, 5>::template Result<S>;
  using NumbersOf<T, 5>::b; ///< k, n, v_0, a, floor

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "power",
        "tau = k p^a (v + v_0)^n",
        "Kagata et al. 2002, as the paper quotes it",
        {{.name = "coefficient", .fallback = "", .unit = "MPa^(1-a) (mm/s)^-n", .meaning = "k"},
         {.name = "exponent", .fallback = "", .unit = "-", .meaning = "n"},
         {.name = "offset",
          .fallback = "0",
          .unit = "mm/s",
          .meaning = "v_0; above 0 the slope at rest is finite, and k p^a v_0^n is what a stick holds"},
         pressure_exponent_parameter(),
         pressure_floor_parameter()},
        "power"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const
  {
    using std::pow;
    if (value(b[1]) != 0 && value(b[2]) == 0) return 0;
    return load(p) * T(value(b[2]) > 0 ? T(pow(b[2], b[1])) : T(1));
  }

  /// With v_0: v_0^n [(1 + v / v_0)^n - 1] / v.
  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    using std::pow;
    if (value(b[1]) == 0 || (value(b[2]) == 0 && value(b[1]) < 1)) return 0;
    if (value(b[2]) == 0) {
      if (value(v) == 0) return value(b[1]) == 1 ? load(p) : Result<S>(0);
      return load(p) * pow(Result<S>(v), Result<S>(b[1] - 1));
    }
    return load(p) * T(pow(b[2], T(b[1] - 1))) * power_over(Result<S>(v / b[2]), b[1]);
  }

  template <class S> Result<S> steep(const S &v, const S &p) const
  {
    using std::pow;
    return load(p) * pow(Result<S>(v), Result<S>(b[1]));
  }
  bool has_steep_part() const
  {
    return value(b[0]) > 0 && value(b[2]) == 0 && value(b[1]) > 0 && value(b[1]) < 1;
  }
  bool linear_in_pressure() const { return value(b[3]) == 1; }
  bool may_fall() const { return false; }

private:
  template <class S> Result<S> load(const S &p) const { return b[0] * pressure_power(p, b[3], value(b[4])); }
};

} // namespace tribogel
