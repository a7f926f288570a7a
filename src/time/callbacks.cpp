/// What PETSc calls, in the order in which a step calls it.
#include "time/stepper.hpp"

#include "support/petsc_arrays.hpp"

#include <cmath>
#include <limits>

namespace tribogel
{

/// Each finds the Stepper in its context.
struct StepperCallbacks {
  static PetscErrorCode PreStep(TS ts)
  {
    Stepper *stepper;
    Vec U;
    PetscFunctionBeginUser;
    PetscCall(TSGetApplicationContext(ts, &stepper));
    PetscCall(TSGetSolution(ts, &U));
    PetscCall(stepper->BeginStep(U));
    PetscFunctionReturn(0);
  }

  /// Start of a solve.
  static PetscErrorCode Predict(SNES, Vec U, void *context)
  {
    return static_cast<Stepper *>(context)->Predict(U);
  }

  /// Prescribed values and rates, before each evaluation.
  static PetscErrorCode Boundary(DM, PetscReal time, Vec U, Vec Udot, void *context)
  {
    const auto &stepper = *static_cast<Stepper *>(context);
    MutableArray u, rate; // null without Udot
    PetscFunctionBeginUser;
    PetscCall(u.Get(U));
    if (Udot) PetscCall(rate.Get(Udot));
    stepper.system.SetBoundary(stepper.plates(time, 0), u, rate);
    PetscFunctionReturn(0);
  }

  /// F(t, U, Udot): internal minus external forces, contact conditions.
  static PetscErrorCode Residual(DM dm, PetscReal time, Vec U, Vec Udot, Vec F, void *context)
  {
    auto &stepper = *static_cast<Stepper *>(context);
    System &system = stepper.system;
    LocalVector local_sizes;
    PetscFunctionBeginUser;
    PetscCall(local_sizes.GetZero(dm));
    {
      ConstArray u, rate;
      MutableArray f, sizes;
      PetscCall(u.Get(U));
      PetscCall(rate.Get(Udot));
      PetscCall(f.Get(F));
      PetscCall(sizes.Get(local_sizes));
      PetscCall(system.AddResidual(stepper.solve(time), u, rate, f, sizes));
    }
    PetscCall(VecZeroEntries(system.rows.magnitude));
    PetscCall(DMLocalToGlobal(dm, local_sizes, ADD_VALUES, system.rows.magnitude));
    if (system.failure) { // the same on every rank
      SNES snes;
      PetscCall(TSGetSNES(stepper.ts, &snes));
      PetscCall(SNESSetFunctionDomainError(snes));
    }
    PetscFunctionReturn(0);
  }

  static PetscErrorCode Converged(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal norm,
                                  SNESConvergedReason *reason, void *context)
  {
    return static_cast<Stepper *>(context)->Converged(snes, iteration, norm, reason);
  }

  /// Start of a Newton iteration: the surfaces may have slid out of the matrix's pattern, and the residual
  /// says how far the linear solve need go.
  static PetscErrorCode StartIteration(SNES snes, PetscInt)
  {
    Stepper *stepper;
    PetscFunctionBeginUser;
    PetscCall(SNESGetApplicationContext(snes, &stepper));
    PetscCall(stepper->UpdatePattern(snes));
    PetscCall(stepper->ChooseTolerance(snes));
    PetscFunctionReturn(0);
  }

  /// dF/dU + shift dF/dUdot.
  static PetscErrorCode Jacobian(DM, PetscReal time, Vec U, Vec Udot, PetscReal shift, Mat A, Mat P,
                                 void *context)
  {
    auto &stepper = *static_cast<Stepper *>(context);
    ConstArray u, rate;
    PetscFunctionBeginUser;
    if (stepper.old_matrix_will_do()) PetscFunctionReturn(0); // untouched, and so PETSc keeps its factors
    PetscCall(MatZeroEntries(P));
    PetscCall(u.Get(U));
    PetscCall(rate.Get(Udot));
    PetscCall(stepper.system.AddJacobian(stepper.solve(time), u, rate, shift, P));
    PetscCall(MatAssemblyBegin(P, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(P, MAT_FINAL_ASSEMBLY));
    if (A != P) {
      PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
      PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
    }
    PetscFunctionReturn(0);
  }

  /// After each solve.
  static PetscErrorCode PostStage(TS ts, PetscReal, PetscInt, Vec *)
  {
    Stepper *stepper;
    SNES snes;
    SNESConvergedReason reason;
    PetscFunctionBeginUser;
    PetscCall(TSGetSNES(ts, &snes));
    PetscCall(SNESGetConvergedReason(snes, &reason));
    if (reason > 0) PetscFunctionReturn(0);
    PetscCall(TSGetApplicationContext(ts, &stepper));
    PetscCall(stepper->TakeFailure(snes));
    PetscFunctionReturn(0);
  }

  /// After a step that TS accepted. TS also calls this once for a step that failed for good: then time stands
  /// still.
  static PetscErrorCode PostStep(TS ts)
  {
    Stepper *stepper;
    PetscReal time;
    Vec U;
    PetscFunctionBeginUser;
    PetscCall(TSGetApplicationContext(ts, &stepper));
    PetscCall(TSGetTime(ts, &time));
    PetscCall(TSGetSolution(ts, &U));
    // t + (t_end - t) can miss t_end by a rounding: the phase has ended all the same.
    const double end = stepper->phase().end_time;
    if (time != end && std::abs(time - end) <= 4 * std::numeric_limits<double>::epsilon() * end) {
      time = end;
      PetscCall(TSSetTime(ts, end));
      PetscCall(TSSetConvergedReason(ts, TS_CONVERGED_TIME));
    }
    if (time > stepper->state.time) PetscCall(stepper->AcceptStep(time, U));
    PetscFunctionReturn(0);
  }
};

PetscErrorCode Stepper::Predict(Vec U)
{
  PetscFunctionBeginUser;
  if (contact) contact->BeginAttempt();
  if (stage.index == 0 && state.time > 0) direct_solver.Forget();
  if (stages() == 2)
    PetscCall(PredictStage(U));
  else
    PetscCall(PredictEuler(U));
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::Converged(SNES snes, PetscInt iteration, PetscReal norm, SNESConvergedReason *reason)
{
  PetscInt most;
  PetscReal tolerance;
  Vec F;
  bool converged;
  PetscFunctionBeginUser;
  const double ratio_before = worst.ratio;
  *reason = SNES_CONVERGED_ITERATING;
  contraction = std::numeric_limits<double>::infinity();
  if (PetscIsInfOrNanReal(norm)) {
    *reason = SNES_DIVERGED_FNORM_NAN;
    PetscFunctionReturn(0);
  }
  PetscCall(SNESGetFunction(snes, &F, nullptr, nullptr));
  PetscCall(SNESGetTolerances(snes, nullptr, &tolerance, nullptr, &most, nullptr));
  PetscCall(system.JudgeResidual(F, tolerance, iteration > 0, worst, converged));
  if (converged)
    *reason = SNES_CONVERGED_FNORM_RELATIVE;
  else if (iteration >= most)
    *reason = SNES_DIVERGED_MAX_IT;
  else if (iteration > 0)
    contraction = worst.ratio / ratio_before;
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::RegisterCallbacks()
{
  SNES snes;
  PetscFunctionBeginUser;
  PetscCall(DMTSSetBoundaryLocal(mesh.dm, StepperCallbacks::Boundary, this));
  PetscCall(DMTSSetIFunctionLocal(mesh.dm, StepperCallbacks::Residual, this));
  PetscCall(DMTSSetIJacobianLocal(mesh.dm, StepperCallbacks::Jacobian, this));
  PetscCall(TSSetApplicationContext(ts, this));
  PetscCall(TSSetPreStep(ts, StepperCallbacks::PreStep));
  PetscCall(TSSetPostStage(ts, StepperCallbacks::PostStage));
  PetscCall(TSSetPostStep(ts, StepperCallbacks::PostStep));
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESSetApplicationContext(snes, this));
  PetscCall(SNESSetComputeInitialGuess(snes, StepperCallbacks::Predict, this));
  PetscCall(SNESSetUpdate(snes, StepperCallbacks::StartIteration));
  PetscCall(SNESSetConvergenceTest(snes, StepperCallbacks::Converged, this, nullptr));
  PetscFunctionReturn(0);
}

} // namespace tribogel
