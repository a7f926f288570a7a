#include "support/shared_order.hpp"

#include <algorithm>
#include <numeric>

namespace tribogel
{

PetscErrorCode SharedOrder::SetUp(MPI_Comm on, const std::vector<long long> &keys)
{
  PetscMPIInt ranks, rank;
  PetscFunctionBeginUser;
  comm = on;
  mine = static_cast<int>(keys.size());
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  count.assign(static_cast<std::size_t>(ranks), 0);
  offset.assign(static_cast<std::size_t>(ranks), 0);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, comm));
  std::partial_sum(count.begin(), count.end() - 1, offset.begin() + 1);
  std::vector<long long> all(rank == 0 ? static_cast<std::size_t>(offset.back() + count.back()) : 0);
  PetscCallMPI(
      MPI_Gatherv(keys.data(), mine, MPI_LONG_LONG, all.data(), count.data(), offset.data(), MPI_LONG_LONG, 0, comm));
  std::vector<std::size_t> sorted(all.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return all[a] < all[b]; });
  place.resize(all.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    PetscCheck(k == 0 || all[sorted[k - 1]] < all[sorted[k]], PETSC_COMM_SELF, PETSC_ERR_PLIB, "a key is there twice");
    place[sorted[k]] = k;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SharedOrder::Gather(const double *local, std::vector<double> &all) const
{
  std::vector<double> by_process(place.size());
  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Gatherv(local, mine, MPI_DOUBLE, by_process.data(), count.data(), offset.data(), MPI_DOUBLE, 0, comm));
  all.resize(place.size());
  for (std::size_t k = 0; k < place.size(); ++k) all[place[k]] = by_process[k];
  PetscFunctionReturn(0);
}

PetscErrorCode SharedOrder::Scatter(const std::vector<double> &all, double *local) const
{
  std::vector<double> by_process(place.size());
  PetscFunctionBeginUser;
  for (std::size_t k = 0; k < place.size(); ++k) by_process[k] = all[place[k]];
  PetscCallMPI(
      MPI_Scatterv(by_process.data(), count.data(), offset.data(), MPI_DOUBLE, local, mine, MPI_DOUBLE, 0, comm));
  PetscFunctionReturn(0);
}

} // namespace tribogel
