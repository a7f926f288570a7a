/// A Stepper made ready: PETSc's TS, SNES and KSP, their options, the matrix.
#include "time/stepper.hpp"

#include "support/petsc_arrays.hpp"
#include "time/rejections.hpp"

#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tribogel
{

PetscErrorCode Stepper::SetUp()
{
  PetscFunctionBeginUser;
  PetscCall(events.Register());
  PetscCall(DMCreateGlobalVector(mesh.dm, state.U.put()));
  for (VecHandle *v : {&state.Udot, &state.Udot_before, &before, &stage.U})
    PetscCall(VecDuplicate(state.U, v->put()));
  for (Vec v : {static_cast<Vec>(state.U), static_cast<Vec>(state.Udot), static_cast<Vec>(state.Udot_before),
                static_cast<Vec>(before)})
    PetscCall(VecZeroEntries(v));
  state.history = system.bulk->InitialHistory();
  if (contact) state.friction_history = contact->InitialHistory();
  PetscCall(SetUpTs());
  PetscCall(RegisterCallbacks());
  PetscCall(SetFromOptions());
  PetscCall(BuildMatrix());
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::SetUpTs()
{
  SNES snes;
  SNESLineSearch search;
  TSAdapt adapt;
  PetscFunctionBeginUser;
  PetscCall(TSCreate(system.comm(), ts.put()));
  PetscCall(TSSetDM(ts, mesh.dm));
  PetscCall(TSSetProblemType(ts, TS_NONLINEAR));
  PetscCall(TSSetEquationType(ts, TS_EQ_DAE_IMPLICIT_INDEX1));
  PetscCall(SetStageType(ts, *this));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  PetscCall(TSSetMaxSteps(ts, PETSC_MAX_INT));
  PetscCall(TSSetMaxSNESFailures(ts, -1)); // the limit is per step, below
  PetscCall(TSSetMaxStepRejections(ts, most_rejections));
  PetscCall(TSSetErrorIfStepFails(ts, PETSC_FALSE));
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

PetscErrorCode Stepper::SetFromOptions()
{
  PetscBool given, agrees;
  PetscFunctionBeginUser;
  TSAdapt adapt;
  SNES snes;
  PetscCall(TSSetFromOptions(ts));
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(HookLinearSolver(snes));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptGetStepLimits(adapt, nullptr, &given_longest_step));
  const MPI_Comm comm = system.comm();
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(static_cast<TS>(ts)), stage_ts, &agrees));
  PetscCheck(agrees, comm, PETSC_ERR_USER_INPUT,
             "-ts_type: the internal variables and the sliding velocity follow -maxwell_integrator; allowed: "
             "nothing");
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-ts_max_time", &given));
  PetscCheck(!given, comm, PETSC_ERR_USER_INPUT,
             "-ts_max_time: the schedule ends the run; use -schedule_end_times");
  PetscCall(PetscOptionsGetReal(nullptr, nullptr, "-ts_dt", &given_first_step, &given));
  PetscCheck(!given || given_first_step > 0, comm, PETSC_ERR_USER_INPUT,
             "-ts_dt: the first step of a phase must be longer than 0 s");
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::BuildMatrix()
{
  SNES snes;
  KSP ksp;
  Mat matrix;
  PetscFunctionBeginUser;
  contraction = std::numeric_limits<double>::infinity(); // there is no old matrix
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetKSP(snes, &ksp));
  // An old matrix and its factors go first: two would not fit where one does.
  PetscCall(MatCreate(system.comm(), &matrix));
  PetscCall(KSPReset(ksp));
#ifdef __GLIBC__
  // Open MPI tells malloc to keep what is freed, and the old factors would lie beside the new: 2.09 GB
  // for 1.43.
  malloc_trim(0);
#endif
  *jacobian.put() = matrix;
  PetscCall(TSSetIJacobian(ts, matrix, matrix, nullptr, nullptr)); // null: the DM's callback stays
  PetscCall(system.SetUpMatrix(matrix));
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::ProbeSolver()
{
  SNES snes;
  KSP ksp;
  Vec zero, x;
  PetscBool chooses_tolerance;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetKSP(snes, &ksp));
  {
    LocalVector U, Udot;
    ConstArray u, rate;
    PetscCall(U.Get(mesh.dm));
    PetscCall(Udot.Get(mesh.dm));
    PetscCall(LocalState(U, Udot));
    PetscCall(u.Get(U));
    PetscCall(rate.Get(Udot));
    PetscCall(MatZeroEntries(jacobian));
    PetscCall(system.AddJacobian(solve(state.time), u, rate, 1 / phase().duration(), jacobian));
    PetscCall(MatAssemblyBegin(jacobian, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(jacobian, MAT_FINAL_ASSEMBLY));
  }
  PetscCall(VecDuplicate(state.U, &zero));
  PetscCall(VecDuplicate(state.U, &x));
  PetscCall(VecZeroEntries(zero));
  PetscCall(KSPSetOperators(ksp, jacobian, jacobian));
  PetscCall(SNESKSPGetUseEW(snes, &chooses_tolerance));
  PetscCall(SNESKSPSetUseEW(snes, PETSC_FALSE)); // asks for the residual of a solve that there is not
  PetscCall(KSPSolve(ksp, zero, x));
  PetscCall(SNESKSPSetUseEW(snes, chooses_tolerance));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&zero));
  PetscFunctionReturn(0);
}

} // namespace tribogel
