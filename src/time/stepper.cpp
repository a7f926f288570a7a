/// TS over the schedule: one TSSolve per phase, so that each phase's end is hit exactly and the method
/// restarts with a small step at each jump of the plate's motion.
#include "time/stepper.hpp"

#include "support/petsc_arrays.hpp"
#include "time/rejections.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribogel
{

namespace
{

/// A run that creeps on with shorter steps than this part of a phase's first does not get anywhere.
constexpr double smallest_of_first = 1e-4;

} // namespace

StepWeights Stepper::weights(double time) const
{
  if (system.steady())
    return {std::numeric_limits<double>::infinity(), 1}; // the dashpots have had all the time
  const bool goes_on = scene.time.rule == TimeRule::sdirk2 && stage.index == 0;
  return {solve_length(time), goes_on ? sdirk2::reach : 1};
}

EulerSolve Stepper::solve(double time) const
{
  return {plates(time, solve_length(time)), weights(time), start(), friction_memory(time)};
}

/// The second stage goes on from where the first ended if it is damped: by Euler's rule.
FrictionMemory Stepper::friction_memory(double time) const
{
  if (stage.index == 0) return {state.friction_history.values, weights(time)};
  if (!stage.damped) return {stage.friction_start.values, weights(time)};
  return {stage.friction_end.values, {time - state.time - stage.length}};
}

FrictionMemory Stepper::friction_now() const
{
  return {state.friction_history.values, {system.steady() ? std::numeric_limits<double>::infinity() : 0}};
}

PlateMotion Stepper::motion(double time) const
{
  return plate_motion(phase(), scene.bottom_plate_rate, time);
}

PlateFrames Stepper::plates(double time, double step) const
{
  PlateFrames frames{motion(time)};
  if (system.steady()) frames.top_travel_rate = 0;
  frames.top_axis = scene.misalignment.offset;
  if (step > 0) frames.step = step;
  // In space a node near the axis may lie on either side of it, and its velocity turns round: what holds it
  // is stick.
  if (system.steady() && mesh.dim == 2) frames.step = std::numeric_limits<double>::infinity();
  return frames;
}

PetscErrorCode Stepper::LocalState(Vec U, Vec Udot) const
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(U));
  PetscCall(VecZeroEntries(Udot));
  PetscCall(DMGlobalToLocal(mesh.dm, state.U, INSERT_VALUES, U));
  PetscCall(DMGlobalToLocal(mesh.dm, state.Udot, INSERT_VALUES, Udot));
  {
    MutableArray u, rate;
    PetscCall(u.Get(U));
    PetscCall(rate.Get(Udot));
    system.SetBoundary(plates_now(), u, rate);
  }
  if (system.steady()) PetscCall(VecZeroEntries(Udot)); // state.Udot is how the load is raised, not a motion
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::BeginStep(Vec now)
{
  LocalVector U, Udot;
  ConstArray u;
  PetscFunctionBeginUser;
  PetscCall(VecCopy(now, before));
  if (!contact) PetscFunctionReturn(0);
  PetscCall(U.Get(mesh.dm));
  PetscCall(Udot.Get(mesh.dm));
  PetscCall(LocalState(U, Udot));
  PetscCall(u.Get(U));
  PetscCall(contact->BeginStep(plates_now(), u));
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::UpdatePattern(SNES snes)
{
  Vec U;
  bool covered;
  PetscFunctionBeginUser;
  if (!contact) PetscFunctionReturn(0);
  PetscCall(SNESGetSolution(snes, &U));
  {
    LocalVector local;
    MutableArray u;
    PetscCall(local.GetZero(mesh.dm));
    PetscCall(DMGlobalToLocal(mesh.dm, U, INSERT_VALUES, local));
    PetscCall(u.Get(local));
    system.SetBoundary(plates(stage.time, 0), u, nullptr);
    PetscCall(contact->UpdateCandidates(plates(stage.time, stage.length), u, covered));
  }
  if (!covered) {
    ++counts.pattern_rebuilds;
    PetscCall(BuildMatrix());
  }
  PetscFunctionReturn(0);
}

/// Commits an accepted step: rate, internal variables, energies; then tells the observers.
PetscErrorCode Stepper::AcceptStep(PetscReal time, Vec U)
{
  SNES snes;
  StepReport report;
  CellEnergy energy;
  History next;
  FrictionHistory remembered;
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.accept_step, 0, 0, 0, 0));
  const double step = time - state.time, until_touch = TimeUntilTouch();
  if (U != static_cast<Vec>(state.U)) PetscCall(VecCopy(U, state.U));
  PetscCall(SetRates(step, U));
  PetscCall(EvaluateEnd(time, next, energy));
  if (scene.time.rule == TimeRule::sdirk2) PetscCall(LargestStrain(next, state.largest_strain));
  if (!state.friction_history.values.empty()) {
    PetscCall(AdvanceFriction(time, friction_memory(time), U, state.Udot, remembered));
    state.friction_history = std::move(remembered);
  }
  stage.index = 0;
  state.history = std::move(next);
  state.stored = energy.stored;
  state.dissipated += stage.dissipated + energy.dissipated;
  state.time = time;
  state.step_before = state.step;
  state.step = step;
  ++state.steps_in_phase;
  PlateLoads loads;
  PetscCall(system.SumPlateLoads(loads));
  for (int k = 0; k < 2; ++k) {
    state.load_rates[k] = (loads[k] - state.loads[k]) / step;
    state.loads[k] = loads[k];
    state.largest[k] = std::max(state.largest[k], std::abs(loads[k]));
  }

  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetIterationNumber(snes, &report.newton_iterations));
  PetscCall(SNESGetLinearSolveIterations(snes, &report.linear_iterations));
  report.newton_iterations += stage.newton_iterations;
  report.linear_iterations += stage.linear_iterations;
  report.ends_phase = time == phase().end_time;
  PetscCall(CheckFriction());
  PetscCall(EndPhaseEarly());
  PetscCall(StopAtTouch(until_touch));
  PetscCall(TSGetTimeStep(ts, &state.next_step));
  PetscCall(CountFailures());
  ++counts.accepted_steps;
  counts.newton_iterations += report.newton_iterations;
  counts.linear_iterations += report.linear_iterations;
  PetscCall(PetscLogEventEnd(events.accept_step, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(events.observe, 0, 0, 0, 0));
  for (Observer *observer : watching) {
    PetscCall(observer->Step(*watched, report));
    stop.add(observer->stop);
  }
  PetscCall(PetscLogEventEnd(events.observe, 0, 0, 0, 0));
  if (stop.wanted()) PetscCall(TSSetConvergedReason(ts, TS_CONVERGED_USER));
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::RunPhase(int k)
{
  TSAdapt adapt;
  PetscReal step, unresolved;
  PetscFunctionBeginUser;
  const bool goes_on = state.phase == k && state.time > phase().start_time; // in the midst of the phase
  state.phase = k;
  if (!goes_on) state.steps_in_phase = 0;
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(FirstStep(step, unresolved));
  PetscCall(TSAdaptSetStepLimits(adapt, std::max(smallest_of_first * step, ShortestStep()), LongestStep()));
  PetscCall(TSSetTime(ts, goes_on ? state.time : phase().start_time));
  PetscCall(TSSetMaxTime(ts, phase().end_time));
  PetscCall(TSSetTimeStep(ts, goes_on ? state.next_step : std::min(step, LongestStep())));
  PetscCall(TSRestartStep(ts));
  PetscCall(TSSolve(ts, state.U));
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::Run(const Problem &problem, const std::vector<Observer *> &observers, bool &completed,
                            std::string &why)
{
  PetscFunctionBeginUser;
  watched = &problem;
  watching = observers;
  stop.clear();
  const auto phases = static_cast<int>(scene.schedule.size());
  const SolveCounts known = counts;
  rejected_before = failed_before = 0;
  PetscCall(CountFailures());
  rejected_before = known.rejected_steps - counts.rejected_steps;
  failed_before = known.failed_solves - counts.failed_solves;
  PetscCall(TSSetStepNumber(ts, counts.accepted_steps));
  for (Observer *observer : watching) {
    observer->stop.clear();
    PetscCall(observer->Start(problem));
    stop.add(observer->stop);
  }
  for (int k = state.time < phase().end_time ? state.phase : state.phase + 1; k < phases && !stop.wanted();
       ++k) {
    TSConvergedReason reason;
    PetscCall(RunPhase(k));
    PetscCall(TSGetConvergedReason(ts, &reason));
    if (!stop.wanted() && (reason <= 0 || state.time != phase().end_time)) stop.give_up(Explain(reason));
  }
  why = stop.reason();
  completed = !stop.given_up() && state.time == scene.schedule.back().end_time;
  PetscCall(CountFailures());
  PetscFunctionReturn(0);
}

/// TS counts since the program's start, a run that goes on has counts from before.
PetscErrorCode Stepper::CountFailures()
{
  PetscInt rejected, failed;
  PetscFunctionBeginUser;
  PetscCall(TSGetStepRejections(ts, &rejected));
  PetscCall(TSGetSNESFailures(ts, &failed));
  counts.rejected_steps = rejected_before + rejected;
  counts.failed_solves = failed_before + failed;
  PetscFunctionReturn(0);
}

std::string Stepper::Explain(TSConvergedReason reason) const
{
  std::ostringstream text;
  const auto reached = [&](const char *option) {
    text << option << " reached at t = " << state.time << " s (phase " << state.phase + 1 << ")";
  };
  if (reason == TS_CONVERGED_ITS) {
    reached("-ts_max_steps");
    return text.str();
  }
  if (reason == TS_DIVERGED_NONLINEAR_SOLVE)
    reached("-ts_max_snes_failures"); // without it failures are not counted
  else if (reason == TS_DIVERGED_STEP_REJECTED && rejections_allowed(ts) != most_rejections)
    reached("-ts_max_reject");
  else
    text << "no step from t = " << state.time << " s (phase " << state.phase + 1
         << ") succeeds, however small";
  if (!last_failure.words.empty()) text << ": " << last_failure.words;
  text << " (" << TSConvergedReasons[reason] << ")";
  if (last_failure.place) {
    const double compression = (-motion(state.time).top_travel - scene.initial_gap) / scene.gel_height();
    if (const std::string end = describe_end(scene, *last_failure.place, compression); !end.empty())
      text << ". " << end;
  }
  return text.str();
}

} // namespace tribogel
