/// The options of a run that is to be continued.
#pragma once

#include "options/scene_input.hpp"

#include <petscsys.h>

namespace tribogel
{

/// The text of `-restart`, empty if it is not given (or without one, which is refused with the other
/// options).
PetscErrorCode ReadRestart(std::string &directory);

/// All options of a run, as text for its checkpoint; the mesh file by its whole path, since the run may go on
/// from another working directory.
std::string text_of_options(const SceneInput &input);

/// The options of that text enter PETSc's database, save those that are given anew and those that belong to
/// the program that was stopped (where it wrote, what it showed). Throws UserError if the text is none.
PetscErrorCode AdoptOptions(const std::string &stored);

/// Throws UserError if an option of the scene that is given anew has another value than in the stored run.
/// All others follow from the stored ones and from the mesh, which has to be compared too (-mesh_file names
/// where it is now).
void expect_unchanged(const SceneInput &input, const std::string &stored);

} // namespace tribogel
