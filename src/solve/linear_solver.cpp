/// The linear solver under Newton: a direct one unless options say otherwise.
#include "solve/problem.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

constexpr PetscInt workspace_reserve = 14; ///< MUMPS's ICNTL of that name [%]

/// Unknowns in space up to which MUMPS is faster than multigrid on one core, by the elements' order. CPU seconds of a
/// Newton iteration, MUMPS and multigrid: order 1 (paper's scene) 0.5 and 0.6 at 7,500 unknowns, 6.8 and 2.6 at 42,500;
/// order 2 (two_cylinders.opts) 4.4 and 7.7 at 37,700, whence the border by the powers 1.8 and 1.05 of the unknowns.
constexpr PetscInt direct_up_to[] = {20000, 75000};

constexpr double largest_tolerance = 0.1; ///< of the linear solver; also for the first Newton iteration
constexpr double below_newton = 0.1;      ///< how far below Newton's own tolerance no linear solve need go
constexpr double transient_tolerance = 1e-5;
constexpr PetscInt gmres_restart = 60, most_iterations = 400;

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

/// A direct solver in the half plane and for small bodies, multigrid for larger ones, but not where nodes are held in
/// some directions only (no rigid motions to coarsen by; a punch with K/G = 1000 and planes of symmetry failed).
/// Options have the last word.
PetscErrorCode Problem::SetUpLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscFunctionBeginUser;
  PetscCall(RegisterContactPc());
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  const bool whole_nodes = scene.has_top && scene.plate_bond == PlateBond::glued;
  if (mesh.dim == 3 && whole_nodes && mesh.unknowns > direct_up_to[mesh.order - 1]) {
    PetscCall(PCSetType(pc, contact_pc));
    PetscCall(KSPSetType(ksp, KSPGMRES));
    PetscCall(KSPSetPCSide(ksp, PC_RIGHT)); // its residual is Newton's
    PetscCall(KSPGMRESSetRestart(ksp, gmres_restart));
    PetscCall(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
    PetscFunctionReturn(0);
  }
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(PCSetType(pc, PCLU));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(0);
}

/// Eisenstat and Walker's second choice [SIAM J. Sci. Comput. 17 (1996) 16], eq. (2.6) with their safeguard (gamma =
/// 0.9, alpha = golden ratio): the linear residual falls as Newton's has fallen; but not further than is of use to
/// Newton's test. PETSc's own version does not know where Newton stops, and its last solve goes a decade or two too
/// far.
PetscErrorCode Problem::ChooseTolerance(KSP ksp)
{
  constexpr double gamma = 0.9, alpha = 1.618033988749895, strict = 0.1;
  SNES snes;
  PetscInt iteration;
  PetscReal norm;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetIterationNumber(snes, &iteration));
  PetscCall(SNESGetFunctionNorm(snes, &norm));
  double tolerance = largest_tolerance;
  if (iteration > 0) {
    tolerance = gamma * std::pow(norm / forcing.norm, alpha);
    const double no_less = gamma * std::pow(forcing.tolerance, alpha);
    if (no_less > strict) tolerance = std::max(tolerance, no_less);
    tolerance = std::max(tolerance, below_newton / worst.ratio);
    tolerance = std::min(tolerance, largest_tolerance);
  }
  forcing = {norm, tolerance};
  PetscCall(KSPSetTolerances(ksp, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(0);
}

/// When the options have been read. Iterative solvers have Eisenstat and Walker's tolerance, unless options say
/// otherwise. It lets Newton stop barely below its tolerance, which is enough for a steady state. Estimates of the
/// error of short steps see that as noise (a gel pressed by 0.2 mm: 1118 steps for 12), and so transients have a fixed
/// tolerance with which Newton ends as far below as with exact solves. (Where the steps' length is given there is no
/// such estimate: two_cylinders.opts, 37,707 unknowns, took 17 linear iterations a Newton iteration, but 32 of these
/// for three of its four steps, where exact solves need 34 for all.)
PetscErrorCode Problem::HookLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscBool direct, given[2];
  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(pc), &direct, PCLU, PCCHOLESKY, ""));
  if (direct) {
    PetscCall(KSPSetPreSolve(ksp, Factorise, nullptr));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-ksp_rtol", &given[0]));
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-snes_ksp_ew", &given[1]));
  if (given[0] || given[1]) PetscFunctionReturn(0);
  if (!steady()) {
    PetscCall(KSPSetTolerances(ksp, transient_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscFunctionReturn(0);
  }
  const auto choose = [](KSP solver, Vec, Vec, void *problem) {
    return static_cast<Problem *>(problem)->ChooseTolerance(solver);
  };
  PetscCall(KSPSetPreSolve(ksp, choose, this));
  PetscFunctionReturn(0);
}

} // namespace tribogel
