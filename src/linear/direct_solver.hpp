/// LU under Newton, with factors that outlive their matrix.
#pragma once

#include <petscksp.h>

namespace tribogel
{

/// With `-ksp_type preonly` every new matrix is factorised. With `fgmres` the factors of an old one are the
/// preconditioner for as long as that pays: between two Newton iterations, and the stages of a step, a matrix
/// changes little but for what begins and ceases to be held.
class DirectSolver
{
public:
  /// `ksp` has its options; its preconditioner is LU or Cholesky's. This must outlive its solves. `cost`: of
  /// a factorisation, in solves with its factors.
  PetscErrorCode HookInto(KSP ksp, PetscInt cost);

  /// The next solve has new factors: what a step gives must not depend on what the run did before it.
  void Forget() { matrix = 0; }

  PetscInt factorisations() const { return count; } ///< with what failed

private:
  static PetscErrorCode BeforeSolve(KSP, Vec, Vec, void *solver);
  static PetscErrorCode BeforeIteration(KSP, PetscInt total, PetscInt since_restart, PetscReal, void *solver);
  static PetscErrorCode AfterSolve(KSP, Vec, Vec, void *solver);
  PetscErrorCode Renew(KSP ksp);
  PetscErrorCode Factorise(KSP ksp);
  bool pay() const; ///< the factors at hand

  bool keeps = false; ///< factors, as -ksp_type says
  PetscInt cost = 0, count = 0;
  PetscObjectId matrix = 0; ///< of these factors, 0: none to keep
  struct {
    PetscInt solves = 0, iterations = 0, last = 0; ///< with these factors
  } since;
  PetscInt renewed_at = 0; ///< iteration of the solve at hand
};

} // namespace tribogel
