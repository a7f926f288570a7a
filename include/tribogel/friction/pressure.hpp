/// How friction depends on the pressure when it is not proportional to it: Kagata's exponent (section 3.3 of
/// the paper),
///
///     q = p^a for p >= p_0,    0 <= a <= 1,
///
/// whose slope at p = 0 is infinite for a < 1. Below the floor p_0 a parabola takes its place,
///
///     q = p_0^a x (2 - a - (1 - a) x),    x = p / p_0,
///
/// which has the value 0 at p = 0, the value and the slope of p^a at p_0, and rises in between. Above p_0 the
/// law is exact, and q has no kink (a straight line below p_0 would make one, with a jump of the slope by the
/// factor a).
#pragma once

#include "tribogel/friction/law.hpp"
#include "tribogel/math/dual.hpp"

#include <cmath>

namespace tribogel
{

/// q(p) [MPa^a]; A, S are double or Dual.
template <class A, class S> auto pressure_power(const S &p, const A &a, double floor)
{
  using std::pow;
  using Result = decltype(a * p);
  if (value(a) == 1 && !is_dual<A>) return Result(p);
  if (!(value(p) < floor)) return Result(pow(Result(p), Result(a)));
  const Result x = Result(p / floor);
  return Result(pow(Result(floor), Result(a)) * x * (2 - a - (1 - a) * x));
}

/// d q / d p.
template <class S> S pressure_power_slope(const S &p, double a, double floor)
{
  using std::pow;
  if (a == 1) return 1;
  if (!(value(p) < floor)) return a * pow(p, a - 1);
  return std::pow(floor, a - 1) * (2 - a - 2 * (1 - a) * (p / floor));
}

/// v^e for e >= 0. The derivative of v^e at v = 0, infinite for e < 1, is left out: tau_1 is |v|^(m-1) times
/// the velocity vector, whose derivative at v = 0 is |v|^(m-1) times the identity.
template <class S> S power_of_speed(const S &v, double e)
{
  using std::pow;
  if (e == 0) return 1;
  if (e == 1) return v;
  return value(v) == 0 ? S(0) : S(pow(v, e));
}

/// Parameters of every law with such a dependence; `source` is that of the exponent's default, `meaning` what
/// happens below the floor.
inline LawParameter pressure_exponent_parameter(const char *source = "own")
{
  return {.name = "pressure_exponent",
          .fallback = "1",
          .unit = "-",
          .meaning = "a in |traction| = mu p^a, both per current area, p in MPa",
          .highest = 1,
          .source = source};
}
inline LawParameter pressure_floor_parameter(
    const char *meaning = "with a < 1: below it a parabola replaces p^a, whose slope at 0 is infinite")
{
  return {.name = "pressure_floor",
          .fallback = "1e-5",
          .unit = "MPa",
          .meaning = meaning,
          .lowest_excluded = true};
}

} // namespace tribogel
