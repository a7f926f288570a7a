/// What PETSc lends, given back at the end of the scope, on every way out of it: local vectors of a DM, and
/// the arrays of vectors.
///
///     LocalVector U;
///     ConstArray u;
///     PetscCall(U.Get(dm));
///     PetscCall(u.Get(U)); // declared behind U, and so given back before it
#pragma once

#include <petscdm.h>

#include <type_traits>

namespace tribogel
{

class LocalVector
{
public:
  LocalVector() = default;
  LocalVector(const LocalVector &) = delete;
  LocalVector &operator=(const LocalVector &) = delete;
  ~LocalVector()
  {
    if (vector) PetscCallAbort(PETSC_COMM_SELF, DMRestoreLocalVector(dm, &vector));
  }

  /// Once; `lender` must live longer. The numbers in it are what its last user left.
  PetscErrorCode Get(DM lender)
  {
    PetscFunctionBeginUser;
    dm = lender;
    PetscCall(DMGetLocalVector(dm, &vector));
    PetscFunctionReturn(0);
  }
  PetscErrorCode GetZero(DM lender)
  {
    PetscFunctionBeginUser;
    PetscCall(Get(lender));
    PetscCall(VecZeroEntries(vector));
    PetscFunctionReturn(0);
  }

  operator Vec() const { return vector; }

private:
  DM dm = nullptr;
  Vec vector = nullptr;
};

/// The numbers of this rank.
template <class Number> class VectorArray
{
  static constexpr bool read_only = std::is_const_v<Number>;

public:
  VectorArray() = default;
  VectorArray(const VectorArray &) = delete;
  VectorArray &operator=(const VectorArray &) = delete;
  ~VectorArray()
  {
    if (!values) return;
    if constexpr (read_only)
      PetscCallAbort(PETSC_COMM_SELF, VecRestoreArrayRead(vector, &values));
    else
      PetscCallAbort(PETSC_COMM_SELF, VecRestoreArray(vector, &values));
  }

  /// Once; `lender` must live longer.
  PetscErrorCode Get(Vec lender)
  {
    PetscFunctionBeginUser;
    vector = lender;
    if constexpr (read_only)
      PetscCall(VecGetArrayRead(vector, &values));
    else
      PetscCall(VecGetArray(vector, &values));
    PetscFunctionReturn(0);
  }

  operator Number *() const { return values; }

private:
  Vec vector = nullptr;
  Number *values = nullptr;
};

using ConstArray = VectorArray<const PetscScalar>;
using MutableArray = VectorArray<PetscScalar>;

} // namespace tribogel
