// Local vectors and arrays that PETSc lends go back at the end of their scope.
#include "support/petsc_arrays.hpp"
#include "support/petsc_handles.hpp"

#include <gtest/gtest.h>

#include <petscdmda.h>

namespace tribogel
{
namespace
{

constexpr PetscInt nodes = 5;

PetscErrorCode MakeLine(DmHandle &dm)
{
  PetscFunctionBeginUser;
  PetscCall(DMDACreate1d(PETSC_COMM_SELF, DM_BOUNDARY_NONE, nodes, 1, 1, nullptr, dm.put()));
  PetscCall(DMSetUp(dm));
  PetscFunctionReturn(0);
}

/// Leaves by an error while it holds a vector and its array.
PetscErrorCode Fail(DM dm, Vec &lent)
{
  LocalVector vector;
  MutableArray array;
  PetscFunctionBeginUser;
  PetscCall(vector.Get(dm));
  PetscCall(array.Get(vector));
  lent = vector;
  SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER, "in the middle");
}

TEST(petsc_arrays, VectorsGoBackToTheirDm)
{
  DmHandle dm;
  ASSERT_EQ(MakeLine(dm), 0);
  Vec first;
  {
    LocalVector a, b;
    ASSERT_EQ(a.Get(dm), 0);
    ASSERT_EQ(b.Get(dm), 0);
    EXPECT_NE(static_cast<Vec>(a), static_cast<Vec>(b)); // both are lent
    first = a;
  }
  for (int k = 0; k < 20; ++k) { // a DM that gets none back makes new ones
    LocalVector c, d;
    ASSERT_EQ(c.Get(dm), 0);
    ASSERT_EQ(d.Get(dm), 0);
    EXPECT_TRUE(static_cast<Vec>(c) == first || static_cast<Vec>(d) == first);
  }
}

TEST(petsc_arrays, NumbersStayInTheVector)
{
  DmHandle dm;
  LocalVector vector;
  ASSERT_EQ(MakeLine(dm), 0);
  ASSERT_EQ(vector.GetZero(dm), 0);
  PetscReal largest;
  ASSERT_EQ(VecNorm(vector, NORM_INFINITY, &largest), 0); // PETSc keeps it until the numbers are others
  {
    MutableArray array;
    ASSERT_EQ(array.Get(vector), 0);
    for (PetscInt k = 0; k < nodes; ++k) {
      EXPECT_EQ(array[k], 0);
      array[k] = 0.5 + k;
    }
  }
  ASSERT_EQ(VecNorm(vector, NORM_INFINITY, &largest), 0);
  EXPECT_EQ(largest, nodes - 0.5);
  ConstArray array;
  ASSERT_EQ(array.Get(vector), 0);
  for (PetscInt k = 0; k < nodes; ++k) EXPECT_EQ(array[k], 0.5 + k);
}

TEST(petsc_arrays, GoBackWhenAnErrorEndsTheScope)
{
  DmHandle dm;
  ASSERT_EQ(MakeLine(dm), 0);
  Vec lent = nullptr;
  ASSERT_EQ(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), 0);
  const PetscErrorCode code = Fail(dm, lent);
  ASSERT_EQ(PetscPopErrorHandler(), 0);
  EXPECT_EQ(code, PETSC_ERR_USER);
  LocalVector again;
  ASSERT_EQ(again.Get(dm), 0);
  EXPECT_EQ(static_cast<Vec>(again), lent);
}

} // namespace
} // namespace tribogel
