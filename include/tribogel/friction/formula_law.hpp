/// A law from its formula. Whoever adds a law writes the formula once, templated on its parameters' type T
/// and on that of v and p, S, and the slopes follow by dual numbers:
///
///     template <class T> struct SomeFriction : NumbersOf<T, 2> {
///       static const LawDeclaration &declaration();
///       template <class S> Result<S> threshold(const S &p) const;
///       template <class S> Result<S> drag(const S &v, const S &p) const;    // also at v = 0
///       bool linear_in_pressure() const;
///       bool may_fall() const;
///
///       // These two only if tau rises with an infinite slope at v = 0:
///       template <class S> Result<S> steep(const S &v, const S &p) const;
///       bool has_steep_part() const;
///     };
///
/// A steep part must be a sum of rising powers of v: the logarithm of such a sum is convex in log v, by which
/// its inverse is found without fail.
///
/// A law with memory has the parts as functions of (p, memory) and (v, p, memory), and
///
///       double initial_memory() const;
///       template <class S> Result<S> after(const S &v, double start, double duration) const; // at constant
///       v template <class S> Result<S> steepest_fall(const S &p, const LawMemory &memory) const; double
///       memory_rate(double v) const; bool holds_at_rest() const;
#pragma once

#include "tribogel/friction/law.hpp"
#include "tribogel/math/dual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace tribogel
{

template <class T> using LawValuesOf = std::vector<std::vector<T>>;

/// A formula whose parameters are `count` single numbers, `b` in the declaration's order.
template <class T, std::size_t count> struct NumbersOf {
  std::array<T, count> b{};

  template <class S> using Result = decltype(std::declval<T>() * std::declval<S>());

  void set(const LawValuesOf<T> &values)
  {
    for (std::size_t k = 0; k < count; ++k) b[k] = values[k].front();
  }
  LawValuesOf<T> values() const
  {
    LawValuesOf<T> all;
    for (const T &number : b) all.push_back({number});
    return all;
  }
};

inline std::string six_digits(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The v >= 0 with steep(v) + drag v = stress, for stress, drag > 0; 0 where it underflows. In x = log v
/// Newton's method comes from the right, where `drag` alone would be the stress, and never passes the
/// solution.
template <class Steep> double inverse_of_steep(const Steep &steep, double stress, double drag)
{
  constexpr int most_iterations = 200;
  const double log_stress = std::log(stress);
  double x = log_stress - std::log(drag);
  for (int iteration = 0; iteration < most_iterations && std::exp(x) > 0; ++iteration) {
    const double v = std::exp(x);
    const LawValue at = steep(v);
    const double sum = at.value + drag * v, slope = (at.d_v + drag) * v;
    const double step = (std::log(sum) - log_stress) * sum / slope;
    if (!std::isfinite(step)) break;
    x -= step;
    if (!(step > 4 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x)))) break;
  }
  return std::exp(x);
}

/// The same for any sum that rises with v. Newton's method in the same variables, halving the interval that
/// holds the solution where a step would leave it.
template <class Steep> double inverse_of_rising(const Steep &steep, double stress, double drag)
{
  constexpr int most_iterations = 400;
  const double log_stress = std::log(stress);
  double x = log_stress - std::log(drag), right = x, left = -std::numeric_limits<double>::infinity();
  double stride = 1;
  for (int iteration = 0; iteration < most_iterations && std::exp(x) > 0; ++iteration) {
    const double v = std::exp(x);
    const LawValue at = steep(v);
    const double sum = at.value + drag * v, slope = (at.d_v + drag) * v;
    const double step = (std::log(sum) - log_stress) * sum / slope;
    if (std::abs(step) <= 4 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x)))
      return std::exp(x - step);
    (sum > stress ? right : left) = x;
    x -= step;
    if (x > left && x < right) continue;
    x = std::isinf(left) ? right - stride : 0.5 * (left + right);
    stride *= 2;
    if (x == left || x == right) break;
  }
  return std::exp(x);
}

template <template <class> class Formula> class FormulaLaw final : public FrictionLaw
{
public:
  explicit FormulaLaw(Formula<double> given) : law(std::move(given)) {}

  const LawDeclaration &declaration() const override { return Formula<double>::declaration(); }
  LawValues values() const override { return law.values(); }

  LawValue threshold(double p, const LawMemory &memory) const override
  {
    return with_slopes(threshold_of(law, Slopes::seed(p, 1), memory));
  }
  LawValue drag(double v, double p, const LawMemory &memory) const override
  {
    return with_slopes(drag_of(law, Slopes::seed(v, 0), Slopes::seed(p, 1), memory));
  }
  LawValue steep(double v, double p, const LawMemory &memory) const override
  {
    if constexpr (is_steep)
      return with_slopes(steep_of(law, Slopes::seed(v, 0), Slopes::seed(p, 1), memory));
    else
      return {};
  }
  double steep_speed(double stress, double drag, double p, const LawMemory &memory) const override
  {
    const auto at = [&](double v) { return steep(v, p, memory); };
    if constexpr (requires { law.steep_speed(stress, drag, p); })
      return law.steep_speed(stress, drag, p);
    else if constexpr (remembers)
      return inverse_of_rising(at, stress, drag);
    else
      return inverse_of_steep(at, stress, drag);
  }
  bool has_steep_part() const override
  {
    if constexpr (is_steep)
      return law.has_steep_part();
    else
      return false;
  }
  bool linear_in_pressure() const override { return law.linear_in_pressure(); }
  bool may_fall() const override { return law.may_fall(); }
  bool holds_at_rest() const override
  {
    if constexpr (requires { law.holds_at_rest(); })
      return law.holds_at_rest();
    else
      return law.threshold(1.0) > 0;
  }

  bool has_memory() const override { return remembers; }
  double initial_memory() const override
  {
    if constexpr (remembers)
      return law.initial_memory();
    else
      return 0;
  }
  double memory_after(double v, const LawMemory &memory) const override
  {
    if constexpr (remembers)
      return law.after(v, memory.start, memory.weights.reach * memory.weights.step);
    else
      return 0;
  }
  LawValue steepest_fall(double p, const LawMemory &memory) const override
  {
    if constexpr (remembers)
      return with_slopes(law.steepest_fall(Slopes::seed(p, 1), memory));
    else
      return {};
  }
  double memory_rate(double v) const override
  {
    if constexpr (remembers)
      return law.memory_rate(v);
    else
      return std::numeric_limits<double>::infinity();
  }

  LawParameterSlope parameter_slope(std::size_t parameter, std::size_t entry, double v, double p,
                                    const LawMemory &memory) const override
  {
    using D = Dual<1>;
    LawValuesOf<D> seeded;
    for (const auto &list : law.values()) seeded.emplace_back(list.begin(), list.end());
    seeded[parameter][entry].d[0] = 1;
    Formula<D> varied;
    varied.set(seeded);
    LawParameterSlope slope{D(threshold_of(varied, p, memory)).d[0], 0,
                            D(drag_of(varied, v, p, memory)).d[0]};
    if constexpr (is_steep)
      if (law.has_steep_part() && v > 0) slope.steep = D(steep_of(varied, v, p, memory)).d[0];
    return slope;
  }

  /// The formula's own words, if it has some; else names and values.
  std::string in_numbers() const override
  {
    if constexpr (requires { law.in_numbers(); }) {
      return law.in_numbers();
    } else {
      const LawValues all = values();
      std::string text = declaration().formula, between = ": ";
      for (std::size_t k = 0; k < declaration().parameters.size(); ++k) {
        text += between + declaration().parameters[k].name;
        for (const double x : all[k]) text += " " + six_digits(x);
        between = ", ";
      }
      return text;
    }
  }

  double highest_speed() const override
  {
    if constexpr (requires { law.highest_speed(); })
      return law.highest_speed();
    else
      return std::numeric_limits<double>::infinity();
  }

private:
  using Slopes = Dual<2>;
  static constexpr bool is_steep = requires(const Formula<double> &f) { f.has_steep_part(); };
  static constexpr bool remembers = requires(const Formula<double> &f) { f.initial_memory(); };

  template <class F, class S> static auto threshold_of(const F &formula, const S &p, const LawMemory &memory)
  {
    if constexpr (remembers)
      return formula.threshold(p, memory);
    else
      return formula.threshold(p);
  }
  template <class F, class S>
  static auto drag_of(const F &formula, const S &v, const S &p, const LawMemory &memory)
  {
    if constexpr (remembers)
      return formula.drag(v, p, memory);
    else
      return formula.drag(v, p);
  }
  template <class F, class S>
  static auto steep_of(const F &formula, const S &v, const S &p, const LawMemory &memory)
  {
    if constexpr (remembers)
      return formula.steep(v, p, memory);
    else
      return formula.steep(v, p);
  }

  static LawValue with_slopes(const Slopes &x) { return {x.v, x.d[0], x.d[1]}; }

  Formula<double> law;
};

} // namespace tribogel
