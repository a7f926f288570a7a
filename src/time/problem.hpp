/// A scene made ready to be solved: its equations, and the steps through its schedule.
#pragma once

#include "time/stepper.hpp"

namespace tribogel
{

class Problem
{
public:
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene)
  {
    return SetUp(comm, scene, meridian_blocks(scene));
  }

  /// The same with bodies of another outline than the scene's cylinders, whose radii and heights then only
  /// scale (the twist's length, coefficients of friction).
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene, SerialMesh serial)
  {
    PetscFunctionBeginUser;
    PetscCall(system.SetUp(comm, scene, std::move(serial)));
    PetscCall(stepper.SetUp());
    PetscFunctionReturn(0);
  }
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene, const std::vector<MeridianBlock> &blocks)
  {
    return SetUp(comm, scene, mesh_of(scene.model, blocks));
  }

  /// Stepper::Run.
  PetscErrorCode Run(const std::vector<Observer *> &observers, bool &completed, std::string &why)
  {
    return stepper.Run(*this, observers, completed, why);
  }

  System system;
  Stepper stepper{system};
};

} // namespace tribogel
