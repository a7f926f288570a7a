/// Chains that adsorb and are torn off, and a viscous layer: tau = q_0 [tau_m 2 x / (1 + x^2) + c v], x = v /
/// v_f. The stress does not depend on the pressure, as long as there is one: q_0 is p^0 above the floor and
/// goes to 0 below it (pressure.hpp).
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/pressure.hpp"

namespace tribogel
{

template <class T> struct AdsorptionViscousFriction : NumbersOf<T, 4> {
  template <class S> using Result = typename NumbersOf<T, 4>::template Result<S>;
  using NumbersOf<T, 4>::b; ///< tau_m, v_f, c, floor

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "adsorption_viscous",
        "tau = tau_m 2 (v / v_f) / (1 + (v / v_f)^2) + c v, whatever the pressure",
        "own formula for the shape that Gong and co-workers report of adhesive gels",
        {{.name = "stress", .fallback = "", .unit = "MPa", .meaning = "tau_m, the largest by adsorption"},
         {.name = "speed",
          .fallback = "",
          .unit = "mm/s",
          .meaning = "v_f, at which adsorption resists most",
          .lowest_excluded = true},
         {.name = "viscosity",
          .fallback = "0",
          .unit = "MPa s/mm",
          .meaning = "c, of the layer over its height"},
         pressure_floor_parameter("below it a parabola leads tau to 0")},
        "adsorption_viscous"};
    return all;
  }

  template <class S> Result<S> threshold(const S &) const { return 0; }
  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    const Result<S> x = v / b[1];
    return pressure_power(p, 0.0, value(b[3])) * (2 * b[0] / b[1] / (1 + x * x) + b[2]);
  }
  bool linear_in_pressure() const { return false; }
  /// By adsorption tau falls at most by tau_m / (4 v_f) per speed, at v = 3^(1/2) v_f.
  bool may_fall() const { return value(b[0]) / (4 * value(b[1])) > value(b[2]); }
};

} // namespace tribogel
