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

/// All that a law sees of time: how the new state follows from the old ones. Never a step size alone, so that one-step
/// and two-step rules, frozen and relaxed states are one code.
struct StepWeights {
  /// Factor of the flow rule at the new time [s], >= 0: dt/a0 for a rule with leading coefficient a0, dt for Euler's.
  /// 0: the internal variables are frozen. Infinite: fully relaxed, the Maxwell stresses are exactly zero.
  double step;
  /// Exponent of the extrapolation from the level before the last. 0, the one-step rule, is the only one so far.
  double older = 0;
};

/// The internal variables at the past times; each level is Viscoelastic::history_size() numbers long.
template <class T> struct HistoryLevels {
  const T *at_n = nullptr; ///< at the last accepted time; not read by a law without branches
};

} // namespace tribogel
