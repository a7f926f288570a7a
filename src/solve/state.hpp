/// All that evolves during a run. A checkpoint is this; a rejected step leaves it untouched (U is
/// the solution vector of TS, which TS restores then).
#pragma once

#include "bulk/bulk.hpp"
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
  int steps_in_phase = 0;
  VecHandle U, Udot;     ///< solution and its rate as the residual saw it
  VecHandle Udot_before; ///< Euler's rule: the rate in the step before; SDIRK2: the mean rate of the last step
  History history;       ///< internal variables at `time`
  PlateLoads loads{}, load_rates{}, largest{}; ///< now, in the last step, and their largest absolute values so far
  double largest_strain = 0; ///< SDIRK2: root of the sum of the squares of C_i^-1 - 1, its largest value so far
  double stored = 0;         ///< energy in the bulk of this rank's cells [N mm]
  double dissipated = 0;     ///< by the dashpots since t = 0, this rank's cells [N mm]
};

} // namespace tribogel
