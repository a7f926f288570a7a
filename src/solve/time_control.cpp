/// TS over the schedule: one TSSolve per phase, so that each phase's end is hit exactly and the method
/// restarts with a small step at each jump of the plate's motion.
#include "solve/problem.hpp"
#include "solve/two_stage_ts.hpp"

#include <petsc/private/tsimpl.h> // PETSc 3.18 has no public way to give TS another error estimate

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace tribogel
{

namespace
{

/// A run that creeps on with shorter steps than this part of a phase's first does not get anywhere.
constexpr double smallest_of_first = 1e-4;
constexpr PetscInt most_rejections = 20; ///< of one step, unless options say otherwise

/// TS's error estimate, of what is looked at: the local error of N and T, from the second difference of their
/// last three values as TS takes it of U (h^2/2 times the second derivative), over `-ts_atol` times their
/// largest values so far.
PetscErrorCode EvaluateError(TS ts, NormType, PetscInt *order, PetscReal *error)
{
  Problem *problem;
  PetscReal step, first, unresolved, fraction;
  PetscFunctionBeginUser;
  PetscCall(TSGetApplicationContext(ts, &problem));
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  const State &state = problem->state;
  if (order) *order = 2;                              // the power of the step with which the error grows
  *error = -1;                                        // unknown
  if (problem->steady()) *error = keeps_the_step / 4; // nothing is integrated: only failures shorten steps
  if (state.steps_in_phase == 0 || problem->steady()) PetscFunctionReturn(0);
  PlateLoads loads;
  PetscCall(problem->SumPlateLoads(loads));
  const PlateLoads scale = problem->load_scales(state.largest);
  *error = 0;
  for (int k = 0; k < 2; ++k) {
    const double bend = (loads[k] - state.loads[k]) / step - state.load_rates[k];
    *error = std::max(*error, step * step / (step + state.step) * std::abs(bend) /
                                  (fraction * scale[k] + problem->least_loads[k]));
  }
  *error = rounded(*error);
  // What is over sooner than anybody looks is not resolved: Euler's rule damps it.
  PetscCall(problem->FirstStep(first, unresolved));
  if (step <= unresolved) *error = std::min(*error, keeps_the_step);
  PetscFunctionReturn(0);
}

} // namespace

double rounded(double estimate)
{
  constexpr double grid = 1 << 8;
  int exponent;
  const double mantissa = std::frexp(estimate, &exponent);
  return std::ldexp(std::round(grid * mantissa) / grid, exponent);
}

double Problem::expected_compression() const
{
  double approach = 0;
  for (const Phase &each : scene.schedule) approach = std::max(approach, std::abs(each.end_approach));
  return std::max(0.0, approach - scene.gap()) / scene.gel_height();
}

/// Never less than what a free bar of the softer gel would bear at the schedule's largest compression: less
/// than bonded gels bear, of the same order, and known before anything touches. What is only round-off beside
/// the other (the torque before any rotation) is not tracked.
PlateLoads Problem::load_scales(const PlateLoads &largest) const
{
  constexpr double negligible = 1e-8;
  const double radius = scene.upper_gel().radius, L = scene.twist_length();
  const double bar = 3 * scene.softer_modulus() * std::numbers::pi * radius * radius * expected_compression();
  return {std::max({largest[0], bar, negligible * largest[1] / L}),
          std::max(largest[1], negligible * largest[0] * L)};
}

PetscErrorCode PreStep(TS ts)
{
  Problem *problem;
  Vec U;
  PetscFunctionBeginUser;
  PetscCall(TSGetApplicationContext(ts, &problem));
  PetscCall(TSGetSolution(ts, &U));
  PetscCall(VecCopy(U, problem->before));
  PetscCall(problem->BeginStep());
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::SetUpTs()
{
  SNES snes;
  SNESLineSearch search;
  TSAdapt adapt;
  PetscFunctionBeginUser;
  PetscCall(TSCreate(PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm))), ts.put()));
  PetscCall(TSSetDM(ts, mesh.dm));
  PetscCall(TSSetProblemType(ts, TS_NONLINEAR));
  PetscCall(TSSetEquationType(ts, TS_EQ_DAE_IMPLICIT_INDEX1));
  const bool second_order = scene.time.rule == TimeRule::sdirk2;
  PetscCall(RegisterTwoStageTs());
  PetscCall(TSSetType(ts, second_order ? two_stage_ts : TSBEULER));
  static_cast<TS>(ts)->ops->evaluatewlte = second_order ? EvaluateSecondOrderError : EvaluateError;
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(TSSetMaxSteps(ts, PETSC_MAX_INT));
  PetscCall(TSSetMaxSNESFailures(ts, -1)); // the limit is per step, below
  PetscCall(TSSetMaxStepRejections(ts, most_rejections));
  PetscCall(TSSetErrorIfStepFails(ts, PETSC_FALSE));
  PetscCall(TSSetPreStep(ts, PreStep));
  PetscCall(TSSetPostStage(ts, PostStage));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptSetType(adapt, TSADAPTBASIC));
  PetscCall(TSAdaptSetClip(adapt, 0.1, 10));
  PetscCall(TSSetTolerances(ts, 0.01 * scene.time.tolerance, nullptr, 0, nullptr));

  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESSetType(snes, SNESNEWTONLS));
  PetscCall(SNESGetLineSearch(snes, &search));
  PetscCall(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  PetscCall(
      SNESSetDivergenceTolerance(snes, -1)); // a change of the active set may raise the residual at first
  PetscCall(SNESSetTolerances(snes, 0, 1e-7, 0, 25, -1));
  PetscCall(SetUpLinearSolver(snes));
  PetscFunctionReturn(0);
}

/// Of all ranks' cells, in the last evaluation of the residual.
PetscErrorCode Problem::SumPlateLoads(PlateLoads &loads) const
{
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCallMPI(MPI_Allreduce(plate_loads.data(), loads.data(), 2, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/// Commits an accepted step: rate, internal variables, energies; then tells the observers.
PetscErrorCode Problem::AcceptStep(PetscReal time, Vec U)
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
  PetscCall(SumPlateLoads(loads));
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
  for (Observer *observer : watching) PetscCall(observer->Step(*this, report));
  PetscCall(PetscLogEventEnd(events.observe, 0, 0, 0, 0));
  if (!stop_request.empty() || !stop_reason.empty()) PetscCall(TSSetConvergedReason(ts, TS_CONVERGED_USER));
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::BeginStep()
{
  Vec U, Udot;
  const PetscScalar *u;
  PetscFunctionBeginUser;
  if (!contact) PetscFunctionReturn(0);
  PetscCall(DMGetLocalVector(mesh.dm, &U));
  PetscCall(DMGetLocalVector(mesh.dm, &Udot));
  PetscCall(LocalState(U, Udot));
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(contact->BeginStep(frames(state.time, state.step), u));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscCall(DMRestoreLocalVector(mesh.dm, &Udot));
  PetscCall(DMRestoreLocalVector(mesh.dm, &U));
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::UpdatePattern(SNES snes)
{
  Vec U, local;
  PetscScalar *u;
  bool covered;
  PetscFunctionBeginUser;
  if (!contact) PetscFunctionReturn(0);
  PetscCall(SNESGetSolution(snes, &U));
  PetscCall(DMGetLocalVector(mesh.dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(DMGlobalToLocal(mesh.dm, U, INSERT_VALUES, local));
  PetscReal time = stage.time, length = stage.length;
  if (scene.time.rule == TimeRule::exponential_euler) {
    PetscCall(TSGetTime(ts, &time));
    PetscCall(TSGetTimeStep(ts, &length));
    time += length;
  }
  PetscCall(VecGetArray(local, &u));
  SetBoundary(time, u, nullptr);
  PetscCall(contact->UpdateCandidates(frames(time, length), u, covered));
  PetscCall(VecRestoreArray(local, &u));
  PetscCall(DMRestoreLocalVector(mesh.dm, &local));
  if (!covered) {
    ++counts.pattern_rebuilds;
    PetscCall(BuildMatrix());
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::RunPhase(int k)
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

PetscErrorCode Problem::Run(const std::vector<Observer *> &observers, bool &completed, std::string &why)
{
  PetscFunctionBeginUser;
  watching = observers;
  stop_request.clear();
  stop_reason.clear();
  const auto phases = static_cast<int>(scene.schedule.size());
  const SolveCounts known = counts;
  rejected_before = failed_before = 0;
  PetscCall(CountFailures());
  rejected_before = known.rejected_steps - counts.rejected_steps;
  failed_before = known.failed_solves - counts.failed_solves;
  PetscCall(TSSetStepNumber(ts, counts.accepted_steps));
  for (Observer *observer : watching) PetscCall(observer->Start(*this));
  for (int k = state.time < phase().end_time ? state.phase : state.phase + 1;
       k < phases && stop_reason.empty() && stop_request.empty(); ++k) {
    TSConvergedReason reason;
    PetscCall(RunPhase(k));
    PetscCall(TSGetConvergedReason(ts, &reason));
    const bool ended = !stop_reason.empty() || !stop_request.empty();
    if (!ended && (reason <= 0 || state.time != phase().end_time)) stop_for(Explain(reason));
  }
  const bool failed = !stop_reason.empty();
  if (failed) stop_request.clear(); // it cannot be continued from here
  why = failed ? stop_reason : stop_request;
  completed = !failed && state.time == scene.schedule.back().end_time;
  PetscCall(CountFailures());
  PetscFunctionReturn(0);
}

/// TS counts since the program's start, a run that goes on has counts from before.
PetscErrorCode Problem::CountFailures()
{
  PetscInt rejected, failed;
  PetscFunctionBeginUser;
  PetscCall(TSGetStepRejections(ts, &rejected));
  PetscCall(TSGetSNESFailures(ts, &failed));
  counts.rejected_steps = rejected_before + rejected;
  counts.failed_solves = failed_before + failed;
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::TellFailure()
{
  PetscFunctionBeginUser;
  for (Observer *observer : watching) PetscCall(observer->Failed(*this, last_failure));
  PetscFunctionReturn(0);
}

std::string Problem::Explain(TSConvergedReason reason) const
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
  else if (reason == TS_DIVERGED_STEP_REJECTED && static_cast<TS>(ts)->max_reject != most_rejections)
    reached("-ts_max_reject");
  else
    text << "no step from t = " << state.time << " s (phase " << state.phase + 1
         << ") succeeds, however small";
  if (!last_failure.words.empty()) text << ": " << last_failure.words;
  text << " (" << TSConvergedReasons[reason] << ")";
  if (last_failure.place) {
    const double compression = (phase().approach(state.time) - scene.initial_gap) / scene.gel_height();
    if (const std::string end = describe_end(scene, *last_failure.place, compression); !end.empty())
      text << ". " << end;
  }
  return text.str();
}

} // namespace tribogel
