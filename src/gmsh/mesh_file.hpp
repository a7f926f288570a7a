/// Specimens of any shape from a Gmsh file: -mesh_file.
#pragma once

#include "mesh/blocks.hpp"
#include "options/scene_input.hpp"

#include <petscsys.h>

namespace tribogel
{

/// The scene's mesh, on the first rank; `dim` on all. With -mesh_file it is that of the file, and sizes that
/// stand for it go into the scene and its options: heights from the plates to z = 0 and to the lowest point
/// of the top gel, that point as the gap, radii of the circles with the area of the contact faces (or of the
/// top plate's, with one gel). Throws UserError on all ranks. Collective.
PetscErrorCode MakeMesh(MPI_Comm comm, SceneInput &input, SerialMesh &mesh);

} // namespace tribogel
