/// The directory of a run: judged before anything is computed, made only when everything else has been
/// judged.
#pragma once

#include "support/settings.hpp"

#include <petscsys.h>

namespace tribogel
{

/// Files that tribogel writes into a run's directory; -overwrite replaces these and no others.
inline constexpr const char *run_files[] = {"history.csv",       "profile.csv",       "summary.json",
                                            "summary.json.part", "fields.h5",         "fields.xdmf",
                                            "checkpoint.h5",     "checkpoint.h5.part"};

/// What speaks against writing a run there, in words; empty if nothing does. Touches nothing.
std::string objection_to(const OutputSettings &output);

/// Throws UserError on all processes if there is an objection. Collective.
PetscErrorCode CheckOutputDirectory(MPI_Comm comm, const OutputSettings &output);

/// Makes the directory and its parents and removes the files of the run it replaces. Collective; throws
/// UserError on all processes if that fails.
PetscErrorCode PrepareOutputDirectory(MPI_Comm comm, const OutputSettings &output);

} // namespace tribogel
