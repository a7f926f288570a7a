/// How far off a value on a mesh (or with a step) is, judged by the same value on coarser ones: the fit
/// value(h) = v + C h^p, exact for three sizes of any ratio, least squares in v, C and p for more, and from
/// it an error with a factor of safety, after P. J. Roache, J. Fluids Eng. 116 (1994) 405-413 and L. Eca, M.
/// Hoekstra, J. Comput. Phys. 262 (2014) 104-130. What meshes of whole numbers of edges are not alike in
/// scatters about the fit, and the scatter is part of the error. An observed order outside 0.5 to 2 is
/// replaced by the nearer end: stress is singular at rims, and higher orders are chance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tribogel
{

/// How a series behaves, and with it how it is judged. "Distance" is that of the finest value from the fit's
/// limit.
enum class Convergence {
  confirmed,  ///< order from 0.5 to 2: 1.25 distance + scatter
  fast,       ///< order above 2, taken for 2: as confirmed; of three levels 3 spread
  slow,       ///< order below 0.5, taken for 0.5: likewise, or 3 distance if that is larger
  oscillates, ///< three levels, not monotone: 3 spread
  few_levels, ///< two levels, no order: 3 times their difference; order known: 3 distance
  settled,    ///< no change but round-off: 3 spread
  unknown     ///< nothing to compare with
};
inline constexpr const char *convergence_names[] = {"confirmed",  "fast",    "slow",   "oscillates",
                                                    "few levels", "settled", "unknown"};

struct Extrapolation {
  Convergence verdict = Convergence::unknown;
  double limit = std::numeric_limits<double>::quiet_NaN(); ///< the finest value where nothing is extrapolated
  double error =
      std::numeric_limits<double>::quiet_NaN(); ///< of the finest value, with its factor of safety, >= 0
  double order = std::numeric_limits<double>::quiet_NaN(); ///< observed, or known; NaN without one
};

/// A value at a size: edges, steps, or any measure of them; only ratios of sizes count.
struct Level {
  double size, value;
};

namespace extrapolation
{

inline constexpr double lowest_order = 0.5, highest_order = 2;
inline constexpr double confirmed_factor = 1.25, doubtful_factor = 3;
inline constexpr double round_off = 1e-9,
                        zero = 1e-10; ///< of the value; of the scale of values that may be 0

struct Fit {
  double limit, finest, squares; ///< v; the fit at the finest size; sum of squared residuals
};

/// Least squares in v and C for a given order, `levels` from coarse to fine. With x = h/h_finest, h^p is
/// written (x^p - 1)/p, which has no trouble at p = 0; values relative to the finest keep the digits that
/// they share.
inline Fit fit_of_order(const std::vector<Level> &levels, double p)
{
  const Level &finest = levels.back();
  const auto basis = [&](const Level &level) {
    const double x = std::log(level.size / finest.size);
    return p == 0 ? x : std::expm1(p * x) / p;
  };
  double n = 0, b = 0, bb = 0, v = 0, bv = 0;
  for (const Level &level : levels) {
    const double phi = basis(level), y = level.value - finest.value;
    n += 1;
    b += phi;
    bb += phi * phi;
    v += y;
    bv += phi * y;
  }
  const double slope = (n * bv - b * v) / (n * bb - b * b), at_finest = (v - slope * b) / n;
  Fit fit{finest.value + at_finest - slope / p, finest.value + at_finest, 0};
  for (const Level &level : levels) {
    const double residual = level.value - finest.value - at_finest - slope * basis(level);
    fit.squares += residual * residual;
  }
  return fit;
}

/// The order of the best fit: the best of a scan, then golden sections around it. Three levels are met
/// exactly.
inline double best_order(const std::vector<Level> &levels)
{
  constexpr double lowest = -4, highest = 12, step = 0.05, golden = 0.6180339887498949, digits = 1e-12;
  const auto squares = [&](double p) { return fit_of_order(levels, p).squares; };
  double best = lowest;
  for (double p = lowest; p < highest + step / 2; p += step)
    if (squares(p) < squares(best)) best = p;
  double low = best - step, high = best + step;
  while (high - low > digits) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (squares(left) <= squares(right))
      high = right;
    else
      low = left;
  }
  return (low + high) / 2;
}

/// Three levels, of which `spread` is known, or more.
inline Extrapolation judge_by_fit(const std::vector<Level> &levels, double spread)
{
  const double finest = levels.back().value, p = best_order(levels);
  const double used = std::clamp(p, lowest_order, highest_order);
  const Convergence verdict = std::abs(p - used) < 1e-6 ? Convergence::confirmed
                              : p > used                ? Convergence::fast
                                                        : Convergence::slow;
  const Fit fit = fit_of_order(levels, used);
  const double distance = std::abs(fit.finest - fit.limit), misfit = std::abs(finest - fit.finest);
  if (levels.size() > 3) {
    const double scatter = std::sqrt(fit.squares / (static_cast<double>(levels.size()) - 3));
    return {verdict, fit.limit, confirmed_factor * distance + scatter + misfit, p};
  }
  if (verdict == Convergence::confirmed) return {verdict, fit.limit, confirmed_factor * distance + misfit, p};
  return {verdict, finest, doubtful_factor * std::max(spread, distance), p};
}

} // namespace extrapolation

/// Of the value at the finest level. `scale`: of values of this kind, below whose 1e-10 a difference is
/// round-off whatever the value (a torque before any rotation).
inline Extrapolation extrapolate(std::vector<Level> levels, double scale = 0)
{
  using namespace extrapolation;
  if (levels.empty()) return {};
  std::sort(levels.begin(), levels.end(), [](const Level &a, const Level &b) { return a.size > b.size; });
  const double finest = levels.back().value;
  if (levels.size() < 2) return {Convergence::unknown, finest};
  double low = finest, high = finest;
  int rises = 0, falls = 0;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    low = std::min(low, levels[k].value);
    high = std::max(high, levels[k].value);
    (levels[k + 1].value > levels[k].value ? rises : falls) += 1;
  }
  const double spread = high - low, whole = doubtful_factor * spread;
  if (spread <= round_off * std::max(std::abs(low), std::abs(high)) + zero * scale)
    return {Convergence::settled, finest, whole};
  if (levels.size() < 3) return {Convergence::few_levels, finest, whole};
  if (levels.size() == 3 && rises > 0 && falls > 0) return {Convergence::oscillates, finest, whole};
  return judge_by_fit(levels, spread);
}

/// Of the value at the first of two levels, of any sizes, where the order is known.
inline Extrapolation extrapolate_with(double order, const Level &judged, const Level &other, double scale = 0)
{
  using namespace extrapolation;
  const double difference = judged.value - other.value;
  const double distance = difference / (std::pow(other.size / judged.size, order) - 1); // from the limit
  const bool same = std::abs(difference) <= round_off * std::abs(judged.value) + zero * scale;
  return {same ? Convergence::settled : Convergence::few_levels, judged.value + distance,
          doubtful_factor * std::abs(distance), order};
}

} // namespace tribogel
