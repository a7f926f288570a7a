/// All that evolves during a run. A checkpoint is this; a rejected step leaves it untouched (U is
/// the solution vector of TS, which TS restores then).
#pragma once

#include "bulk/bulk.hpp"
#include "support/petsc_handles.hpp"

namespace tribogel
{

struct State {
  int phase = 0;         ///< index into the schedule
  double time = 0;       ///< of U [s]
  double step = 0;       ///< that led here [s]
  VecHandle U, Udot;     ///< solution and its rate as the residual saw it
  History history;       ///< internal variables at `time`
  double stored = 0;     ///< energy in the bulk of this rank's cells [N mm]
  double dissipated = 0; ///< by the dashpots since t = 0, this rank's cells [N mm]
};

} // namespace tribogel
