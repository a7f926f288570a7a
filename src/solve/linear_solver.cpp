/// The linear solver under Newton: a direct one unless options say otherwise.
#include "solve/problem.hpp"

namespace tribogel
{

namespace
{

constexpr PetscInt workspace_reserve = 14; ///< MUMPS's ICNTL of that name [%]

/// Forgets a factorisation that failed. PETSc 3.18 does not factorise again after MUMPS has reported an error once: it
/// returns the error of old, whatever the matrix has become.
PetscErrorCode ForgetFactor(PC pc)
{
  Mat A, P;
  PetscFunctionBeginUser;
  PetscCall(PCGetOperators(pc, &A, &P));
  for (Mat m : {A, P}) PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(m)));
  PetscCall(PCReset(pc));
  PetscCall(PCSetOperators(pc, A, P));
  for (Mat m : {A, P}) PetscCall(PetscObjectDereference(reinterpret_cast<PetscObject>(m)));
  PetscFunctionReturn(0);
}

/// Before each solve. Contact conditions delay pivots, and MUMPS can run out of the workspace that its analysis foresaw
/// (on 4 ranks 33 of 830 pivots were delayed and its own reserve, 20 %, did not do). Shorter steps do not cure that; a
/// larger reserve does.
PetscErrorCode Factorise(KSP ksp, Vec, Vec, void *)
{
  constexpr int most_doublings = 10;
  PC pc;
  PCFailedReason failure;
  Mat factor;
  MatSolverType package;
  PetscInt reserve;
  PetscBool mumps = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCGetFailedReason(pc, &failure));
  if (failure != PC_NOERROR) PetscCall(ForgetFactor(pc));
  for (int doubling = 0;; ++doubling) {
    PetscCall(PCSetUp(pc));
    PetscCall(PCGetFailedReason(pc, &failure));
    PetscCall(PCFactorGetMatSolverType(pc, &package));
    PetscCall(PetscStrcmp(package, MATSOLVERMUMPS, &mumps));
    if (failure != PC_FACTOR_OUTMEMORY || !mumps || doubling == most_doublings) PetscFunctionReturn(0);
    PetscCall(PCFactorGetMatrix(pc, &factor));
    PetscCall(MatMumpsGetIcntl(factor, workspace_reserve, &reserve));
    PetscCall(ForgetFactor(pc));
    PetscCall(PCFactorSetUpMatSolverType(pc));
    PetscCall(PCFactorGetMatrix(pc, &factor));
    PetscCall(MatMumpsSetIcntl(factor, workspace_reserve, 2 * reserve));
  }
}

} // namespace

PetscErrorCode Problem::SetUpLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscFunctionBeginUser;
  PetscCall(RegisterContactPc());
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCLU));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(0);
}

/// When the options have been read. A linear solver has one hook before each solve; iterative ones have Eisenstat and
/// Walker's choice of the tolerance there.
PetscErrorCode Problem::HookLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscBool direct;
  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(pc), &direct, PCLU, PCCHOLESKY, ""));
  if (direct) PetscCall(KSPSetPreSolve(ksp, Factorise, nullptr));
  PetscFunctionReturn(0);
}

} // namespace tribogel
