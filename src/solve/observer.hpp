/// What watches a run: called on all ranks after each accepted step, never after a rejected one. An observer
/// may not change the solution, the schedule or the solver; it may ask the run to stop,
/// or end it when it cannot do its work (Problem::stop), on all ranks alike.
#pragma once

#include "solve/failure.hpp"

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
  virtual PetscErrorCode Start(Problem &problem) = 0; ///< the initial state
  virtual PetscErrorCode Step(Problem &problem, const StepReport &report) = 0;
  virtual PetscErrorCode Failed(Problem &, const StepFailure &)
  {
    return 0;
  } ///< an attempt; TS cuts the step
  virtual PetscErrorCode Notice(Problem &, const std::string &) { return 0; } ///< worth telling people
};

} // namespace tribogel
