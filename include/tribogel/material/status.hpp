/// What a material law is told about the step, and how it says that it could not take it.
#pragma once

namespace tribogel
{

/// Failure is reported, never thrown or printed: the caller turns it into a shorter step.
enum class PointStatus {
  ok,
  inverted,           ///< det F is not a positive finite number
  local_newton_failed ///< the internal variables could not be found
};

/// All that a law sees of time: how the new state follows from the old one. Never a step size alone, so that
/// steps and stages, frozen and relaxed states are one code.
struct StepWeights {
  /// Factor of the flow rule at the new time [s], >= 0: dt for Euler's rule, the length of a stage for
  /// SDIRK2. 0: the internal variables are frozen. Infinite: fully relaxed, the Maxwell stresses are exactly
  /// zero.
  double step;
  /// Where on the flow of this step, carried on, the new history lies: 1 at its end. SDIRK2's first stage
  /// leaves the second's start instead, THEORY (1.18). Stresses are always those at the end.
  double reach = 1;

  bool operator==(const StepWeights &) const = default;
};

/// The internal variables at the past times; each level is Viscoelastic::history_size() numbers long.
template <class T> struct HistoryLevels {
  const T *at_n = nullptr; ///< where the step or stage starts; not read by a law without branches
};

} // namespace tribogel
