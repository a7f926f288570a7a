/// TS over the schedule: one TSSolve per phase, so that each phase's end is hit exactly and the method restarts with a
/// small step at each jump of the plate's motion.
#include "solve/problem.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribogel
{

namespace
{

/// First step of a phase over its duration: well below the gels' relaxation times (seconds) for phases of minutes, and
/// a dozen growing steps away from any longer one. TS has no error estimate for it.
constexpr double first_step_fraction = 1e-5;
constexpr double smallest_step_fraction = 1e-12;

} // namespace

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
  KSP ksp;
  PC pc;
  TSAdapt adapt;
  PetscFunctionBeginUser;
  PetscCall(TSCreate(PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm))), ts.put()));
  PetscCall(TSSetDM(ts, mesh.dm));
  PetscCall(TSSetProblemType(ts, TS_NONLINEAR));
  PetscCall(TSSetEquationType(ts, TS_EQ_DAE_IMPLICIT_INDEX1));
  PetscCall(TSSetType(ts, TSBEULER));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(TSSetMaxSteps(ts, PETSC_MAX_INT));
  PetscCall(TSSetMaxSNESFailures(ts, -1)); // the limit is per step, below
  PetscCall(TSSetMaxStepRejections(ts, 20));
  PetscCall(TSSetErrorIfStepFails(ts, PETSC_FALSE));
  PetscCall(TSSetPreStep(ts, PreStep));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptSetType(adapt, TSADAPTBASIC));
  PetscCall(TSAdaptSetClip(adapt, 0.1, 4.0));
  PetscCall(VecSet(step_tolerance, PETSC_MAX_REAL)); // nothing to compare with before the first step
  PetscCall(TSSetTolerances(ts, 1e-3, step_tolerance, 0, nullptr));

  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESSetType(snes, SNESNEWTONLS));
  PetscCall(SNESGetLineSearch(snes, &search));
  PetscCall(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  PetscCall(SNESSetDivergenceTolerance(snes, -1)); // a change of the active set may raise the residual at first
  PetscCall(SNESSetTolerances(snes, 0, 1e-9, 0, 25, -1));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCLU));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(0);
}

/// Weights of TS's error estimate: `-ts_atol` times the root mean square of each group, at its largest so far, so that
/// displacements and tractions of every direction are kept to the same relative error whatever their size and number.
PetscErrorCode Problem::SetStepTolerances()
{
  const PetscScalar *u;
  PetscScalar *tolerance;
  PetscReal fraction;
  double sums[2 * residual_groups] = {};
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(state.U, &u));
  for (std::size_t k = 0; k < group.size(); ++k) {
    const int g = group[k];
    sums[g] += u[k] * u[k];
    sums[residual_groups + g] += 1;
  }
  PetscCall(VecRestoreArrayRead(state.U, &u));
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(state.U)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2 * residual_groups, MPI_DOUBLE, MPI_SUM, comm));
  double count = 0;
  for (int g = 0; g < residual_groups; ++g) {
    const double n = sums[residual_groups + g];
    if (n > 0) largest[g] = std::max(largest[g], std::sqrt(sums[g] / n));
    count += n;
  }
  // Radial and axial components share a scale: the radial traction of a nearly flat contact is of second order, and
  // nobody needs it to a thousandth of itself. Turning is separate: a torque is small beside a force and matters.
  // What is only round-off (the twist before any rotation) is not tracked.
  constexpr double negligible = 1e-8;
  double scale[residual_groups];
  for (int g = 0; g < residual_groups; ++g) {
    const int field = g / 3 * 3;
    const double in_plane = std::max(largest[field], largest[field + 2]), turning = largest[field + 1];
    const double size =
        g == field + 1 ? std::max(turning, negligible * in_plane) : std::max(in_plane, negligible * turning);
    scale[g] = size > 0 ? size * std::sqrt(sums[residual_groups + g] / count) : PETSC_MAX_REAL;
  }
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  PetscCall(VecGetArray(step_tolerance, &tolerance));
  for (std::size_t k = 0; k < group.size(); ++k) {
    const double s = scale[static_cast<int>(group[k])];
    tolerance[k] = s < PETSC_MAX_REAL ? fraction * s : s;
  }
  PetscCall(VecRestoreArray(step_tolerance, &tolerance));
  PetscCall(TSSetTolerances(ts, PETSC_DEFAULT, step_tolerance, PETSC_DEFAULT, nullptr));
  PetscFunctionReturn(0);
}

/// Commits an accepted step: rate, internal variables, energies; then tells the observers.
PetscErrorCode Problem::AcceptStep(PetscReal time, Vec U)
{
  SNES snes;
  Vec local;
  const PetscScalar *u;
  StepReport report;
  CellEnergy energy;
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.accept_step, 0, 0, 0, 0));
  const double step = time - state.time;
  if (U != static_cast<Vec>(state.U)) PetscCall(VecCopy(U, state.U));
  PetscCall(VecWAXPY(state.Udot, -1, before, U));
  PetscCall(VecScale(state.Udot, 1 / step)); // backward Euler's rate

  PetscCall(DMGetLocalVector(mesh.dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(DMGlobalToLocal(mesh.dm, state.U, INSERT_VALUES, local));
  PetscScalar *values;
  PetscCall(VecGetArray(local, &values));
  SetBoundary(time, values, nullptr);
  PetscCall(VecRestoreArray(local, &values));
  PetscCall(VecGetArrayRead(local, &u));
  History next(state.history.size());
  const BulkFailure failure = bulk->Advance(u, state.history, weights(time), next, energy);
  PetscCheck(!failure, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a converged step cannot be evaluated again");
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(DMRestoreLocalVector(mesh.dm, &local));
  state.history = std::move(next);
  state.stored = energy.stored;
  state.dissipated += energy.dissipated;
  state.time = time;
  state.step = step;

  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetIterationNumber(snes, &report.newton_iterations));
  PetscCall(SNESGetLinearSolveIterations(snes, &report.linear_iterations));
  report.ends_phase = time == phase().end_time;
  ++counts.accepted_steps;
  counts.newton_iterations += report.newton_iterations;
  counts.linear_iterations += report.linear_iterations;
  PetscCall(SetStepTolerances());
  PetscCall(PetscLogEventEnd(events.accept_step, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(events.observe, 0, 0, 0, 0));
  for (Observer *observer : watching) PetscCall(observer->Step(*this, report));
  PetscCall(PetscLogEventEnd(events.observe, 0, 0, 0, 0));
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
  PetscReal time, step;
  PetscCall(TSGetTime(ts, &time));
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(VecGetArray(local, &u));
  SetBoundary(time + step, u, nullptr);
  PetscCall(contact->UpdateCandidates(frames(time + step, step), u, covered));
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
  PetscReal given;
  PetscBool set;
  TSAdapt adapt;
  PetscFunctionBeginUser;
  state.phase = k;
  const double duration = phase().duration();
  PetscCall(PetscOptionsGetReal(nullptr, nullptr, "-ts_dt", &given, &set));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptSetStepLimits(adapt, smallest_step_fraction * duration, PETSC_DEFAULT));
  PetscCall(TSSetTime(ts, phase().start_time));
  PetscCall(TSSetMaxTime(ts, phase().end_time));
  PetscCall(TSSetTimeStep(ts, std::min(duration, set ? given : first_step_fraction * duration)));
  PetscCall(TSRestartStep(ts));
  PetscCall(TSSolve(ts, state.U));
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::Run(const std::vector<Observer *> &observers, bool &completed, std::string &why)
{
  PetscFunctionBeginUser;
  watching = observers;
  completed = true;
  for (Observer *observer : watching) PetscCall(observer->Start(*this));
  for (int k = state.phase; k < static_cast<int>(scene.schedule.size()) && completed; ++k) {
    TSConvergedReason reason;
    PetscCall(RunPhase(k));
    PetscCall(TSGetConvergedReason(ts, &reason));
    completed = reason > 0 && state.time == phase().end_time;
    if (!completed) why = Explain(reason);
  }
  PetscCall(TSGetStepRejections(ts, &counts.rejected_steps));
  PetscCall(TSGetSNESFailures(ts, &counts.failed_solves));
  PetscFunctionReturn(0);
}

std::string Problem::Explain(TSConvergedReason reason) const
{
  std::ostringstream text;
  if (reason == TS_CONVERGED_ITS) {
    text << "-ts_max_steps reached at t = " << state.time << " s (phase " << state.phase + 1 << ")";
    return text.str();
  }
  text << "no step from t = " << state.time << " s (phase " << state.phase + 1 << ") succeeds, however small";
  if (bulk_failure)
    text << ": " << describe(bulk_failure);
  else if (!contact_failure.empty())
    text << ": " << contact_failure;
  else if (worst.ratio > 1)
    text << ": Newton's " << group_names[worst.group] << " stays at " << worst.ratio
         << " times its tolerance near R = " << worst.X[0] << " mm, Z = " << worst.X[1] << " mm of the "
         << (worst.body == top_body ? "top" : "bottom") << " gel";
  text << " (" << TSConvergedReasons[reason] << ")";
  return text.str();
}

} // namespace tribogel
