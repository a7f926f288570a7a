/// PETSc's option database <-> our own strict reading.
#pragma once

#include "options/option_sources.hpp"
#include "options/scene_input.hpp"

#include <petscsys.h>

namespace tribogel
{

/// All our options as the database has them, whatever file or line they came from. Throws UserError for a
/// name that is not PETSc's to judge: one that begins like ours or looks like a misspelling of ours.
PetscErrorCode ReadGivenOptions(GivenOptions &given);

/// Options -> scene, with notes on where they come from. Throws UserError.
PetscErrorCode ReadScene(const OptionSources &sources, SceneInput &input);

/// To be called when PETSc has read all it will ever read before time stepping, after a first solve. An
/// option that nothing has read is refused (UserError) if it stands on the command line, and becomes a
/// warning if it came from elsewhere; one that wants a number and has none is refused. `petsc_help` is what
/// PETSc said of its options meanwhile (TakePetscHelp); nearest names come from it.
PetscErrorCode CheckUnusedOptions(const OptionSources &sources, const std::string &petsc_help,
                                  std::vector<std::string> &warnings);

/// Is this an option (without its dash) that PETSc reads only when it stops, when a solve ends, or whenever
/// it likes?
bool is_read_late(const std::string &name);

/// Our options as resolved, then PETSC_OPTIONS and the names and texts of all options of PETSc.
std::vector<std::pair<std::string, std::string>> resolved_options(const SceneInput &input);

} // namespace tribogel
