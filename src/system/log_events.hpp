/// What -log_view shows of the program's own work.
#pragma once

#include <petscsys.h>

namespace tribogel
{

struct LogEvents {
  PetscLogEvent mesh = 0, bulk_residual = 0, bulk_jacobian = 0, contact_residual = 0, contact_jacobian = 0;
  PetscLogEvent accept_step = 0, observe = 0, checkpoint = 0;

  PetscErrorCode Register()
  {
    PetscClassId id;
    PetscFunctionBeginUser;
    PetscCall(PetscClassIdRegister("tribogel", &id));
    PetscCall(PetscLogEventRegister("GelMesh", id, &mesh));
    PetscCall(PetscLogEventRegister("GelBulkResidual", id, &bulk_residual));
    PetscCall(PetscLogEventRegister("GelBulkJacobian", id, &bulk_jacobian));
    PetscCall(PetscLogEventRegister("GelContactResid", id, &contact_residual));
    PetscCall(PetscLogEventRegister("GelContactJacob", id, &contact_jacobian));
    PetscCall(PetscLogEventRegister("GelAcceptStep", id, &accept_step));
    PetscCall(PetscLogEventRegister("GelObserve", id, &observe));
    PetscCall(PetscLogEventRegister("GelCheckpoint", id, &checkpoint));
    PetscFunctionReturn(0);
  }
};

} // namespace tribogel
