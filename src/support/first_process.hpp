/// What one process does for all: files are read and written by the first, and all hear of it.
#pragma once

#include <petscsys.h>

#include <functional>
#include <string>
#include <vector>

namespace tribogel
{

/// The first process's text or numbers to all. Collective.
PetscErrorCode Broadcast(MPI_Comm comm, std::string &text);
PetscErrorCode Broadcast(MPI_Comm comm, std::vector<double> &numbers);

/// Runs `work` on the first process; its complaint, empty if all went well, on all. Collective.
PetscErrorCode OnFirstProcess(MPI_Comm comm, const std::function<std::string()> &work,
                              std::string &complaint);

/// Runs `work` on the first process and throws its complaint, if it is not empty, as UserError on all.
/// Collective.
PetscErrorCode OnFirstProcess(MPI_Comm comm, const std::function<std::string()> &work);

} // namespace tribogel
