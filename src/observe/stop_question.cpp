#include "observe/stop_question.hpp"

#include "support/stop_signals.hpp"

#include <algorithm>

namespace tribogel
{

StopQuestion ask_signals_and_clock(double wall_start, double wall_time)
{
  return [=, asked = MPI_Wtime(), longest = 0.0](MPI_Comm comm, std::string &why) mutable -> PetscErrorCode {
    const double now = MPI_Wtime();
    PetscFunctionBeginUser;
    longest = std::max(longest, now - asked);
    asked = now;
    // Signals and clocks differ between the ranks.
    enum { signal, time_over, wishes };
    int wish[wishes] = {caught_stop_signal(), now - wall_start + longest > wall_time};
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, wish, wishes, MPI_INT, MPI_MAX, comm));
    if (wish[signal] || wish[time_over])
      why = std::string("stopped by ") + (wish[signal] ? stop_signal_name(wish[signal]) : "-wall_time");
    PetscFunctionReturn(0);
  };
}

} // namespace tribogel
