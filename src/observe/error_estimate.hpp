/// -error_estimate: what mesh and steps do to N and T at the phases' ends, from companions of the run.
#pragma once

#include "observe/companions.hpp"
#include "observe/recorder.hpp"
#include "tribogel/math/extrapolation.hpp"

#include <functional>

namespace tribogel
{

/// Of N or T. NaN where there is no estimate.
struct LoadErrors {
  Extrapolation mesh, time;
};

struct ErrorEstimate {
  std::vector<Companion> companions;
  std::vector<std::array<LoadErrors, 2>> phases; ///< of N [N] and T [N mm] at each phase's end
  std::vector<std::string> notes;                ///< what is missing, and why
  double cpu_seconds = 0;                        ///< of the companions, all ranks
};

/// Runs the companions of a run that is complete; `serial` as in RunCompanion, null for the scene's
/// cylinders. `told` hears of each companion that has ended. Collective.
PetscErrorCode EstimateErrors(MPI_Comm comm, const Scene &scene, const SerialMesh *serial,
                              const Recorder &run, const StopQuestion &ask,
                              const std::function<void(const Companion &)> &told, ErrorEstimate &estimate);

/// From what the companions left. `ends`: N and T of the run.
void judge(const Scene &scene, const std::vector<PlateLoads> &ends, ErrorEstimate &estimate);

} // namespace tribogel
