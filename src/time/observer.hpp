/// What watches a run: called on all ranks after each accepted step, never after a rejected one. An observer
/// is shown the problem and may change nothing; it may ask the run to stop, or end it when it cannot do its
/// work, by its `stop`, on all ranks alike.
#pragma once

#include "support/stop_wish.hpp"
#include "time/failure.hpp"

#include <petscts.h>

namespace tribogel
{

class Problem;

/// How the accepted step was found.
struct StepReport {
  PetscInt newton_iterations = 0, linear_iterations = 0;
  bool ends_phase = false;
};

class Observer
{
public:
  virtual ~Observer() = default;
  virtual PetscErrorCode Start(const Problem &problem) = 0; ///< the initial state
  virtual PetscErrorCode Step(const Problem &problem, const StepReport &report) = 0;
  virtual PetscErrorCode Failed(const Problem &, const StepFailure &)
  {
    return 0;
  } ///< an attempt; TS cuts the step
  virtual PetscErrorCode Notice(const Problem &, const std::string &) { return 0; } ///< worth telling people

  StopWish stop;
};

} // namespace tribogel
