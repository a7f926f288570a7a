/// Numbers spread over processes, in an order that does not know of the processes: that of their keys.
#pragma once

#include <petscsys.h>

#include <vector>

namespace tribogel
{

class SharedOrder
{
public:
  /// Each key stands for a block of as many of this process's numbers as its length says; no key twice. The
  /// blocks follow each other in the order of the keys given. Collective.
  PetscErrorCode SetUp(MPI_Comm comm, const std::vector<long long> &keys, const std::vector<int> &lengths);

  /// All processes' numbers by increasing key, on the first process. Collective.
  PetscErrorCode Gather(const double *local, std::vector<double> &all) const;

  /// The counterpart: `all` is looked at on the first process only. Collective.
  PetscErrorCode Scatter(const std::vector<double> &all, double *local) const;

  std::size_t size() const { return total; } ///< of all processes together; known to the first one
  std::size_t local_size() const { return static_cast<std::size_t>(mine); }

private:
  struct Block {
    std::size_t begin; ///< among the numbers process by process
    int length;
  };

  MPI_Comm comm = MPI_COMM_NULL;
  int mine = 0;
  std::size_t total = 0;
  std::vector<int> count, offset; ///< of each process's numbers
  std::vector<Block> blocks;      ///< by increasing key; first process only
};

} // namespace tribogel
