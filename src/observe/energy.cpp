#include "observe/energy.hpp"

namespace tribogel
{

PetscErrorCode AddEnergies(const Problem &problem, const Measurement *last, const Measurement &now,
                           const EnergyBalance &before, EnergyBalance &after)
{
  const State &state = problem.stepper.state;
  const PlateMotion motion = problem.stepper.motion(state.time);
  double sums[2] = {state.stored, state.dissipated};
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(state.U)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, comm));
  after = before;
  after.stored = sums[0];
  after.viscous = sums[1];
  if (!last) PetscFunctionReturn(0);
  const double force = 0.5 * (last->normal_force + now.normal_force),
               torque = 0.5 * (last->torque + now.torque);
  const double power = 0.5 * (last->friction_power + now.friction_power);
  after.work +=
      state.step * (torque * (motion.top_rate - motion.bottom_rate) - force * motion.top_travel_rate);
  after.friction += state.step * power;
  PetscFunctionReturn(0);
}

} // namespace tribogel
