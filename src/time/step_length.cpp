/// How long steps may be before their errors are known: at a phase's start, at the first touch, at all.
#include "time/stepper.hpp"
#include "tribogel/material/relaxation.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

/// Over a phase's duration: nobody looks at what is over sooner.
constexpr double shortest_of_interest = 1.0 / 500;

} // namespace

/// There is no error estimate for the first step of a phase. A relaxation in the time tau has the local error
/// h^2/(2 tau^2):
/// `-ts_atol` with tau the shortest relaxation time of the gels. Errors of steps up to `unresolved` do not
/// count.
PetscErrorCode Stepper::FirstStep(PetscReal &step, PetscReal &unresolved) const
{
  PetscReal fraction;
  PetscFunctionBeginUser;
  unresolved = step = phase().duration();
  if (system.steady()) PetscFunctionReturn(0); // one step, unless it fails
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  double tau = shortest_of_interest * phase().duration();
  for (const Specimen *gel : scene.gels())
    for (const auto &branch : gel->material.branches) tau = std::min(tau, shape_relaxation_time(branch));
  const double constant = scene.time.rule == TimeRule::sdirk2 ? sdirk2::error_constant : 0.5;
  unresolved = step =
      std::min(std::max(std::sqrt(fraction / constant) * tau, ShortestStep()), phase().duration());
  if (TimeUntilTouch() == phase().duration()) step = phase().duration(); // nothing happens in it
  if (given_first_step > 0) {
    step = std::min(std::max(given_first_step, ShortestStep()), phase().duration());
    unresolved = std::min(step, unresolved);
  }
  constexpr double rounding = 1e-3; // of steps that TS repeats
  unresolved *= 1 + rounding;
  PetscFunctionReturn(0);
}

/// Added to any time of the phase it makes another: with less a run would never end.
PetscReal Stepper::ShortestStep() const
{
  return 16 * std::numeric_limits<double>::epsilon() * phase().end_time;
}

/// While nothing has been loaded there is nothing to be resolved until the plate has travelled the gap. A
/// little less, so that the gels are apart then; 0 afterwards.
PetscReal Stepper::TimeUntilTouch() const
{
  const Phase &now = phase();
  const bool alone_and_moves =
      !scene.has_contact() && (now.end_approach != 0 || now.rate != scene.bottom_plate_rate);
  if (alone_and_moves || state.largest[0] > system.least.loads[0] || state.largest[1] > system.least.loads[1])
    return 0;
  double touch = now.end_time;
  if (scene.has_contact() && now.end_approach > scene.initial_gap)
    touch =
        now.start_time + (scene.initial_gap - now.start_approach) / now.approach_rate() - 2 * ShortestStep();
  const double left = touch - std::max(state.time, now.start_time);
  return left > ShortestStep() ? left : 0;
}

/// No step goes over the first touch, and one that ends there is followed by as short a one as begins a
/// phase.
PetscErrorCode Stepper::StopAtTouch(PetscReal left_before)
{
  PetscReal step, unresolved;
  PetscFunctionBeginUser;
  const double left = TimeUntilTouch();
  if (left_before > 0 && left == 0 && state.time < phase().end_time) {
    PetscCall(FirstStep(step, unresolved));
    PetscCall(TSSetTimeStep(ts, std::min(step, phase().end_time - state.time)));
  } else if (left > 0) {
    PetscCall(TSGetTimeStep(ts, &step));
    PetscCall(TSSetTimeStep(ts, std::min(step, left)));
  }
  PetscFunctionReturn(0);
}

/// Loads that turn through the gels come back after a revolution: a step of much of one would not see that
/// they change.
PetscReal Stepper::LongestStep() const
{
  constexpr double most_of_a_turn = 0.5; // [rad]
  const double rate = std::abs(phase().rate - scene.bottom_plate_rate);
  return scene.loads_turn() && rate > 0 ? std::min(most_of_a_turn / rate, given_longest_step)
                                        : given_longest_step;
}

} // namespace tribogel
