/// What friction laws remember, of all slave nodes of a scene.
#pragma once

#include "tribogel/math/step_weights.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace tribogel
{

/// One number a slave node, the lower face's before the wall's, the same on every rank; none for a law
/// without memory. A type of its own: a bulk's History is another list of numbers.
struct FrictionHistory {
  std::vector<double> values;
  bool operator==(const FrictionHistory &) const = default;
};

/// What the contact conditions are told: what is remembered where the solve starts, and the solve.
struct FrictionMemory {
  std::span<const double> start;
  StepWeights weights{0};

  /// Of `count` nodes from `first` on.
  FrictionMemory part(std::size_t first, std::size_t count) const
  {
    return start.empty() ? *this : FrictionMemory{start.subspan(first, count), weights};
  }
};

} // namespace tribogel
