/// RAII for PETSc objects: a handle destroys its object once, converts to the plain PETSc type, and `put()`
/// is the output argument of a creating call. Destroy before PetscFinalize.
#pragma once

#include <petscdmplex.h>
#include <petscts.h>

#include <utility>

namespace tribogel
{

template <class Object, PetscErrorCode (*Destroy)(Object *)> class Handle
{
public:
  Handle() = default;
  Handle(const Handle &) = delete;
  Handle &operator=(const Handle &) = delete;
  Handle(Handle &&other) noexcept : object(std::exchange(other.object, nullptr)) {}
  Handle &operator=(Handle &&other) noexcept
  {
    std::swap(object, other.object);
    return *this;
  }
  ~Handle() { reset(); }

  operator Object() const { return object; }
  Object *put()
  {
    reset();
    return &object;
  }
  void reset()
  {
    if (object) PetscCallAbort(PETSC_COMM_SELF, Destroy(&object));
    object = nullptr;
  }

private:
  Object object = nullptr;
};

using DmHandle = Handle<DM, DMDestroy>;
using VecHandle = Handle<Vec, VecDestroy>;
using MatHandle = Handle<Mat, MatDestroy>;
using KspHandle = Handle<KSP, KSPDestroy>;
using TsHandle = Handle<TS, TSDestroy>;

} // namespace tribogel
