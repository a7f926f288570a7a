/// summary.json: the scene as run, the phases' ends, balances, counts, cost and versions of a run, for
/// scripts.
#pragma once

#include "observe/cost.hpp"
#include "observe/error_estimate.hpp"
#include "support/exit_status.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tribogel
{

struct RunOutcome {
  int status = 0;     ///< the program's exit status
  std::string reason; ///< why it is not 0

  /// Whatever it was: something is lost. A reason is told once.
  void fail(const std::string &why)
  {
    status = exit_status::cannot_go_on;
    if (reason.find(why) == std::string::npos) reason += (reason.empty() ? "" : "; ") + why;
  }
};

/// By the first rank. `estimate` is null where none was asked for or made. `complaint` says on all ranks why
/// the file could not be written, empty if it could. Collective.
PetscErrorCode WriteSummary(MPI_Comm comm, const std::string &directory, const Problem &problem,
                            const Recorder &recorder, const RunOutcome &outcome, const RunCost &cost,
                            const std::vector<std::pair<std::string, std::string>> &options,
                            const std::vector<std::string> &warnings, const ErrorEstimate *estimate,
                            std::string &complaint);

} // namespace tribogel
