/// Every PETSc callback of the program, in the order in which a step calls them.
#include "solve/problem.hpp"

#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

/// Prescribed values and rates, before each evaluation.
PetscErrorCode Boundary(DM, PetscReal time, Vec U, Vec Udot, void *context)
{
  const auto &problem = *static_cast<Problem *>(context);
  PetscScalar *u, *rate = nullptr;
  PetscFunctionBeginUser;
  PetscCall(VecGetArray(U, &u));
  if (Udot) PetscCall(VecGetArray(Udot, &rate));
  problem.SetBoundary(time, u, rate);
  if (Udot) PetscCall(VecRestoreArray(Udot, &rate));
  PetscCall(VecRestoreArray(U, &u));
  PetscFunctionReturn(0);
}

/// F(t, U, Udot): internal minus external forces, contact conditions.
PetscErrorCode Residual(DM dm, PetscReal time, Vec U, Vec Udot, Vec F, void *context)
{
  auto &problem = *static_cast<Problem *>(context);
  const PetscScalar *u, *rate;
  PetscScalar *f, *sizes;
  Vec local_sizes;
  PetscFunctionBeginUser;
  PetscCall(DMGetLocalVector(dm, &local_sizes));
  PetscCall(VecZeroEntries(local_sizes));
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(Udot, &rate));
  PetscCall(VecGetArray(F, &f));
  PetscCall(VecGetArray(local_sizes, &sizes));
  PetscCall(problem.AddResidual(time, u, rate, f, sizes));
  PetscCall(VecRestoreArray(local_sizes, &sizes));
  PetscCall(VecRestoreArray(F, &f));
  PetscCall(VecRestoreArrayRead(Udot, &rate));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscCall(VecZeroEntries(problem.magnitude));
  PetscCall(DMLocalToGlobal(dm, local_sizes, ADD_VALUES, problem.magnitude));
  PetscCall(DMRestoreLocalVector(dm, &local_sizes));
  if (problem.bulk_failure || !problem.contact_failure.empty()) { // the same on every rank
    SNES snes;
    PetscCall(TSGetSNES(problem.ts, &snes));
    PetscCall(SNESSetFunctionDomainError(snes));
  }
  PetscFunctionReturn(0);
}

/// dF/dU + shift dF/dUdot.
PetscErrorCode Jacobian(DM, PetscReal time, Vec U, Vec Udot, PetscReal shift, Mat A, Mat P, void *context)
{
  auto &problem = *static_cast<Problem *>(context);
  const PetscScalar *u, *rate;
  PetscFunctionBeginUser;
  if (problem.old_matrix_will_do()) PetscFunctionReturn(0); // untouched, and so PETSc keeps its factors
  PetscCall(MatZeroEntries(P));
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(Udot, &rate));
  PetscCall(problem.AddJacobian(time, u, rate, shift, P));
  PetscCall(VecRestoreArrayRead(Udot, &rate));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
  if (A != P) {
    PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(0);
}

/// Start of a solve: the last step's motion goes on, and so does its change unless the step is much longer
/// than those it is known from. After a jump of the plate's motion nothing is known.
PetscErrorCode Predict(SNES, Vec U, void *context)
{
  auto &problem = *static_cast<Problem *>(context);
  const State &state = problem.state;
  constexpr double much_longer = 2;
  PetscReal step;
  PetscFunctionBeginUser;
  if (problem.contact) problem.contact->BeginAttempt();
  if (problem.stage.index == 0 && problem.state.time > 0) problem.direct_solver.Forget();
  if (problem.scene.time.rule == TimeRule::sdirk2) {
    PetscCall(problem.PredictStage(U));
    PetscFunctionReturn(0);
  }
  PetscCall(TSGetTimeStep(problem.ts, &step));
  PetscCall(VecCopy(state.U, U));
  if (state.steps_in_phase >= 1) PetscCall(VecAXPY(U, step, state.Udot));
  if (state.steps_in_phase >= 2 && step <= much_longer * state.step) {
    const double bend = step * (step + state.step) / (state.step + state.step_before);
    PetscCall(VecAXPBYPCZ(U, bend, -bend, 1, state.Udot, state.Udot_before));
  }
  PetscFunctionReturn(0);
}

/// Start of a Newton iteration: the surfaces may have slid out of the matrix's pattern, and the residual says
/// how far the linear solve need go.
PetscErrorCode StartIteration(SNES snes, PetscInt)
{
  Problem *problem;
  PetscFunctionBeginUser;
  PetscCall(SNESGetApplicationContext(snes, &problem));
  PetscCall(problem->UpdatePattern(snes));
  PetscCall(problem->ChooseTolerance(snes));
  PetscFunctionReturn(0);
}

PetscErrorCode Converged(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal norm,
                         SNESConvergedReason *reason, void *context)
{
  auto &problem = *static_cast<Problem *>(context);
  PetscInt most;
  Vec F;
  bool converged;
  PetscFunctionBeginUser;
  const double ratio_before = problem.worst.ratio;
  *reason = SNES_CONVERGED_ITERATING;
  problem.contraction = std::numeric_limits<double>::infinity();
  if (PetscIsInfOrNanReal(norm)) {
    *reason = SNES_DIVERGED_FNORM_NAN;
    PetscFunctionReturn(0);
  }
  PetscCall(SNESGetFunction(snes, &F, nullptr, nullptr));
  PetscCall(problem.JudgeResidual(F, iteration > 0, converged));
  PetscCall(SNESGetTolerances(snes, nullptr, nullptr, nullptr, &most, nullptr));
  if (converged)
    *reason = SNES_CONVERGED_FNORM_RELATIVE;
  else if (iteration >= most)
    *reason = SNES_DIVERGED_MAX_IT;
  else if (iteration > 0)
    problem.contraction = problem.worst.ratio / ratio_before;
  PetscFunctionReturn(0);
}

/// After a step that TS accepted. TS also calls this once for a step that failed for good: then time stands
/// still.
PetscErrorCode PostStep(TS ts)
{
  Problem *problem;
  PetscReal time;
  Vec U;
  PetscFunctionBeginUser;
  PetscCall(TSGetApplicationContext(ts, &problem));
  PetscCall(TSGetTime(ts, &time));
  PetscCall(TSGetSolution(ts, &U));
  // t + (t_end - t) can miss t_end by a rounding: the phase has ended all the same.
  const double end = problem->phase().end_time;
  if (time != end && std::abs(time - end) <= 4 * std::numeric_limits<double>::epsilon() * end) {
    time = end;
    PetscCall(TSSetTime(ts, end));
    PetscCall(TSSetConvergedReason(ts, TS_CONVERGED_TIME));
  }
  if (time > problem->state.time) PetscCall(problem->AcceptStep(time, U));
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode RegisterCallbacks(Problem &problem)
{
  SNES snes;
  PetscFunctionBeginUser;
  PetscCall(DMTSSetBoundaryLocal(problem.mesh.dm, Boundary, &problem));
  PetscCall(DMTSSetIFunctionLocal(problem.mesh.dm, Residual, &problem));
  PetscCall(DMTSSetIJacobianLocal(problem.mesh.dm, Jacobian, &problem));
  PetscCall(TSSetApplicationContext(problem.ts, &problem));
  PetscCall(TSSetPostStep(problem.ts, PostStep));
  PetscCall(TSGetSNES(problem.ts, &snes));
  PetscCall(SNESSetApplicationContext(snes, &problem));
  PetscCall(SNESSetComputeInitialGuess(snes, Predict, &problem));
  PetscCall(SNESSetUpdate(snes, StartIteration));
  PetscCall(SNESSetConvergenceTest(snes, Converged, &problem, nullptr));
  PetscFunctionReturn(0);
}

} // namespace tribogel
