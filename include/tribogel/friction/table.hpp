/// A measured curve mu(v), joined by monotone cubics (Boost's pchip: no overshoot between the points). It
/// begins at rest, or its first value is held down to there; beyond the last point it ends, or holds its last
/// value.
#pragma once

#include "tribogel/friction/formula_law.hpp"

#include <cmath>

namespace boost::math::interpolators
{
using std::isnan; // pchip.hpp of Boost 1.74 calls it without a namespace
}
#include <boost/math/interpolators/pchip.hpp>

#include <memory>

namespace tribogel
{

template <class T> struct TableFriction {
  template <class S> using Result = decltype(std::declval<T>() * std::declval<S>());

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "table",
        "mu(v) through points, by monotone cubics",
        "own measurements",
        {{.name = "speeds",
          .fallback = "",
          .unit = "mm/s",
          .meaning = "v of the points; -friction_table_file gives both lists at once",
          .is_list = true,
          .rule = "increasing, at least four; the first 0 unless the ends are held"},
         {.name = "coefficients",
          .fallback = "",
          .unit = "-",
          .meaning = "mu of the points",
          .is_list = true,
          .rule = "as many as speeds",
          .as_long_as = 0},
         {.name = "hold_ends",
          .fallback = "0",
          .unit = "-",
          .meaning =
              "1: beyond its ends the first and the last value are held; 0: a run that slides faster than the"
              " last point ends",
          .highest = 1,
          .rule = "0 or 1"}},
        "table",
        &objection};
    return all;
  }

  static LawObjection objection(const LawValues &values)
  {
    const std::vector<double> &v = values[0];
    if (v.size() < 4)
      return {0, "there are " + std::to_string(v.size()) + "; allowed: at least four, increasing"};
    for (std::size_t k = 1; k < v.size(); ++k)
      if (!(v[k] > v[k - 1]))
        return {0, six_digits(v[k]) + " follows " + six_digits(v[k - 1]) + "; allowed: increasing"};
    if (values[2][0] != 0 && values[2][0] != 1) return {2, "allowed: 0 or 1"};
    if (v[0] > 0 && values[2][0] == 0)
      return {
          0,
          "the first is above 0, and gels also rest; allowed: the first 0, or -friction_table_hold_ends 1"};
    return {};
  }

  void set(const LawValuesOf<T> &values)
  {
    speeds = values[0];
    coefficients = values[1];
    holds = value(values[2][0]) != 0;
    // The slopes at the ends are those that Boost takes, said in words since it knows a NaN of double only.
    const std::size_t last = speeds.size() - 1;
    const auto secant = [&](std::size_t k) {
      return T((coefficients[k + 1] - coefficients[k]) / (speeds[k + 1] - speeds[k]));
    };
    std::vector<T> x = speeds, y = coefficients;
    curve = std::make_shared<const Curve>(std::move(x), std::move(y), secant(0), secant(last - 1));
  }
  LawValuesOf<T> values() const { return {speeds, coefficients, {T(holds ? 1 : 0)}}; }

  template <class S> Result<S> threshold(const S &p) const { return coefficients.front() * p; }

  template <class S> Result<S> drag(const S &v, const S &p) const
  {
    const double x = value(v);
    if (x == 0 && value(speeds.front()) == 0) return curve->prime(speeds.front()) * p;
    if (x <= value(speeds.front())) return 0;
    return (coefficient(v) - coefficients.front()) * p / v;
  }

  bool linear_in_pressure() const { return true; }
  bool may_fall() const
  {
    for (std::size_t k = 1; k < coefficients.size(); ++k)
      if (value(coefficients[k]) < value(coefficients[k - 1])) return true;
    return false;
  }
  double highest_speed() const
  {
    return holds ? std::numeric_limits<double>::infinity() : value(speeds.back());
  }

private:
  using Curve = boost::math::interpolators::pchip<std::vector<T>>;

  /// At v above the first point.
  template <class S> Result<S> coefficient(const S &v) const
  {
    const T x = value(v);
    if (!(x < speeds.back())) return coefficients.back();
    const T mu = (*curve)(x);
    if constexpr (is_dual<S> && !is_dual<T>)
      return v.chain(mu, curve->prime(x));
    else
      return mu;
  }

  std::vector<T> speeds, coefficients;
  bool holds = false;
  std::shared_ptr<const Curve> curve;
};

} // namespace tribogel
