/// Activated sliding, tau = k q asinh(v / (2 v_0)) with q = p^a (pressure.hpp): linear far below v_0,
/// logarithmic above.
#pragma once

#include "tribogel/friction/formula_law.hpp"
#include "tribogel/friction/pressure.hpp"
#include "tribogel/friction/smooth.hpp"

namespace tribogel
{

template <class T> struct AsinhFriction : NumbersOf<T, 4> {
  template <class S> using Result = typename NumbersOf<T, 4>::template Result<S>;
  using NumbersOf<T, 4>::b; ///< k, v_0, a, floor

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{
        "asinh",
        "tau = k p^a asinh(v / (2 v_0))",
        "activated processes (Eyring); of gels a stress that grows with log v is reported",
        {{.name = "coefficient", .fallback = "", .unit = "MPa^(1-a)", .meaning = "k"},
         {.name = "speed", .fallback = "", .unit = "mm/s", .meaning = "v_0", .lowest_excluded = true},
         pressure_exponent_parameter(),
         pressure_floor_parameter()},
        "asinh"};
    return all;
  }

  template <class S> Result<S> threshold(const S &) const { return 0; }
  template <class S> Result<S> drag(const S &, const S &) const { return 0; }

  /// Steep: its slope at rest is finite, but so much larger than that in sliding that only the inverse is
  /// tame.
  template <class S> Result<S> steep(const S &v, const S &p) const
  {
    const Result<S> x = v / (2 * b[1]);
    return b[0] * pressure_power(p, b[2], value(b[3])) * asinh_over(x) * x;
  }
  bool has_steep_part() const { return value(b[0]) > 0; }

  /// With v = 2 v_0 sinh y: k q y + 2 v_0 drag sinh y = stress, convex in y, so Newton's method comes from
  /// the right.
  double steep_speed(double stress, double drag, double p) const
  {
    constexpr int most_iterations = 200;
    const double scale = value(b[0]) * pressure_power(p, value(b[2]), value(b[3])), v_0 = value(b[1]);
    double y = std::asinh(stress / (2 * v_0 * drag));
    if (scale > 0) y = std::min(y, stress / scale);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const double excess = scale * y + 2 * v_0 * drag * std::sinh(y) - stress;
      const double step = excess / (scale + 2 * v_0 * drag * std::cosh(y));
      y -= step;
      if (!(step > 4 * std::numeric_limits<double>::epsilon() * y)) break;
    }
    return 2 * v_0 * std::sinh(std::max(y, 0.0));
  }
  bool linear_in_pressure() const { return value(b[2]) == 1; }
  bool may_fall() const { return false; }
};

} // namespace tribogel
