/// checkpoint.h5: all that a run needs to go on as if it had never stopped, on any number of ranks. Written
/// at the start, at each phase's end, every `-checkpoint_every` seconds, and when the run is asked to stop:
/// by a signal, or because `-wall_time` would be over before the end of the next step.
#pragma once

#include "observe/checkpoint_exchange.hpp"
#include "observe/recorder.hpp"
#include "observe/stop_question.hpp"
#include "observe/summary.hpp"
#include "support/settings.hpp"

#include <optional>

namespace tribogel
{

/// What a run left behind.
struct StoredRun {
  std::string directory, options;
  DataFile data; ///< on the first process
};

/// Reads the checkpoint of the run in `directory`. Throws UserError if there is none. Collective.
PetscErrorCode ReadStoredRun(MPI_Comm comm, const std::string &directory, StoredRun &stored);

/// Throws UserError, which begins with `option`, if the mesh, by its digest on the first process, is not that
/// of the stored run. Collective.
PetscErrorCode ExpectSameMesh(MPI_Comm comm, const StoredRun &stored, const std::string &digest,
                              const std::string &option);

class Checkpoint : public Observer
{
public:
  /// `options` as text_of_options gives them, the mesh by its digest on the first process, `wall_start` as
  /// MPI_Wtime.
  Checkpoint(Recorder &recorder, OutputSettings output, std::string options, std::string mesh,
             double wall_start);

  /// Problem, recorder and costs as they were. Throws UserError if the checkpoint does not fit. Collective.
  PetscErrorCode Restore(const StoredRun &stored, Problem &problem);

  PetscErrorCode Start(const Problem &problem) override;
  PetscErrorCode Step(const Problem &problem, const StepReport &report) override;

  /// One that cannot be written ends the run and leaves the last one; nor is there a new one where rows are
  /// missing.
  PetscErrorCode Write(const Problem &problem);

  /// Of this program and of those it continues. Collective.
  PetscErrorCode Cost(MPI_Comm comm, RunCost &cost) const;

private:
  PetscErrorCode Orders(const Problem &problem);

  Recorder &recorder;
  OutputSettings output;
  std::string options, mesh;
  double wall_start, last_written = 0; ///< [s]
  StopQuestion ask;
  bool restored = false;
  RunCost earlier;
  std::optional<NaturalOrders> orders;
  LogEvents events;
};

} // namespace tribogel
