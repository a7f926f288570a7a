#include "observe/cost.hpp"

#include <sys/resource.h>

namespace tribogel
{

PetscErrorCode MeasureCost(MPI_Comm comm, double wall_start, RunCost &cost)
{
  rusage usage{};
  PetscFunctionBeginUser;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval &t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  double sums[2] = {seconds(usage.ru_utime) + seconds(usage.ru_stime),
                    static_cast<double>(usage.ru_maxrss) / 1024};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, comm));
  cost.cpu_seconds = sums[0];
  cost.peak_memory_MB = sums[1];
  cost.wall_seconds = MPI_Wtime() - wall_start;
  PetscCallMPI(MPI_Comm_size(comm, &cost.ranks));
  PetscFunctionReturn(0);
}

} // namespace tribogel
