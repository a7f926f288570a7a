/// The linear solver under Newton: a direct one unless options say otherwise.
#include "time/stepper.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

/// Unknowns in space up to which a direct solver is the default. CPU seconds with kept factors and with
/// multigrid, one load of the paper's scene, order 1: 7.7 and 21 at 18,400 unknowns, 20 and 38 at 45,400, 55
/// and 71 at 81,000, 161 and 113 at 145,000; order 2: 7.5 and 62 at 15,000, 99 and 217 at 86,000, 194 and 327
/// at 138,000. Memory is what bounds the direct solver: 5.0 and 6.5 GB in the last cases, where multigrid
/// takes 1.0 and 2.8.
PetscInt direct_up_to(int order)
{
  return order == 1 ? 100000 : 150000;
}

constexpr double largest_tolerance = 0.1; ///< of the linear solver; also for the first Newton iteration
constexpr double below_newton = 0.1;      ///< how far below Newton's own tolerance no linear solve need go

constexpr PetscInt gmres_restart = 60, most_iterations = 400;

/// What a factorisation costs, in solves with its factors: 12 in the half plane (12,700 unknowns, order 2),
/// 44 and 83 in space (two_cylinders.opts, order 2, 6,219 and 37,707 unknowns), whence these powers.
PetscInt factorisation_cost(const Mesh &mesh)
{
  return static_cast<PetscInt>((mesh.dim == 3 ? 2.4 : 0.5) * std::cbrt(mesh.unknowns));
}

} // namespace

/// A direct solver in the half plane and for small bodies, multigrid for larger ones, but not where nodes are
/// held in some directions only (no rigid motions to coarsen by; a punch with K/G = 1000 and planes of
/// symmetry failed). Options have the last word.
PetscErrorCode Stepper::SetUpLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscFunctionBeginUser;
  PetscCall(RegisterContactPc());
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  const bool whole_nodes = scene.has_contact() && scene.plate_bond == PlateBond::glued;
  const bool multigrid =
      mesh.dim == 3 && whole_nodes && mesh.unknowns > direct_up_to(scene.mesh.element_order);
  PetscCall(KSPSetType(ksp, multigrid ? KSPGMRES : mesh.dim == 3 ? KSPFGMRES : KSPPREONLY));
  PetscCall(KSPGMRESSetRestart(ksp, gmres_restart)); // of whichever GMRES
  if (multigrid) {
    PetscCall(PCSetType(pc, contact_pc));
    PetscCall(KSPSetPCSide(ksp, PC_RIGHT)); // its residual is Newton's
    PetscCall(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
  } else {
    PetscCall(PCSetType(pc, PCLU));
    PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  }
  PetscFunctionReturn(0);
}

namespace
{

/// Eisenstat and Walker's second choice [SIAM J. Sci. Comput. 17 (1996) 16], eq. (2.6) with their safeguard
/// (gamma = 0.9, alpha = golden ratio): the linear residual falls as Newton's has fallen; but not further
/// than is of use to Newton's test. PETSc's own version does not know where Newton stops, and its last solve
/// goes a decade or two too far. `fallen`: of Newton's residual in its last iteration; `before`: the
/// tolerance of that; `over`: of the residual over what Newton's test allows.
double loose_tolerance(double fallen, double before, double over)
{
  constexpr double gamma = 0.9, alpha = 1.618033988749895, strict = 0.1;
  double tolerance = gamma * std::pow(fallen, alpha);
  const double no_less = gamma * std::pow(before, alpha);
  if (no_less > strict) tolerance = std::max(tolerance, no_less);
  return std::min(std::max(tolerance, below_newton / over), largest_tolerance);
}

/// A hundredth of what Newton's method is going to leave when it converges quadratically: it ends as far
/// below its tolerance as with exact solves.
double strict_tolerance(double fallen)
{
  constexpr double fraction = 0.01, least = 1e-6;
  return std::clamp(fraction * fallen * fallen, least, fraction);
}

constexpr double first_strict_tolerance =
    1e-4; ///< predictors of short steps leave a single good iteration to Newton

} // namespace

PetscErrorCode Stepper::ChooseTolerance(SNES snes)
{
  KSP ksp;
  PetscInt iteration;
  PetscReal norm;
  PetscFunctionBeginUser;
  if (forcing.rule == Forcing::given) PetscFunctionReturn(0);
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESGetIterationNumber(snes, &iteration));
  PetscCall(SNESGetFunctionNorm(snes, &norm));
  const bool strict = forcing.rule == Forcing::strict;
  double tolerance = strict ? first_strict_tolerance : largest_tolerance;
  if (iteration > 0) {
    const double fallen = norm / forcing.norm;
    tolerance = strict ? strict_tolerance(fallen) : loose_tolerance(fallen, forcing.tolerance, worst.ratio);
  }
  forcing.norm = norm;
  forcing.tolerance = tolerance;
  PetscCall(KSPSetTolerances(ksp, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(0);
}

/// When the options have been read. Unless they say otherwise, steady states under multigrid have Eisenstat
/// and Walker's tolerance. It lets Newton stop barely below its own, which is enough for a steady state.
/// Estimates of the error of short steps see that as noise (a gel pressed by 0.2 mm: 1118 steps for 12), and
/// so transients have a strict one. (Where the steps' length is given there is no such estimate:
/// two_cylinders.opts, 37,707 unknowns, took 17 linear iterations a Newton iteration, but 32 of these for
/// three of its four steps, where exact solves need 34 for all.)
PetscErrorCode Stepper::HookLinearSolver(SNES snes)
{
  KSP ksp;
  PC pc;
  PetscBool direct, given[2];
  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(pc), &direct, PCLU, PCCHOLESKY, ""));
  if (direct) PetscCall(direct_solver.HookInto(ksp, factorisation_cost(mesh)));
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-ksp_rtol", &given[0]));
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-snes_ksp_ew", &given[1]));
  if (given[0] || given[1]) PetscFunctionReturn(0);
  forcing.rule = direct || !system.steady() ? Forcing::strict : Forcing::loose;
  PetscFunctionReturn(0);
}

} // namespace tribogel
