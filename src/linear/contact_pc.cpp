#include "linear/contact_pc.hpp"

#include <petsc/private/pcimpl.h> // PETSc 3.18 has no other way to add a type

namespace tribogel
{

namespace
{

constexpr const char *attached = "tribogel contact unknowns";

using Shared = std::shared_ptr<const ContactUnknowns>;

struct ContactPc {
  Condensation condensation;
  VecHandle g, y;     ///< of the reduced system
  MatHandle vertices; ///< the reduced matrix for fields of order 1, where multigrid begins with these
  KspHandle inner;
};

ContactPc &data_of(PC pc)
{
  return *static_cast<ContactPc *>(pc->data);
}

/// Fields of order 2 go to fields of order 1 on the same cells first, and these to a multigrid that knows
/// nothing of cells. Smoothed aggregation alone takes the many small entries of order 2 for a mesh of its
/// own: two_cylinders.opts, 37,707 unknowns: 55 iterations to 1e-5.
PetscErrorCode BeginWithVertices(PC method, const ContactUnknowns &unknowns)
{
  KSP coarse, smoother;
  PC of_level;
  PetscFunctionBegin;
  PetscCall(PCSetType(method, PCMG));
  PetscCall(PCMGSetLevels(method, 2, nullptr));
  PetscCall(PCMGSetGalerkin(method, PC_MG_GALERKIN_NONE));
  PetscCall(PCMGSetInterpolation(method, 1, unknowns.from_vertices));
  PetscCall(PCMGGetSmoother(method, 1, &smoother));
  PetscCall(KSPSetType(smoother, KSPCHEBYSHEV));
  PetscCall(KSPGetPC(smoother, &of_level));
  PetscCall(PCSetType(of_level, PCJACOBI));
  PetscCall(PCMGGetCoarseSolve(method, &coarse));
  PetscCall(KSPSetType(coarse, KSPPREONLY));
  PetscCall(KSPGetPC(coarse, &of_level));
  PetscCall(PCSetType(of_level, PCGAMG));
  PetscFunctionReturn(0);
}

/// A new inner solver for a new matrix: PETSc 3.18's multigrid, once set up, takes no coarse levels of other
/// sizes, not even after a reset.
PetscErrorCode CreateInner(PC pc, const ContactUnknowns &unknowns)
{
  const KspHandle &inner = data_of(pc).inner;
  const char *prefix;
  PC method;
  PetscFunctionBegin;
  PetscCall(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(pc)), data_of(pc).inner.put()));
  PetscCall(PetscObjectIncrementTabLevel(reinterpret_cast<PetscObject>(static_cast<KSP>(inner)),
                                         reinterpret_cast<PetscObject>(pc), 1));
  PetscCall(KSPSetErrorIfNotConverged(inner, pc->erroriffailure));
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(KSPSetOptionsPrefix(inner, prefix));
  PetscCall(KSPAppendOptionsPrefix(inner, "condensed_"));
  PetscCall(KSPSetType(inner, KSPPREONLY));
  PetscCall(KSPGetPC(inner, &method));
  if (static_cast<Mat>(unknowns.from_vertices))
    PetscCall(BeginWithVertices(method, unknowns));
  else
    PetscCall(PCSetType(method, PCGAMG));
  PetscCall(KSPSetFromOptions(inner));
  PetscFunctionReturn(0);
}

/// The reduced matrix for fields of order 1, of this S. Nothing if options chose another solver.
PetscErrorCode UpdateVertices(PC pc, const ContactUnknowns &unknowns)
{
  ContactPc &data = data_of(pc);
  PC method;
  KSP coarse;
  PetscBool multigrid;
  PetscFunctionBegin;
  PetscCall(KSPGetPC(data.inner, &method));
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(method), PCMG, &multigrid));
  if (!multigrid || !static_cast<Mat>(unknowns.from_vertices)) PetscFunctionReturn(0);
  Mat old = data.vertices;
  const bool anew = !old;
  PetscCall(MatPtAP(data.condensation.reduced(), unknowns.from_vertices,
                    anew ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT,
                    anew ? data.vertices.put() : &old));
  if (anew) {
    MatNullSpace rigid;
    PetscCall(MatNullSpaceCreateRigidBody(unknowns.vertex_place, &rigid));
    PetscCall(MatSetNearNullSpace(data.vertices, rigid));
    PetscCall(MatNullSpaceDestroy(&rigid));
  }
  PetscCall(PCMGGetCoarseSolve(method, &coarse));
  PetscCall(KSPSetOperators(coarse, data.vertices, data.vertices));
  PetscFunctionReturn(0);
}

/// Of a multigrid; 0 of anything else.
PetscErrorCode CountLevels(PC method, PetscInt &levels)
{
  PetscBool multigrid;
  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompareAny(reinterpret_cast<PetscObject>(method), &multigrid, PCGAMG, PCMG, ""));
  levels = 0;
  if (multigrid) PetscCall(PCMGGetLevels(method, &levels));
  PetscFunctionReturn(0);
}

/// PETSc smooths with two Chebyshev steps. Nearly incompressible gels gain by more: with K/G = 144 three take
/// 26 outer iterations a Newton iteration where two take 36, in the same time and with fewer vectors.
PetscErrorCode SmoothMore(PC method)
{
  constexpr PetscInt chebyshev_steps = 3;
  PetscInt levels;
  PetscFunctionBegin;
  PetscCall(CountLevels(method, levels));
  for (PetscInt level = 1; level < levels; ++level) {
    KSP smoother;
    PetscCall(PCMGGetSmoother(method, level, &smoother));
    PetscCall(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, chebyshev_steps));
    PetscCall(KSPSetFromOptions(smoother));
  }
  PetscFunctionReturn(0);
}

/// Products with the levels' matrices row by row. PETSc 3.18's default, rows of the same pattern at a time
/// ("inodes"), fetches the next rows past the caches that would hold them: the paper's scene, K/G = 144,
/// spends 10 s in products for 6 (18,400 unknowns, order 1), 42 for 23 (9,771 unknowns, order 2). Not where
/// PETSc factorises such rows: on the coarsest level, and where options put another method than Jacobi's into
/// the smoothers.
PetscErrorCode MultiplyRowByRow(PC method)
{
  PetscInt levels;
  KSP solver;
  PC below;
  PetscFunctionBegin;
  PetscCall(CountLevels(method, levels));
  if (levels == 0) PetscFunctionReturn(0);
  for (PetscInt level = 1; level < levels; ++level) {
    Mat of_level;
    PetscBool jacobi;
    PetscCall(PCMGGetSmoother(method, level, &solver));
    PetscCall(KSPGetPC(solver, &below));
    PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(below), PCJACOBI, &jacobi));
    if (!jacobi) continue;
    PetscCall(KSPGetOperators(solver, &of_level, nullptr));
    PetscCall(MatSetOption(of_level, MAT_USE_INODES, PETSC_FALSE));
  }
  PetscCall(PCMGGetCoarseSolve(method, &solver));
  PetscCall(KSPGetPC(solver, &below));
  PetscCall(MultiplyRowByRow(below));
  PetscFunctionReturn(0);
}

PetscErrorCode SetUp(PC pc)
{
  ContactPc &data = data_of(pc);
  PetscContainer container;
  void *shared;
  bool anew;
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery(reinterpret_cast<PetscObject>(pc->pmat), attached,
                             reinterpret_cast<PetscObject *>(&container)));
  PetscCheck(container, PetscObjectComm(reinterpret_cast<PetscObject>(pc)), PETSC_ERR_USER_INPUT,
             "only for -model solid");
  PetscCall(PetscContainerGetPointer(container, &shared));
  const Shared &unknowns = *static_cast<Shared *>(shared);
  PetscCall(data.condensation.Read(pc->pmat, unknowns, anew));
  if (anew) { // two multigrids would not fit beside each other where one does
    data.inner.reset();
    data.vertices.reset();
  }
  PetscCall(data.condensation.Reduce());
  const Mat S = data.condensation.reduced();
  if (anew) {
    PetscCall(CreateInner(pc, *unknowns));
    PetscCall(MatCreateVecs(S, data.y.put(), data.g.put()));
  }
  PetscCall(KSPSetOperators(data.inner, S, S));
  PetscCall(UpdateVertices(pc, *unknowns));
  PetscCall(KSPSetUp(data.inner));
  if (anew) {
    PC method;
    PetscCall(KSPGetPC(data.inner, &method));
    PetscCall(SmoothMore(method));
    PetscCall(MultiplyRowByRow(method));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Apply(PC pc, Vec f, Vec x)
{
  ContactPc &data = data_of(pc);
  KSPConvergedReason reason;
  PetscFunctionBegin;
  PetscCall(data.condensation.Restrict(f, data.g));
  PetscCall(KSPSolve(data.inner, data.g, data.y));
  PetscCall(KSPGetConvergedReason(data.inner, &reason));
  if (reason == KSP_DIVERGED_PC_FAILED) pc->failedreason = PC_SUBPC_ERROR;
  PetscCall(data.condensation.Extend(f, data.y, x));
  PetscFunctionReturn(0);
}

PetscErrorCode View(PC pc, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (static_cast<KSP>(data_of(pc).inner)) PetscCall(KSPView(data_of(pc).inner, viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode Reset(PC pc)
{
  PetscFunctionBegin;
  data_of(pc) = {};
  PetscFunctionReturn(0);
}

PetscErrorCode Destroy(PC pc)
{
  PetscFunctionBegin;
  delete static_cast<ContactPc *>(pc->data);
  pc->data = nullptr;
  PetscFunctionReturn(0);
}

PetscErrorCode Create(PC pc)
{
  PetscFunctionBegin;
  pc->ops->setup = SetUp;
  pc->ops->apply = Apply;
  pc->ops->view = View;
  pc->ops->reset = Reset;
  pc->ops->destroy = Destroy;
  pc->data = std::make_unique<ContactPc>().release();
  PetscFunctionReturn(0);
}

PetscErrorCode Forget(void *shared)
{
  PetscFunctionBegin;
  delete static_cast<Shared *>(shared);
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode RegisterContactPc()
{
  PetscFunctionBegin;
  PetscCall(PCRegister(contact_pc, Create));
  PetscFunctionReturn(0);
}

PetscErrorCode AttachContactUnknowns(Mat A, const std::shared_ptr<const ContactUnknowns> &unknowns)
{
  PetscContainer container;
  PetscFunctionBegin;
  PetscCall(PetscContainerCreate(PetscObjectComm(reinterpret_cast<PetscObject>(A)), &container));
  PetscCall(PetscContainerSetPointer(container, std::make_unique<Shared>(unknowns).release()));
  PetscCall(PetscContainerSetUserDestroy(container, Forget));
  PetscCall(PetscObjectCompose(reinterpret_cast<PetscObject>(A), attached,
                               reinterpret_cast<PetscObject>(container)));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(0);
}

} // namespace tribogel
