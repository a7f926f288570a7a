/// What SDIRK2 asks of the problem: where its stages start, what they leave, their error. THEORY 4.4.
#include "solve/problem.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

/// A sum of squares over all ranks.
PetscErrorCode Norm(MPI_Comm comm, double squares, double &norm)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &squares, 1, MPI_DOUBLE, MPI_SUM, comm));
  norm = std::sqrt(squares);
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Problem::BeginStage(int index, PetscReal time)
{
  PetscFunctionBeginUser;
  stage.index = index;
  stage.time = time;
  if (index == 0) stage.length = time - state.time;
  stage.damped = false;
  PetscFunctionReturn(0);
}

/// The second stage's end is the step's: it is dealt with when the step is accepted.
PetscErrorCode Problem::EndStage(int index, Vec U)
{
  SNES snes;
  CellEnergy energy;
  Vec rate;
  PetscFunctionBeginUser;
  if (index > 0) PetscFunctionReturn(0);
  PetscCall(VecCopy(U, stage.U));
  PetscCall(SumPlateLoads(stage.loads));
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
PetscErrorCode Problem::Rings(bool &rings) const
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
  PetscCall(SumPlateLoads(loads));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  PlateLoads largest = state.largest;
  for (int k = 0; k < 2; ++k)
    largest[k] = std::max({largest[k], std::abs(stage.loads[k]), std::abs(loads[k])});
  const double first = stage.loads[torque] - state.loads[torque];
  const double second = loads[torque] - state.loads[torque] - sdirk2::reach * first;
  const double tolerated = fraction * load_scales(largest)[torque] + least_loads[torque];
  rings = scene.has_contact() && (fixed || step <= unresolved) && !steady() && first * second < 0 &&
          std::abs(second) > worth_a_solve * tolerated;
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::DampStage()
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
  PetscFunctionReturn(0);
}

/// The rate at the end of a step and the mean one of the step give a parabola that goes on in the next,
/// unless that is much longer. After a jump of the plate's motion nothing is known.
PetscErrorCode Problem::PredictStage(Vec U) const
{
  constexpr double gamma = sdirk2::gamma;
  constexpr double much_longer = 2;
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
PetscErrorCode Problem::EvaluateEnd(PetscReal time, History &next, CellEnergy &energy)
{
  SNES snes;
  Vec local, solution;
  PetscScalar *values;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetSolution(snes, &solution));
  PetscCall(DMGetLocalVector(mesh.dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(DMGlobalToLocal(mesh.dm, solution, INSERT_VALUES, local));
  PetscCall(VecGetArray(local, &values));
  SetBoundary(time, values, nullptr);
  next.resize(state.history.size());
  const BulkFailure failure = bulk->Advance(values, start(), weights(time), next, energy);
  PetscCheck(!failure, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a converged step cannot be evaluated again");
  PetscCall(VecRestoreArray(local, &values));
  PetscCall(DMRestoreLocalVector(mesh.dm, &local));
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::AdvanceFriction(PetscReal time, const FrictionMemory &memory, Vec U, Vec rate,
                                        FrictionHistory &next)
{
  Vec local[2];
  const Vec global[2] = {U, rate};
  PetscScalar *values[2];
  PetscFunctionBeginUser;
  for (int k = 0; k < 2; ++k) {
    PetscCall(DMGetLocalVector(mesh.dm, &local[k]));
    PetscCall(VecZeroEntries(local[k]));
    PetscCall(DMGlobalToLocal(mesh.dm, global[k], INSERT_VALUES, local[k]));
    PetscCall(VecGetArray(local[k], &values[k]));
  }
  SetBoundary(time, values[0], values[1]);
  PetscCall(contact->Advance(frames(time, solve_length(time)), memory, values[0],
                             steady() ? nullptr : values[1], next));
  for (int k = 0; k < 2; ++k) {
    PetscCall(VecRestoreArray(local[k], &values[k]));
    PetscCall(DMRestoreLocalVector(mesh.dm, &local[k]));
  }
  PetscFunctionReturn(0);
}

/// Rates as the second stage's residual saw them, and of the whole step.
PetscErrorCode Problem::SetRates(double step, Vec U)
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

/// At least what the schedule's largest compression would leave at every point: what is small beside that is
/// not resolved for its own sake.
PetscErrorCode Problem::LargestStrain(const History &history, double &strain) const
{
  const double floor = expected_compression();
  double least = floor * floor * static_cast<double>(history.size());
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(Norm(comm, bulk->SquaredStrain(history), strain));
  PetscCall(Norm(comm, least, least));
  strain = std::max({strain, least, state.largest_strain});
  PetscFunctionReturn(0);
}

/// THEORY (4.8), over `-time_tolerance`: such that this is what TS aims at.
PetscErrorCode EvaluateSecondOrderError(TS ts, NormType, PetscInt *order, PetscReal *error)
{
  Problem *problem;
  PetscReal step, first, unresolved, fraction;
  PlateLoads loads, scale;
  History end;
  CellEnergy energy;
  double bend = 0, strain, strain_bend;
  constexpr double gamma = sdirk2::gamma;
  PetscFunctionBeginUser;
  PetscCall(TSGetApplicationContext(ts, &problem));
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  const State &state = problem->state;
  const Stage &stage = problem->stage;
  if (order) *order = 2;
  PetscCall(problem->SumPlateLoads(loads));
  for (int k = 0; k < 2; ++k)
    scale[k] = std::max({state.largest[k], std::abs(stage.loads[k]), std::abs(loads[k])});
  scale = problem->load_scales(scale);
  for (int k = 0; k < 2; ++k) {
    const double change = std::abs(loads[k] - state.loads[k] - (stage.loads[k] - state.loads[k]) / gamma);
    bend = std::max(bend, change / (fraction * scale[k] + problem->least_loads[k]));
  }

  PetscCall(problem->EvaluateEnd(stage.time, end, energy));
  PetscCall(problem->LargestStrain(end, strain));
  for (std::size_t k = 0; k < end.size(); ++k) { // from here on what the second stage does not go on with
    const double before = state.history[k];
    end[k] = end[k] - before - (stage.history[k] - before) / (1 - gamma);
  }
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(ts));
  PetscCall(Norm(comm, problem->bulk->SquaredStress(end), strain_bend));
  bend = std::max(bend, strain_bend / (fraction * strain + problem->least_strain));
  *error = keeps_the_step * sdirk2::error_constant / (gamma * (1 - gamma)) * bend;
  *error = rounded(*error);
  PetscCall(problem->FirstStep(first, unresolved));
  if (step <= unresolved) *error = std::min(*error, keeps_the_step);
  PetscFunctionReturn(0);
}

} // namespace tribogel
