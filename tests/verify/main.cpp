/// GoogleTest on PETSc: options that GoogleTest does not know go to PETSc's database, so that any solver
/// option can be tried on any test. On several ranks every rank runs every test and only the first one
/// prints.
#include <gtest/gtest.h>

#include <petscsys.h>

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank > 0) {
    auto &listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  const int finalized = PetscFinalize();
  return failed != 0 || finalized != 0 || testing::UnitTest::GetInstance()->test_to_run_count() == 0;
}
