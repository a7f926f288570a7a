/// Factors that outlive their matrix: solutions are those of the matrix at hand, and factorisations fewer
/// than solves for as long as the matrix changes little.
#include "linear/direct_solver.hpp"
#include "support/petsc_handles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tribogel::test
{

namespace
{

constexpr PetscInt size = 60;
constexpr double tolerance = 1e-8;

/// A system of changing matrices, not symmetric, and its solver.
class Systems
{
public:
  PetscErrorCode SetUp(const char *ksp_type)
  {
    PC pc;
    PetscFunctionBeginUser;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::vector<double> *part : {&first, &drift, &other})
      for (PetscInt k = 0; k < size * size; ++k) part->push_back(uniform(random));
    for (PetscInt i = 0; i < size; ++i) first[i * size + i] += 20;
    PetscCall(KSPCreate(PETSC_COMM_SELF, ksp.put()));
    PetscCall(KSPSetType(ksp, ksp_type));
    PetscCall(KSPGMRESSetRestart(ksp, size));
    PetscCall(KSPSetTolerances(ksp, tolerance, 1e-50, PETSC_DEFAULT, 2 * size));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCLU));
    PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    PetscCall(RenewMatrix());
    PetscCall(MatCreateVecs(A, x.put(), b.put()));
    PetscCall(VecSet(b, 1));
    PetscCall(solver.HookInto(ksp, cost));
    PetscFunctionReturn(0);
  }

  /// Another matrix object, as after a change of pattern.
  PetscErrorCode RenewMatrix()
  {
    PetscFunctionBeginUser;
    PetscCall(KSPReset(ksp));
    PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, size, nullptr, A.put()));
    PetscFunctionReturn(0);
  }

  /// Solves with scale (first + along drift + aside other).
  PetscErrorCode Solve(double along, double aside = 0, double scale = 1)
  {
    KSPConvergedReason reason;
    VecHandle r;
    PetscReal left, all;
    PetscFunctionBeginUser;
    for (PetscInt i = 0; i < size; ++i)
      for (PetscInt j = 0; j < size; ++j) {
        const PetscInt k = i * size + j;
        PetscCall(
            MatSetValue(A, i, j, scale * (first[k] + along * drift[k] + aside * other[k]), INSERT_VALUES));
      }
    PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
    PetscCall(KSPSetOperators(ksp, A, A));
    PetscCall(KSPSetReusePreconditioner(ksp, PETSC_FALSE)); // as SNES does
    PetscCall(KSPSolve(ksp, b, x));
    PetscCall(KSPGetConvergedReason(ksp, &reason));
    PetscCall(KSPGetIterationNumber(ksp, &iterations));
    solved = reason > 0;
    PetscCall(VecDuplicate(b, r.put()));
    PetscCall(MatMult(A, x, r));
    PetscCall(VecAXPY(r, -1, b));
    PetscCall(VecNorm(r, NORM_2, &left));
    PetscCall(VecNorm(b, NORM_2, &all));
    residual = left / all;
    PetscFunctionReturn(0);
  }

  static constexpr PetscInt cost = 20;
  DirectSolver solver;

  // Of the last solve.
  PetscInt iterations = 0;
  bool solved = false;
  double residual = 0; ///< relative

private:
  std::vector<double> first, drift, other;
  MatHandle A;
  VecHandle x, b;
  KspHandle ksp;
};

} // namespace

TEST(direct_solver, FactorisesEveryMatrixWithPreonly)
{
  Systems systems;
  ASSERT_EQ(systems.SetUp(KSPPREONLY), 0);
  for (int k = 0; k < 5; ++k) {
    ASSERT_EQ(systems.Solve(1e-3 * k), 0);
    EXPECT_EQ(systems.iterations, 1);
    EXPECT_LT(systems.residual, 1e-13);
  }
  EXPECT_EQ(systems.solver.factorisations(), 5);
}

/// Factors of the matrix itself leave one iteration, older ones more. They are kept as long as the last solve
/// took fewer than the mean, factorisation included.
TEST(direct_solver, KeepsFactorsWhileTheyPay)
{
  Systems systems;
  ASSERT_EQ(systems.SetUp(KSPFGMRES), 0);
  PetscInt sum = 0, solves = 0, expected = 1;
  for (int k = 0; k < 40; ++k) {
    if (solves > 0 && systems.iterations * solves > Systems::cost + sum) {
      ++expected;
      sum = solves = 0;
    }
    ASSERT_EQ(systems.Solve(0.02 * k), 0);
    EXPECT_TRUE(systems.solved) << k;
    EXPECT_LE(systems.residual, tolerance * (1 + 1e-6)) << k;
    EXPECT_EQ(systems.solver.factorisations(), expected) << k;
    EXPECT_EQ(systems.iterations == 1, solves == 0) << k;
    sum += systems.iterations;
    ++solves;
  }
  EXPECT_GE(expected, 3);
  EXPECT_LE(expected, 20);
}

TEST(direct_solver, RenewsFactorsInTheMidstOfASolveThatTheyDoNotHelp)
{
  Systems systems;
  ASSERT_EQ(systems.SetUp(KSPFGMRES), 0);
  ASSERT_EQ(systems.Solve(0), 0);
  EXPECT_EQ(systems.iterations, 1);
  ASSERT_EQ(systems.Solve(0, 40), 0); // what was large is not
  EXPECT_TRUE(systems.solved);
  EXPECT_EQ(systems.iterations, 31);
  EXPECT_LE(systems.residual, tolerance * (1 + 1e-6));
  EXPECT_EQ(systems.solver.factorisations(), 2);
  ASSERT_EQ(systems.Solve(0, 40), 0);
  EXPECT_EQ(systems.iterations, 1);
  EXPECT_EQ(systems.solver.factorisations(), 2);
}

TEST(direct_solver, DoesNotTakeOneMatrixForAnother)
{
  Systems systems;
  ASSERT_EQ(systems.SetUp(KSPFGMRES), 0);
  ASSERT_EQ(systems.Solve(0), 0);
  ASSERT_EQ(systems.RenewMatrix(), 0);
  ASSERT_EQ(systems.Solve(0.5), 0);
  EXPECT_EQ(systems.iterations, 1);
  EXPECT_EQ(systems.solver.factorisations(), 2);
  EXPECT_LE(systems.residual, tolerance);
}

/// A matrix without inverse fails either way, and what comes after it does not.
TEST(direct_solver, ComesBackFromAMatrixThatCannotBeFactorised)
{
  for (const char *type : {KSPPREONLY, KSPFGMRES}) {
    Systems systems;
    ASSERT_EQ(systems.SetUp(type), 0);
    ASSERT_EQ(systems.Solve(0, 0, 0), 0);
    EXPECT_FALSE(systems.solved) << type;
    ASSERT_EQ(systems.Solve(0), 0);
    EXPECT_TRUE(systems.solved) << type;
    EXPECT_EQ(systems.iterations, 1) << type;
    EXPECT_LE(systems.residual, tolerance) << type;
  }
}

} // namespace tribogel::test
