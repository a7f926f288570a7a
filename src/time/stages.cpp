/// The stages of a step: where they start and what they leave. THEORY 4.4.
#include "support/petsc_arrays.hpp"
#include "time/stepper.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

constexpr double much_longer = 2; ///< a step than the last: its motion does not go on so far

} // namespace

PetscErrorCode Stepper::BeginStage(int index, PetscReal time)
{
  PetscFunctionBeginUser;
  stage.index = index;
  stage.time = time;
  if (index == 0) stage.length = time - state.time;
  stage.damped = false;
  PetscFunctionReturn(0);
}

/// The last stage's end is the step's: it is dealt with when the step is accepted.
PetscErrorCode Stepper::EndStage(int index, Vec U)
{
  SNES snes;
  CellEnergy energy;
  Vec rate;
  PetscFunctionBeginUser;
  if (index + 1 == stages()) PetscFunctionReturn(0);
  PetscCall(VecCopy(U, stage.U));
  PetscCall(system.SumPlateLoads(stage.loads));
  PetscCall(EvaluateEnd(stage.time, stage.history, energy));
  stage.dissipated = sdirk2::reach * energy.dissipated;
  if (!state.friction_history.values.empty()) {
    FrictionMemory memory = friction_memory(stage.time);
    PetscCall(DMGetGlobalVector(mesh.dm, &rate));
    PetscCall(VecWAXPY(rate, -1, before, U));
    PetscCall(VecScale(rate, 1 / stage.length));
    PetscCall(AdvanceFriction(stage.time, memory, U, rate, stage.friction_start));
    memory.weights.reach = 1;
    PetscCall(AdvanceFriction(stage.time, memory, U, rate, stage.friction_end));
    PetscCall(DMRestoreGlobalVector(mesh.dm, &rate));
  }
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetIterationNumber(snes, &stage.newton_iterations));
  PetscCall(SNESGetLinearSolveIterations(snes, &stage.linear_iterations));
  PetscFunctionReturn(0);
}

/// Where a contact gives way much faster than within a step, T is to level off, and (4.4) throws it past its
/// steady value: R(z) < 0 in (4.5). Then, and only then, the rate of a T that levels off changes its sign
/// from the first stage to the second. In steps whose error counts it is the estimate that keeps this below
/// the tolerance.
PetscErrorCode Stepper::Rings(bool &rings) const
{
  constexpr double worth_a_solve = 0.1; // of the tolerance
  constexpr int torque = 1;
  PlateLoads loads;
  PetscReal step, first_step, unresolved, fraction;
  TSAdapt adapt;
  PetscBool fixed;
  PetscFunctionBeginUser;
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(FirstStep(first_step, unresolved));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(adapt), TSADAPTNONE, &fixed));
  PetscCall(system.SumPlateLoads(loads));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  PlateLoads largest = state.largest;
  for (int k = 0; k < 2; ++k)
    largest[k] = std::max({largest[k], std::abs(stage.loads[k]), std::abs(loads[k])});
  const double first = stage.loads[torque] - state.loads[torque];
  const double second = loads[torque] - state.loads[torque] - sdirk2::reach * first;
  const double tolerated = fraction * system.load_scales(largest)[torque] + system.least.loads[torque];
  rings = scene.has_contact() && (fixed || step <= unresolved) && !system.steady() && first * second < 0 &&
          std::abs(second) > worth_a_solve * tolerated;
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::DampStage(Vec base)
{
  SNES snes;
  PetscInt newton, linear;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetIterationNumber(snes, &newton));
  PetscCall(SNESGetLinearSolveIterations(snes, &linear));
  stage.newton_iterations += newton;
  stage.linear_iterations += linear;
  stage.damped = true;
  PetscCall(VecCopy(stage.U, base));
  PetscFunctionReturn(0);
}

/// Start of a solve: the last step's motion goes on, and so does its change unless the step is much longer
/// than those it is known from. After a jump of the plate's motion nothing is known.
PetscErrorCode Stepper::PredictEuler(Vec U) const
{
  PetscReal step;
  PetscFunctionBeginUser;
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(VecCopy(state.U, U));
  if (state.steps_in_phase >= 1) PetscCall(VecAXPY(U, step, state.Udot));
  if (state.steps_in_phase >= 2 && step <= much_longer * state.step) {
    const double bend = step * (step + state.step) / (state.step + state.step_before);
    PetscCall(VecAXPBYPCZ(U, bend, -bend, 1, state.Udot, state.Udot_before));
  }
  PetscFunctionReturn(0);
}

/// The rate at the end of a step and the mean one of the step give a parabola that goes on in the next,
/// unless that is much longer. After a jump of the plate's motion nothing is known.
PetscErrorCode Stepper::PredictStage(Vec U) const
{
  constexpr double gamma = sdirk2::gamma;
  PetscReal step;
  PetscFunctionBeginUser;
  if (stage.damped) PetscFunctionReturn(0); // from what the undamped one has found
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(VecCopy(state.U, U));
  const bool known = state.steps_in_phase >= 2 && step <= much_longer * state.step;
  // U' = rate - lag (rate - mean), U'' = (rate - mean)/((lag + 1/2) dt_0) twice over; THEORY (4.6).
  constexpr double lag_sum = sdirk2::rate_lag + 0.5, lag = sdirk2::rate_lag / lag_sum;
  if (stage.index == 0) {
    const double bend = known ? stage.length * (0.5 * stage.length / (lag_sum * state.step) - lag) : 0;
    if (state.steps_in_phase >= 1)
      PetscCall(VecAXPBYPCZ(U, stage.length + bend, -bend, 1, state.Udot, state.Udot_before));
  } else if (known) {
    const double slope = (1 - gamma) * step, bend = 0.5 * (1 + gamma) * step / (lag_sum * state.step) - lag;
    PetscCall(VecCopy(stage.U, U));
    PetscCall(VecAXPBYPCZ(U, slope * (1 + bend), -slope * bend, 1, state.Udot, state.Udot_before));
  } else {
    PetscCall(VecAXPBY(U, 1 / gamma, 1 - 1 / gamma, stage.U));
  }
  PetscFunctionReturn(0);
}

/// Internal variables and energies where the last solve converged. SNES's solution: TS's U is that to
/// round-off, but this is where the bulk has been evaluated.
PetscErrorCode Stepper::EvaluateEnd(PetscReal time, History &next, CellEnergy &energy) const
{
  SNES snes;
  Vec solution;
  LocalVector local;
  MutableArray values;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetSolution(snes, &solution));
  PetscCall(local.GetZero(mesh.dm));
  PetscCall(DMGlobalToLocal(mesh.dm, solution, INSERT_VALUES, local));
  PetscCall(values.Get(local));
  system.SetBoundary(plates(time, 0), values, nullptr);
  next.resize(state.history.size());
  const BulkFailure failure = system.bulk->Advance(values, start(), weights(time), next, energy);
  PetscCheck(!failure, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a converged step cannot be evaluated again");
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::AdvanceFriction(PetscReal time, const FrictionMemory &memory, Vec U, Vec rate,
                                        FrictionHistory &next)
{
  LocalVector local[2];
  const Vec global[2] = {U, rate};
  MutableArray values[2];
  PetscFunctionBeginUser;
  for (int k = 0; k < 2; ++k) {
    PetscCall(local[k].GetZero(mesh.dm));
    PetscCall(DMGlobalToLocal(mesh.dm, global[k], INSERT_VALUES, local[k]));
    PetscCall(values[k].Get(local[k]));
  }
  system.SetBoundary(plates(time, 0), values[0], values[1]);
  const PetscScalar *const rates = system.steady() ? nullptr : static_cast<PetscScalar *>(values[1]);
  PetscCall(contact->Advance(plates(time, solve_length(time)), memory, values[0], rates, next));
  PetscFunctionReturn(0);
}

/// Rates as the second stage's residual saw them, and of the whole step.
PetscErrorCode Stepper::SetRates(double step, Vec U)
{
  PetscFunctionBeginUser;
  if (scene.time.rule == TimeRule::exponential_euler) {
    PetscCall(VecSwap(state.Udot, state.Udot_before));
    PetscCall(VecWAXPY(state.Udot, -1, before, U));
    PetscCall(VecScale(state.Udot, 1 / step));
    PetscFunctionReturn(0);
  }
  PetscCall(VecWAXPY(state.Udot_before, -1, before, U));
  PetscCall(VecScale(state.Udot_before, 1 / step));
  if (stage.damped) {
    PetscCall(VecWAXPY(state.Udot, -1, stage.U, U));
    PetscCall(VecScale(state.Udot, 1 / (step - stage.length)));
    PetscFunctionReturn(0);
  }
  PetscCall(VecCopy(U, state.Udot));
  PetscCall(VecAXPBYPCZ(state.Udot, -sdirk2::reach, sdirk2::reach - 1, 1, stage.U, before));
  PetscCall(VecScale(state.Udot, 1 / stage.length));
  PetscFunctionReturn(0);
}

} // namespace tribogel
