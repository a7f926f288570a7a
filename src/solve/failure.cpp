/// A failed solve is named here; TS then cuts the step.
#include "solve/failure.hpp"

#include "solve/problem.hpp"

#include <sstream>

namespace tribogel
{

namespace
{

PetscErrorCode DescribeLinearFailure(SNES snes, std::string &words)
{
  KSP ksp;
  PC pc;
  KSPConvergedReason reason;
  PCFailedReason factor;
  PetscInt iterations;
  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &iterations));
  PetscCall(PCGetFailedReason(pc, &factor));
  if (factor == PC_FACTOR_STRUCT_ZEROPIVOT || factor == PC_FACTOR_NUMERIC_ZEROPIVOT)
    words = "the tangent matrix is singular";
  else if (factor == PC_FACTOR_OUTMEMORY)
    words = "no memory for the factorisation of the matrix";
  else if (factor != PC_NOERROR)
    words = std::string("the preconditioner failed (") + PCFailedReasons[factor] + ")";
  else
    words = std::string("the linear solver stopped after ") + std::to_string(iterations) + " iterations (" +
            KSPConvergedReasons[reason] + "; -ksp_rtol, -ksp_max_it)";
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Problem::Diagnose(SNES snes, StepFailure &failure) const
{
  SNESConvergedReason reason;
  PetscFunctionBeginUser;
  PetscCall(SNESGetConvergedReason(snes, &reason));
  std::ostringstream text;
  if (bulk_failure) {
    failure.kind =
        bulk_failure.status == PointStatus::inverted ? FailureKind::inverted_element : FailureKind::maxwell_update;
    text << describe(bulk_failure);
  } else if (!contact_failure.empty()) {
    failure.kind = FailureKind::contact_search;
    text << contact_failure;
  } else if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    failure.kind = FailureKind::linear_solver;
    PetscCall(DescribeLinearFailure(snes, failure.words));
    PetscFunctionReturn(0);
  } else if (reason == SNES_DIVERGED_FNORM_NAN) {
    failure.kind = FailureKind::not_a_number;
    text << "the residual is not a number";
  } else {
    failure.kind = FailureKind::newton;
    text << "Newton's " << (worst.group >= 0 ? group_names(mesh.dim)[worst.group] : "residual") << " stays at "
         << worst.ratio << " times its tolerance near " << describe_place(mesh.dim, worst.X) << " of the "
         << (worst.body == top_body ? "top" : "bottom") << " gel";
  }
  failure.words = text.str();
  PetscFunctionReturn(0);
}

PetscErrorCode PostStage(TS ts, PetscReal, PetscInt, Vec *)
{
  Problem *problem;
  SNES snes;
  SNESConvergedReason reason;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetConvergedReason(snes, &reason));
  if (reason > 0) PetscFunctionReturn(0);
  PetscCall(TSGetApplicationContext(ts, &problem));
  StepFailure &failure = problem->last_failure;
  failure = {};
  failure.time = problem->state.time;
  PetscCall(TSGetTimeStep(ts, &failure.step));
  PetscCall(problem->Diagnose(snes, failure));
  ++problem->counts.failures[static_cast<std::size_t>(failure.kind)];
  PetscCall(problem->TellFailure());

  // TSAdapt keeps to its smallest step when it chooses one, not when it cuts one.
  TSAdapt adapt;
  PetscReal smallest;
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptGetStepLimits(adapt, &smallest, nullptr));
  if (failure.step <= smallest) PetscCall(TSSetConvergedReason(ts, TS_DIVERGED_STEP_REJECTED));
  PetscFunctionReturn(0);
}

} // namespace tribogel
