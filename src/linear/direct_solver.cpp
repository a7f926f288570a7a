#include "linear/direct_solver.hpp"

namespace tribogel
{

namespace
{

constexpr PetscInt workspace_reserve = 14; ///< MUMPS's ICNTL of that name [%]

constexpr PetscInt most_with_old = 30; ///< iterations of a solve; then factors are renewed within it

/// Forgets a factorisation that failed. PETSc 3.18 does not factorise again after MUMPS has reported an error
/// once: it returns the error of old, whatever the matrix has become.
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

} // namespace

/// Contact conditions delay pivots, and MUMPS can run out of the workspace that its analysis foresaw (on 4
/// ranks 33 of 830 pivots were delayed and its own reserve, 20 %, did not do). Shorter steps do not cure
/// that; a larger reserve does.
PetscErrorCode DirectSolver::Factorise(KSP ksp)
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
    ++count;
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

/// Iterations grow with the factors' age. The mean cost of a solve, factorisation included, is least where
/// the next solve would cost more than that mean.
bool DirectSolver::pay() const
{
  return since.solves == 0 || since.last * since.solves <= cost + since.iterations;
}

PetscErrorCode DirectSolver::Renew(KSP ksp)
{
  Mat P;
  PetscFunctionBeginUser;
  PetscCall(PetscInfo(ksp, "New factors after %d solves in %d iterations with the old ones\n",
                      static_cast<int>(since.solves), static_cast<int>(since.iterations)));
  PetscCall(KSPSetReusePreconditioner(ksp, PETSC_FALSE));
  PetscCall(Factorise(ksp));
  PetscCall(KSPSetReusePreconditioner(ksp, PETSC_TRUE));
  PetscCall(KSPGetOperators(ksp, nullptr, &P));
  PetscCall(PetscObjectGetId(reinterpret_cast<PetscObject>(P), &matrix));
  since = {};
  PetscFunctionReturn(0);
}

PetscErrorCode DirectSolver::BeforeSolve(KSP ksp, Vec, Vec, void *solver)
{
  auto &own = *static_cast<DirectSolver *>(solver);
  PC pc;
  Mat P;
  PCFailedReason failure;
  PetscObjectId id;
  PetscFunctionBeginUser;
  if (!own.keeps) {
    PetscCall(own.Factorise(ksp));
    PetscFunctionReturn(0);
  }
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCGetFailedReason(pc, &failure));
  PetscCall(KSPGetOperators(ksp, nullptr, &P));
  PetscCall(PetscObjectGetId(reinterpret_cast<PetscObject>(P), &id));
  own.renewed_at = 0;
  if (id == own.matrix && failure == PC_NOERROR && own.pay())
    PetscCall(KSPSetReusePreconditioner(ksp, PETSC_TRUE)); // SNES has set it to false
  else
    PetscCall(own.Renew(ksp));
  PetscFunctionReturn(0);
}

/// FGMRES allows for a preconditioner that changes on the way. PETSc 3.18 does not look at what this returns.
PetscErrorCode DirectSolver::BeforeIteration(KSP ksp, PetscInt total, PetscInt, PetscReal, void *solver)
{
  auto &own = *static_cast<DirectSolver *>(solver);
  PetscFunctionBeginUser;
  if (total != most_with_old || own.since.solves == 0) PetscFunctionReturn(0);
  PetscCallAbort(PetscObjectComm(reinterpret_cast<PetscObject>(ksp)), own.Renew(ksp));
  own.renewed_at = total;
  PetscFunctionReturn(0);
}

PetscErrorCode DirectSolver::AfterSolve(KSP ksp, Vec, Vec, void *solver)
{
  auto &own = *static_cast<DirectSolver *>(solver);
  PetscInt iterations;
  PetscFunctionBeginUser;
  PetscCall(KSPGetIterationNumber(ksp, &iterations));
  own.since.last = iterations - own.renewed_at;
  own.since.iterations += own.since.last;
  ++own.since.solves;
  PetscFunctionReturn(0);
}

PetscErrorCode DirectSolver::HookInto(KSP ksp, PetscInt factorisation_cost)
{
  PetscBool flexible;
  PetscFunctionBeginUser;
  cost = factorisation_cost;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ksp), KSPFGMRES, &flexible));
  keeps = flexible == PETSC_TRUE;
  PetscCall(KSPSetPreSolve(ksp, BeforeSolve, this));
  if (!keeps) PetscFunctionReturn(0);
  PetscCall(KSPSetPostSolve(ksp, AfterSolve, this));
  PetscCall(KSPFGMRESSetModifyPC(ksp, BeforeIteration, this, nullptr));
  PetscFunctionReturn(0);
}

} // namespace tribogel
