/// Companions of a run: the same scene on coarser meshes or with shorter steps, for -error_estimate. They
/// live in the program of the run, after it, and write nothing.
#pragma once

#include "observe/measure.hpp"
#include "observe/stop_question.hpp"

#include <string>
#include <vector>

namespace tribogel
{

struct Companion {
  std::string name; ///< in words: what is different
  MeshParameters mesh;
  double size = 1;           ///< of its edges over the run's
  double tolerance_over = 1; ///< its tolerance of the steps over the run's

  // What it left.
  std::string failure;          ///< why it is not complete; empty: it is
  std::vector<PlateLoads> ends; ///< N [N], T [N mm] at the phases' ends
  PetscInt unknowns = 0, steps = 0;
  double newton_tolerance = 0; ///< of forces, relative
  double cpu_seconds = 0;      ///< of all ranks
};

/// Those of the scene that differ in the mesh, coarse to fine; none for a mesh from a file, or where no
/// coarser one exists.
std::vector<Companion> mesh_companions(const Scene &scene);

/// The one that differs in the steps; only where something is integrated.
std::vector<Companion> time_companions(const Scene &scene);

/// Runs it. `serial` is the mesh, on the first rank, where the scene's cylinders are none. What goes wrong is
/// said in `failure`, and `stopped` if the question made it stop. Collective.
PetscErrorCode RunCompanion(MPI_Comm comm, const Scene &scene, const SerialMesh *serial,
                            const StopQuestion &ask, Companion &companion, bool &stopped);

} // namespace tribogel
