/// Why an attempt at a step failed: in words for people, by kind for counting.
#pragma once

#include "tribogel/scene/scene.hpp"

#include <array>
#include <optional>
#include <string>

namespace tribogel
{

enum class FailureKind {
  inverted_element,
  maxwell_update,
  contact_search,
  linear_solver,
  not_a_number,
  newton
};
inline constexpr int failure_kinds = 6;
inline constexpr const char *failure_names[failure_kinds] = {
    "inverted_element", "maxwell_update", "contact_search", "linear_solver", "not_a_number", "newton"};

/// Failed attempts by kind.
using FailureCounts = std::array<int, failure_kinds>;

/// A place in the undeformed bodies.
struct FailurePlace {
  int body;
  std::array<double, 3> X; ///< (R, Z, 0) or (x, y, z) [mm]
  bool folds = true;       ///< an element or a facet turned over there; otherwise forces did not balance
};

struct StepFailure {
  FailureKind kind = FailureKind::newton;
  double time = 0, step = 0; ///< the attempt went from `time` over `step` [s]
  std::string words;         ///< what and where, without a stop
  std::optional<FailurePlace> place = {};
};

/// What is at that place, as seen by someone who looks at the rheometer, why the computation may end there,
/// and what may help: sentences. The gels are compressed by `compression` of their height. No words for
/// bodies of a mesh file.
std::string describe_end(const Scene &scene, const FailurePlace &place, double compression);

} // namespace tribogel
