/// Whether someone outside of the program wants a run to stop.
#pragma once

#include <petscsys.h>

#include <functional>
#include <string>

namespace tribogel
{

/// To be asked after each step: `why` gets the reason to stop before the end, and stays as it is if there is
/// none; the same on all ranks. Collective.
using StopQuestion = std::function<PetscErrorCode(MPI_Comm comm, std::string &why)>;

/// Of signals, and of a wall time that would be over before it is asked again; `wall_start` as MPI_Wtime [s].
StopQuestion ask_signals_and_clock(double wall_start, double wall_time);

} // namespace tribogel
