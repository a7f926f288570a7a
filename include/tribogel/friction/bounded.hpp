/// Coulomb's law with cohesion and a largest stress, tau <= min(mu p + c, tau_max); c and tau_max go to 0
/// with the pressure below its floor (pressure.hpp), so that nothing jumps where the gels part.
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/pressure.hpp"

namespace tribogel
{

template <class T> struct BoundedFriction : NumbersOf<T, 4> {
  template <class S> using Result = typename NumbersOf<T, 4>::template Result<S>;
  using NumbersOf<T, 4>::b; ///< mu, c, tau_max, floor

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "bounded",
        "tau <= min(mu p + c, tau_max)",
        "standard in finite-element programs",
        {{.name = "coefficient", .fallback = "", .unit = "-", .meaning = "mu"},
         {.name = "cohesion", .fallback = "0", .unit = "MPa", .meaning = "c"},
         {.name = "stress", .fallback = "", .unit = "MPa", .meaning = "tau_max", .lowest_excluded = true},
         pressure_floor_parameter("below it a parabola leads c to 0")},
        "bounded"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const
  {
    const S pressed = pressure_power(p, 0.0, value(b[3]));
    const Result<S> rising = b[0] * p + b[1] * pressed, bound = b[2] * pressed;
    return value(rising) < value(bound) ? rising : bound;
  }
  template <class S> Result<S> drag(const S &, const S &) const { return 0; }
  bool linear_in_pressure() const { return false; }
  bool may_fall() const { return false; }
};

} // namespace tribogel
