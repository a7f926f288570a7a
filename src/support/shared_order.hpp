/// Numbers spread over processes, in an order that does not know of the processes: that of their keys.
#pragma once

#include <petscsys.h>

#include <vector>

namespace tribogel
{

class SharedOrder
{
public:
  /// `keys` of this process's numbers, in their local order; no key twice. Collective.
  PetscErrorCode SetUp(MPI_Comm comm, const std::vector<long long> &keys);

  /// All processes' numbers by increasing key, on the first process. Collective.
  PetscErrorCode Gather(const double *local, std::vector<double> &all) const;

  /// The counterpart: `all` is looked at on the first process only. Collective.
  PetscErrorCode Scatter(const std::vector<double> &all, double *local) const;

  std::size_t size() const { return place.size(); } ///< of all processes together; known to the first one
  std::size_t local_size() const { return static_cast<std::size_t>(mine); }

private:
  MPI_Comm comm = MPI_COMM_NULL;
  int mine = 0;
  std::vector<int> count, offset; ///< of each process
  std::vector<std::size_t> place; ///< by key, of the numbers process by process; first process only
};

} // namespace tribogel
