#include "solve/contact_pc.hpp"

#include <petsc/private/pcimpl.h> // PETSc 3.18 has no other way to add a type

namespace tribogel
{

namespace
{

constexpr const char *attached = "tribogel contact unknowns";

using Shared = std::shared_ptr<const ContactUnknowns>;

struct ContactPc {
  Condensation condensation;
  VecHandle g, y; ///< of the reduced system
  KspHandle inner;
};

ContactPc &data_of(PC pc)
{
  return *static_cast<ContactPc *>(pc->data);
}

PetscErrorCode SetUp(PC pc)
{
  ContactPc &data = data_of(pc);
  PetscContainer container;
  void *shared;
  PetscFunctionBegin;
  PetscCall(
      PetscObjectQuery(reinterpret_cast<PetscObject>(pc->pmat), attached, reinterpret_cast<PetscObject *>(&container)));
  PetscCheck(container, PetscObjectComm(reinterpret_cast<PetscObject>(pc)), PETSC_ERR_USER_INPUT,
             "-pc_type contact: only for -model solid");
  PetscCall(PetscContainerGetPointer(container, &shared));
  PetscCall(data.condensation.SetUp(pc->pmat, **static_cast<Shared *>(shared)));
  const Mat S = data.condensation.reduced();
  PetscCall(KSPSetOperators(data.inner, S, S));
  PetscCall(MatCreateVecs(S, data.y.put(), data.g.put()));
  PetscCall(KSPSetUp(data.inner));
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

PetscErrorCode SetFromOptions(PC pc, PetscOptionItems *)
{
  const char *prefix;
  PetscFunctionBegin;
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(KSPSetOptionsPrefix(data_of(pc).inner, prefix));
  PetscCall(KSPAppendOptionsPrefix(data_of(pc).inner, "condensed_"));
  PetscCall(KSPSetFromOptions(data_of(pc).inner));
  PetscFunctionReturn(0);
}

PetscErrorCode View(PC pc, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(KSPView(data_of(pc).inner, viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode Reset(PC pc)
{
  ContactPc &data = data_of(pc);
  PetscFunctionBegin;
  data.condensation = {};
  data.g.reset();
  data.y.reset();
  PetscCall(KSPReset(data.inner));
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
  auto data = std::make_unique<ContactPc>();
  PC inner;
  PetscFunctionBegin;
  PetscCall(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(pc)), data->inner.put()));
  PetscCall(PetscObjectIncrementTabLevel(reinterpret_cast<PetscObject>(static_cast<KSP>(data->inner)),
                                         reinterpret_cast<PetscObject>(pc), 1));
  PetscCall(KSPSetType(data->inner, KSPPREONLY));
  PetscCall(KSPGetPC(data->inner, &inner));
  PetscCall(PCSetType(inner, PCGAMG));
  pc->ops->setup = SetUp;
  pc->ops->apply = Apply;
  pc->ops->setfromoptions = SetFromOptions;
  pc->ops->view = View;
  pc->ops->reset = Reset;
  pc->ops->destroy = Destroy;
  pc->data = data.release();
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
  PetscCall(PetscObjectCompose(reinterpret_cast<PetscObject>(A), attached, reinterpret_cast<PetscObject>(container)));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(0);
}

} // namespace tribogel
