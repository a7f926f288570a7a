/// What a run costs.
#pragma once

#include <petscsys.h>

namespace tribogel
{

/// What the run has cost so far, over all ranks. Collective.
struct RunCost {
  double cpu_seconds = 0, wall_seconds = 0, peak_memory_MB = 0;
  int ranks = 1;
  int restarts =
      0; ///< costs of the programs that this one continues are included, up to their last checkpoints
};
PetscErrorCode MeasureCost(MPI_Comm comm, double wall_start, RunCost &cost);

} // namespace tribogel
