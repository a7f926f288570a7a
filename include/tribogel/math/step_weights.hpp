/// What a law with internal variables is told about the step.
#pragma once

namespace tribogel
{

/// All that such a law sees of time: how the new state follows from the old one. Never a step size alone, so
/// that steps and stages, frozen and relaxed states are one code.
struct StepWeights {
  /// Factor of the flow rule at the new time [s], >= 0: dt for Euler's rule, the length of a stage for
  /// SDIRK2. 0: the internal variables are frozen. Infinite: fully relaxed, the Maxwell stresses are exactly
  /// zero and friction is that of steady sliding.
  double step;
  /// Where on the flow of this step, carried on, the new history lies: 1 at its end. SDIRK2's first stage
  /// leaves the second's start instead, THEORY (1.18). Stresses are always those at the end.
  double reach = 1;

  bool operator==(const StepWeights &) const = default;
};

} // namespace tribogel
