#include "support/first_process.hpp"

#include "support/user_error.hpp"

namespace tribogel
{

namespace
{

template <class Values> PetscErrorCode BroadcastValues(MPI_Comm comm, Values &values, MPI_Datatype type)
{
  int size = static_cast<int>(values.size());
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&size, 1, MPI_INT, 0, comm));
  values.resize(static_cast<std::size_t>(size));
  PetscCallMPI(MPI_Bcast(values.data(), size, type, 0, comm));
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Broadcast(MPI_Comm comm, std::string &text)
{
  PetscFunctionBeginUser;
  PetscCall(BroadcastValues(comm, text, MPI_CHAR));
  PetscFunctionReturn(0);
}

PetscErrorCode Broadcast(MPI_Comm comm, std::vector<double> &numbers)
{
  PetscFunctionBeginUser;
  PetscCall(BroadcastValues(comm, numbers, MPI_DOUBLE));
  PetscFunctionReturn(0);
}

PetscErrorCode OnFirstProcess(MPI_Comm comm, const std::function<std::string()> &work, std::string &complaint)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  complaint = rank == 0 ? work() : "";
  PetscCall(Broadcast(comm, complaint));
  PetscFunctionReturn(0);
}

PetscErrorCode OnFirstProcess(MPI_Comm comm, const std::function<std::string()> &work)
{
  std::string complaint;
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, work, complaint));
  if (!complaint.empty()) throw UserError{complaint};
  PetscFunctionReturn(0);
}

} // namespace tribogel
