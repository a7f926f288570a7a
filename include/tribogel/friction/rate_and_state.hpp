/// Rate-and-state friction: contacts strengthen while they last, and sliding renews them over the length L,
///
///     tau = p a asinh[ v / (2 v_0) exp((mu_0 + b ln(v_0 theta / L)) / a) ],    d theta / dt = 1 - v theta /
///     L
///
/// The ageing law's theta [s] is the contacts' mean age: at rest it is their time, in steady sliding it is L
/// / v and
///
///     mu = mu_0 + (a - b) ln(v / v_0)    as long as exp(mu / a) >> 1.
///
/// A jump of v first changes mu by a ln of the ratio, then by -b ln of it while the gels slide by a few L.
/// The asinh (Rice and Ben-Zion 1996) takes the place of the logarithm, which has no value at rest; dividing
/// it by v > 0 leaves the same law to exp(-2 mu / a).
///
/// Within a solve v is one. At constant v the ageing law is linear, and over the time h
///
///     theta = theta_n exp(-v h / L) + h (1 - exp(-v h / L)) / (v h / L)
///
/// exactly, at rest (theta_n + h) as in steady sliding (L / v).
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/smooth.hpp"

#include <cmath>

namespace tribogel
{

template <class T> struct RateAndStateFriction : NumbersOf<T, 6> {
  template <class S> using Result = typename NumbersOf<T, 6>::template Result<S>;
  using NumbersOf<T, 6>::b; ///< mu_0, a, b, L, v_0, theta_0

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "rate_and_state",
        "mu = a asinh[v / (2 v_0) exp((mu_0 + b ln(v_0 theta / L)) / a)], d theta / dt = 1 - v theta / L",
        "Dieterich's ageing law, in the form that also holds at rest",
        {{.name = "coefficient", .fallback = "", .unit = "-", .meaning = "mu_0, of steady sliding at v_0"},
         {.name = "direct_effect",
          .fallback = "",
          .unit = "-",
          .meaning = "a: mu rises at once by a ln(ratio) when v jumps",
          .lowest_excluded = true},
         {.name = "evolution_effect",
          .fallback = "",
          .unit = "-",
          .meaning = "b: mu then falls by b ln(ratio); rises by it with the time of rest; b > a weakens"},
         {.name = "length",
          .fallback = "",
          .unit = "mm",
          .meaning = "L, by which the gels slide until their contacts are others",
          .lowest_excluded = true},
         {.name = "speed", .fallback = "", .unit = "mm/s", .meaning = "v_0", .lowest_excluded = true},
         {.name = "initial_age",
          .fallback = "",
          .unit = "s",
          .meaning = "theta of a contact that has just been made, L / v_0 if nothing is known",
          .lowest_excluded = true}},
        "rate_and_state"};
    return all;
  }

  template <class S> Result<S> threshold(const S &, const LawMemory &) const { return 0; }
  template <class S> Result<S> drag(const S &, const S &, const LawMemory &) const { return 0; }

  template <class S> Result<S> steep(const S &v, const S &p, const LawMemory &memory) const
  {
    using std::log;
    const Result<S> speed = log(Result<S>(v / b[4]));
    const Result<S> age =
        std::isinf(memory.weights.step)
            ? Result<S>(-speed)
            : Result<S>(log(Result<S>(after(v, memory.start, memory.weights.step) * (b[4] / b[3]))));
    return b[1] * asinh_of_exp(Result<S>(speed - std::numbers::ln2 + (b[0] + b[2] * age) / b[1])) * p;
  }
  bool has_steep_part() const { return true; }

  double initial_memory() const { return value(b[5]); }

  template <class S> Result<S> after(const S &v, double start, double duration) const
  {
    using std::exp;
    if (std::isinf(duration)) return b[3] / v;
    const Result<S> slips = v * duration / b[3];
    return start * exp(Result<S>(-slips)) + duration * decay_over(slips);
  }

  /// ln theta falls at most by h / L per speed, as where theta_n is old and the solve short.
  template <class S> Result<S> steepest_fall(const S &p, const LawMemory &memory) const
  {
    if (std::isinf(memory.weights.step)) return 0;
    return p * b[2] * memory.weights.step / b[3];
  }

  double memory_rate(double v) const { return v / value(b[3]); }

  bool linear_in_pressure() const { return true; }
  bool may_fall() const { return value(b[2]) > value(b[1]); }
  bool holds_at_rest() const { return value(b[2]) >= value(b[1]); }
};

} // namespace tribogel
