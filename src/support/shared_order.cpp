#include "support/shared_order.hpp"

#include <algorithm>
#include <numeric>

namespace tribogel
{

namespace
{

/// How many things each process has and where they begin.
PetscErrorCode Count(MPI_Comm comm, int mine, std::vector<int> &count, std::vector<int> &offset)
{
  PetscMPIInt ranks;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  count.assign(static_cast<std::size_t>(ranks), 0);
  offset.assign(static_cast<std::size_t>(ranks), 0);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, comm));
  std::partial_sum(count.begin(), count.end() - 1, offset.begin() + 1);
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode SharedOrder::SetUp(MPI_Comm on, const std::vector<long long> &keys,
                                  const std::vector<int> &lengths)
{
  PetscMPIInt rank;
  std::vector<int> key_count, key_offset;
  PetscFunctionBeginUser;
  comm = on;
  mine = std::accumulate(lengths.begin(), lengths.end(), 0);
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(Count(comm, mine, count, offset));
  const int own_keys = static_cast<int>(keys.size());
  PetscCall(Count(comm, own_keys, key_count, key_offset));
  const std::size_t all = rank == 0 ? static_cast<std::size_t>(key_offset.back() + key_count.back()) : 0;
  std::vector<long long> key(all);
  std::vector<int> length(all);
  PetscCallMPI(MPI_Gatherv(keys.data(), own_keys, MPI_LONG_LONG, key.data(), key_count.data(),
                           key_offset.data(), MPI_LONG_LONG, 0, comm));
  PetscCallMPI(MPI_Gatherv(lengths.data(), own_keys, MPI_INT, length.data(), key_count.data(),
                           key_offset.data(), MPI_INT, 0, comm));
  std::vector<std::size_t> sorted(all), begin(all, 0);
  total = 0;
  for (std::size_t k = 0; k < all; ++k) {
    begin[k] = total;
    total += static_cast<std::size_t>(length[k]);
  }
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
  blocks.clear();
  blocks.reserve(all);
  for (std::size_t k = 0; k < all; ++k) {
    PetscCheck(k == 0 || key[sorted[k - 1]] < key[sorted[k]], PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "a key is there twice");
    blocks.push_back({begin[sorted[k]], length[sorted[k]]});
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SharedOrder::Gather(const double *local, std::vector<double> &all) const
{
  std::vector<double> by_process(count.size() > 1 ? total : 0);
  PetscFunctionBeginUser;
  if (count.size() > 1)
    PetscCallMPI(MPI_Gatherv(local, mine, MPI_DOUBLE, by_process.data(), count.data(), offset.data(),
                             MPI_DOUBLE, 0, comm));
  const double *from = count.size() > 1 ? by_process.data() : local;
  all.resize(total);
  double *to = all.data();
  for (const Block &block : blocks) to = std::copy_n(from + block.begin, block.length, to);
  PetscFunctionReturn(0);
}

PetscErrorCode SharedOrder::Scatter(const std::vector<double> &all, double *local) const
{
  std::vector<double> by_process(count.size() > 1 ? total : 0);
  PetscFunctionBeginUser;
  double *to = count.size() > 1 ? by_process.data() : local;
  const double *from = all.data();
  for (const Block &block : blocks) {
    std::copy_n(from, block.length, to + block.begin);
    from += block.length;
  }
  if (count.size() > 1)
    PetscCallMPI(MPI_Scatterv(by_process.data(), count.data(), offset.data(), MPI_DOUBLE, local, mine,
                              MPI_DOUBLE, 0, comm));
  PetscFunctionReturn(0);
}

} // namespace tribogel
