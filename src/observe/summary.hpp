/// summary.json: the scene as run, the phases' ends, balances, counts, cost and versions of a run, for scripts.
#pragma once

#include "observe/recorder.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tribogel
{

struct RunOutcome {
  int status = 0;     ///< the program's exit status
  std::string reason; ///< why it is not 0
};

/// What the run has cost so far, over all ranks. Collective.
struct RunCost {
  double cpu_seconds = 0, wall_seconds = 0, peak_memory_MB = 0;
  int ranks = 1;
  int restarts = 0; ///< costs of the programs that this one continues are included, up to their last checkpoints
};
PetscErrorCode MeasureCost(MPI_Comm comm, double wall_start, RunCost &cost);

/// Written to a temporary name and renamed, on the first rank.
PetscErrorCode WriteSummary(MPI_Comm comm, const std::string &directory, const Problem &problem,
                            const Recorder &recorder, const RunOutcome &outcome, const RunCost &cost,
                            const std::vector<std::pair<std::string, std::string>> &options,
                            const std::vector<std::string> &warnings);

} // namespace tribogel
