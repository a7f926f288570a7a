/// What a material law is told about the past, and how it says that it could not take a step.
#pragma once

#include "tribogel/math/step_weights.hpp"

namespace tribogel
{

/// Failure is reported, never thrown or printed: the caller turns it into a shorter step.
enum class PointStatus {
  ok,
  inverted,           ///< det F is not a positive finite number
  local_newton_failed ///< the internal variables could not be found
};

/// The internal variables at the past times; each level is Viscoelastic::history_size() numbers long.
template <class T> struct HistoryLevels {
  const T *at_n = nullptr; ///< where the step or stage starts; not read by a law without branches
};

} // namespace tribogel
