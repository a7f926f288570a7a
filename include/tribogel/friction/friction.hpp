/// A friction law as a value, for whoever computes with it: a scene has one, contact asks it. It carries
/// derivatives through the law by the chain rule, so that laws themselves are written in doubles.
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/math/dual.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <utility>

namespace tribogel
{

/// What the contact condition asks of a law, for the scalar T: the three parts (law.hpp) and the inverse of
/// the steep one.
template <class Law, class T>
concept FrictionFor = requires(const Law &law, const T &v, const T &p)
{
  {
    law.threshold(p)
    } -> std::convertible_to<T>;
  {
    law.drag(v, p)
    } -> std::convertible_to<T>;
  {
    law.steep(v, p)
    } -> std::convertible_to<T>;
  {
    law.steep_speed(v, v, p)
    } -> std::convertible_to<T>;
  {
    law.has_steep_part()
    } -> std::convertible_to<bool>;
  {
    law.linear_in_pressure()
    } -> std::convertible_to<bool>;
};

class Friction
{
public:
  Friction() = default; ///< none
  explicit Friction(std::shared_ptr<const FrictionLaw> given) : one(std::move(given)) {}

  /// Of a formula (formula_law.hpp) and its parameters.
  template <template <class> class Formula>
  requires requires { Formula<double>::declaration(); }
  Friction(const Formula<double> &formula) : one(std::make_shared<FormulaLaw<Formula>>(formula)) {}

  /// Null: no friction.
  const FrictionLaw *law() const { return one.get(); }

  bool linear_in_pressure() const { return !one || one->linear_in_pressure(); }
  bool has_steep_part() const { return one && one->has_steep_part(); }
  bool has_memory() const { return one && one->has_memory(); }

  /// The same law as a place meets it that remembers `start`, within a solve.
  Friction remembering(double start, const StepWeights &weights) const
  {
    Friction there = *this;
    there.memory = {start, weights};
    return there;
  }

  /// What that place remembers after the solve, if it has slid at v.
  double memory_after(double v) const { return one->memory_after(v, memory); }

  // The parts of tau (law.hpp); p and v are double or Dual.

  template <class S> S threshold(const S &p) const
  {
    if (!one) return S(0);
    return lifted(one->threshold(value(p), memory), S(0), p);
  }

  template <class S> S drag(const S &v, const S &p) const
  {
    if (!one) return S(0);
    return lifted(one->drag(value(v), value(p), memory), v, p);
  }

  template <class S> S steep(const S &v, const S &p) const
  {
    if (!has_steep_part() || value(v) == 0) return S(0);
    return lifted(one->steep(value(v), value(p), memory), v, p);
  }

  /// Solved in double; a step of Newton's method from there gives the derivatives, exactly.
  template <class S> S steep_speed(const S &stress, const S &drag, const S &p) const
  {
    const double q = value(p);
    const double v = one->steep_speed(value(stress), value(drag), q, memory);
    if (v < std::numeric_limits<double>::min()) return S(0); // 1 / v would overflow
    const LawValue at = one->steep(v, q, memory);
    const S residual = at.value + at.d_p * (p - q) + drag * v - stress;
    return v - residual / (at.d_v + value(drag));
  }

  /// A bound of -d steep / d v (law.hpp).
  template <class S> S steepest_fall(const S &p) const
  {
    if (!has_memory()) return S(0);
    return lifted(one->steepest_fall(value(p), memory), S(0), p);
  }

  /// d tau / d v at v > 0 [MPa s/mm]; 0 where nothing is left of it but round-off.
  double slope(double v, double p) const
  {
    if (!one) return 0;
    const LawValue drag = one->drag(v, p, memory);
    const double sum = drag.value + v * drag.d_v + (has_steep_part() ? one->steep(v, p, memory).d_v : 0);
    const double round_off = 16 * std::numeric_limits<double>::epsilon() *
                             (std::abs(drag.value) + (v > 0 ? one->threshold(p, memory).value / v : 0));
    return std::abs(sum) > round_off ? sum : 0;
  }

  /// tau / p at v > 0, and its limit v -> 0+ at v = 0; likewise at p = 0.
  double coefficient(double v, double p) const
  {
    if (!one) return 0;
    const double pressure = linear_in_pressure() ? 1 : p;
    const LawValue at_rest = one->threshold(pressure, memory), drag = one->drag(v, pressure, memory);
    const LawValue steep = has_steep_part() && v > 0 ? one->steep(v, pressure, memory) : LawValue{};
    if (pressure == 0) return at_rest.d_p + steep.d_p + v * drag.d_p;
    return (at_rest.value + steep.value + v * drag.value) / pressure;
  }

private:
  template <class S> static S lifted(const LawValue &at, const S &v, const S &p)
  {
    if constexpr (std::is_same_v<S, double>)
      return at.value;
    else
      return at.value + at.d_v * (v - v.v) + at.d_p * (p - p.v);
  }

  std::shared_ptr<const FrictionLaw> one;
  LawMemory memory; ///< without `remembering`: of steady sliding
};

} // namespace tribogel
