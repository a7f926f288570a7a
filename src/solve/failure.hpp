/// Why an attempt at a step failed: in words for people, by kind for counting.
#pragma once

#include <array>
#include <string>

namespace tribogel
{

enum class FailureKind { inverted_element, maxwell_update, contact_search, linear_solver, not_a_number, newton };
inline constexpr int failure_kinds = 6;
inline constexpr const char *failure_names[failure_kinds] = {"inverted_element", "maxwell_update", "contact_search",
                                                             "linear_solver",    "not_a_number",   "newton"};

/// Failed attempts by kind.
using FailureCounts = std::array<int, failure_kinds>;

struct StepFailure {
  FailureKind kind = FailureKind::newton;
  double time = 0, step = 0; ///< the attempt went from `time` over `step` [s]
  std::string words;         ///< what and where, without a stop
};

} // namespace tribogel
