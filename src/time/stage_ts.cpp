#include "time/stage_ts.hpp"

#include "support/petsc_handles.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <petsc/private/tsimpl.h> // PETSc 3.18 has no other way to add a type

#include <memory>

namespace tribogel
{

namespace
{

/// Vectors of the step at hand: U_n, the stage's solution and rate, and where the rate is counted from.
struct StageData {
  StageOwner *owner = nullptr;
  VecHandle before, U, rate, base;
  double shift = 0; ///< d rate/dU [1/s]
  double time = 0;  ///< of the stage [s]
};

StageData &data_of(TS ts)
{
  return *static_cast<StageData *>(ts->data);
}

PetscErrorCode SetUp(TS ts)
{
  StageData &data = data_of(ts);
  PetscFunctionBegin;
  for (VecHandle *v : {&data.before, &data.U, &data.rate, &data.base})
    if (!static_cast<Vec>(*v)) PetscCall(VecDuplicate(ts->vec_sol, v->put()));
  PetscCall(TSGetAdapt(ts, &ts->adapt));
  PetscCall(TSAdaptCandidatesClear(ts->adapt));
  PetscCall(TSGetSNES(ts, &ts->snes));
  ts->stifflyaccurate = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode Reset(TS ts)
{
  PetscFunctionBegin;
  StageData &data = data_of(ts);
  StageOwner *const owner = data.owner;
  data = {};
  data.owner = owner;
  PetscFunctionReturn(0);
}

PetscErrorCode Destroy(TS ts)
{
  PetscFunctionBegin;
  delete static_cast<StageData *>(ts->data);
  ts->data = nullptr;
  PetscFunctionReturn(0);
}

PetscErrorCode StageFunction(SNES, Vec U, Vec F, TS ts)
{
  StageData &data = data_of(ts);
  PetscFunctionBegin;
  PetscCall(VecAXPBYPCZ(data.rate, data.shift, -data.shift, 0, U, data.base));
  PetscCall(TSComputeIFunction(ts, data.time, U, data.rate, F, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/// At the U, and so with the rate, of the last StageFunction: SNES guarantees it.
PetscErrorCode StageJacobian(SNES, Vec U, Mat A, Mat P, TS ts)
{
  StageData &data = data_of(ts);
  PetscFunctionBegin;
  PetscCall(TSComputeIJacobian(ts, data.time, U, data.rate, data.shift, A, P, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/// From data.base to data.time, with data.U as what is known of it.
PetscErrorCode SolveStage(TS ts, int stage, PetscBool &solved)
{
  StageData &data = data_of(ts);
  PetscInt newton, linear;
  PetscFunctionBegin;
  PetscCall(SNESSolve(ts->snes, nullptr, data.U));
  PetscCall(SNESGetIterationNumber(ts->snes, &newton));
  PetscCall(SNESGetLinearSolveIterations(ts->snes, &linear));
  ts->snes_its += newton;
  ts->ksp_its += linear;
  Vec end = data.U;
  PetscCall(TSPostStage(ts, data.time, stage, &end));
  PetscCall(TSAdaptCheckStage(ts->adapt, ts, data.time, data.U, &solved));
  PetscFunctionReturn(0);
}

PetscErrorCode SolveStages(TS ts, PetscBool &solved)
{
  StageData &data = data_of(ts);
  StageOwner &owner = *data.owner;
  const int stages = owner.stages();
  bool rings;
  PetscFunctionBegin;
  const double length = stages == 2 ? sdirk2::gamma * ts->time_step : ts->time_step;
  data.shift = 1 / length;
  PetscCall(VecCopy(data.before, data.base));
  for (int stage = 0; stage < stages; ++stage) {
    data.time = ts->ptime + (stage == 0 ? length : ts->time_step);
    if (stage == 1) // U_n + reach (U_1 - U_n)
      PetscCall(VecAXPBYPCZ(data.base, sdirk2::reach, 1 - sdirk2::reach, 0, data.U, data.before));
    PetscCall(owner.BeginStage(stage, data.time));
    PetscCall(SolveStage(ts, stage, solved));
    if (!solved) PetscFunctionReturn(0);
    PetscCall(owner.EndStage(stage, data.U));
  }
  if (stages == 1) PetscFunctionReturn(0);
  PetscCall(owner.Rings(rings));
  if (!rings) PetscFunctionReturn(0);
  PetscCall(owner.DampStage(data.base));
  data.shift = 1 / (ts->time_step - length);
  PetscCall(SolveStage(ts, 1, solved));
  PetscFunctionReturn(0);
}

PetscErrorCode Step(TS ts)
{
  StageData &data = data_of(ts);
  PetscInt rejections = 0;
  PetscBool accepted = PETSC_TRUE; // what TSAdapt wants to know: no attempt has failed yet
  PetscFunctionBegin;
  PetscCall(VecCopy(ts->vec_sol, data.before));
  while (!ts->reason) {
    PetscBool solved;
    PetscReal next = ts->time_step;
    PetscCall(SolveStages(ts, solved));
    if (solved) {
      PetscCall(VecCopy(data.U, ts->vec_sol));
      PetscCall(TSAdaptChoose(ts->adapt, ts, ts->time_step, nullptr, &next, &accepted));
      if (accepted) {
        ts->ptime += ts->time_step;
        ts->time_step = next;
        break;
      }
      PetscCall(
          VecCopy(data.before, ts->vec_sol)); // all else that evolves is in State, which nothing has touched
      ts->time_step = next;
    }
    accepted = PETSC_FALSE;
    ++ts->reject;
    if (!ts->reason && ++rejections > ts->max_reject && ts->max_reject >= 0)
      ts->reason = TS_DIVERGED_STEP_REJECTED;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode RollBack(TS ts)
{
  PetscFunctionBegin;
  PetscCall(VecCopy(data_of(ts).before, ts->vec_sol));
  PetscFunctionReturn(0);
}

PetscErrorCode EvaluateError(TS ts, NormType, PetscInt *order, PetscReal *error)
{
  PetscFunctionBegin;
  if (order) *order = 2; // the power of the step with which the error grows
  PetscCall(data_of(ts).owner->EstimateError(*error));
  PetscFunctionReturn(0);
}

PetscErrorCode Create(TS ts)
{
  PetscFunctionBegin;
  ts->ops->setup = SetUp;
  ts->ops->reset = Reset;
  ts->ops->destroy = Destroy;
  ts->ops->step = Step;
  ts->ops->rollback = RollBack;
  ts->ops->evaluatewlte = EvaluateError;
  ts->ops->snesfunction = StageFunction;
  ts->ops->snesjacobian = StageJacobian;
  ts->default_adapt_type = TSADAPTBASIC;
  ts->usessnes = PETSC_TRUE;
  ts->data = std::make_unique<StageData>().release();
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode SetStageType(TS ts, StageOwner &owner)
{
  PetscFunctionBegin;
  PetscCall(TSRegister(stage_ts, Create));
  PetscCall(TSSetType(ts, stage_ts));
  data_of(ts).owner = &owner;
  PetscFunctionReturn(0);
}

PetscInt rejections_allowed(TS ts)
{
  return ts->max_reject;
}

} // namespace tribogel
