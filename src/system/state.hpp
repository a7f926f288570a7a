/// All that evolves during a run. A checkpoint is this; a rejected step leaves it untouched (U is
/// the solution vector of TS, which TS restores then).
#pragma once

#include "bulk/bulk.hpp"
#include "contact/friction_memory.hpp"
#include "support/petsc_handles.hpp"

#include <array>

namespace tribogel
{

/// N [N] and T [N mm], as the top plate's reactions.
using PlateLoads = std::array<double, 2>;

struct State {
  int phase = 0;          ///< index into the schedule
  double time = 0;        ///< of U [s]
  double step = 0;        ///< that led here [s]
  double step_before = 0; ///< the one before [s]
  double next_step = 0;   ///< that TS will try next, within the phase [s]
  int steps_in_phase = 0;
  VecHandle U, Udot; ///< solution and its rate as the residual saw it
  VecHandle
      Udot_before; ///< Euler's rule: the rate in the step before; SDIRK2: the mean rate of the last step
  History history; ///< internal variables at `time`
  FrictionHistory friction_history; ///< what friction remembers at `time`
  PlateLoads loads{}, load_rates{},
      largest{}; ///< now, in the last step, and their largest absolute values so far
  double largest_strain =
      0;                 ///< SDIRK2: root of the sum of the squares of C_i^-1 - 1, its largest value so far
  double stored = 0;     ///< energy in the bulk of this rank's cells [N mm]
  double dissipated = 0; ///< by the dashpots since t = 0, this rank's cells [N mm]
};

/// Every member once, by name: `visit(name, member)`, or `visit.Sum(name, member)` where the ranks' values
/// add up to what is meant. AnyState is State or const State. A new member is one more line. Collective if
/// the visitor is.
template <class AnyState, class Visitor> PetscErrorCode VisitState(AnyState &state, Visitor &visit)
{
  PetscFunctionBeginUser;
  PetscCall(visit("phase", state.phase));
  PetscCall(visit("time", state.time));
  PetscCall(visit("step", state.step));
  PetscCall(visit("step_before", state.step_before));
  PetscCall(visit("next_step", state.next_step));
  PetscCall(visit("steps_in_phase", state.steps_in_phase));
  PetscCall(visit("U", state.U));
  PetscCall(visit("Udot", state.Udot));
  PetscCall(visit("Udot_before", state.Udot_before));
  PetscCall(visit("history", state.history));
  PetscCall(visit("friction_history", state.friction_history));
  PetscCall(visit("loads", state.loads));
  PetscCall(visit("load_rates", state.load_rates));
  PetscCall(visit("largest", state.largest));
  PetscCall(visit("largest_strain", state.largest_strain));
  PetscCall(visit.Sum("stored", state.stored));
  PetscCall(visit.Sum("dissipated", state.dissipated));
  PetscFunctionReturn(0);
}

} // namespace tribogel
