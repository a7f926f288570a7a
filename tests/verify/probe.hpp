/// Residual and Jacobian of an assembled Problem at any state, as TS would ask for them. One rank.
#pragma once

#include "scenes.hpp"
#include "solver_options.hpp"

#include <algorithm>
#include <random>

namespace tribogel::test
{

using Values = std::vector<double>; ///< of the global unknowns

/// F(t, U, shift (U - U_n)) of a step that starts at the problem's committed state.
class Probe
{
public:
  Probe(Problem &of, double step)
      : problem(of), time(of.stepper.state.time + step), shift(1 / step), start(values(of.stepper.state.U))
  {
  }

  static Values values(Vec v)
  {
    PetscInt n;
    const PetscScalar *array;
    EXPECT_EQ(VecGetLocalSize(v, &n), 0);
    EXPECT_EQ(VecGetArrayRead(v, &array), 0);
    Values copy(array, array + n);
    EXPECT_EQ(VecRestoreArrayRead(v, &array), 0);
    return copy;
  }

  Values committed() const { return start; }

  /// The residual; `magnitude` gets the sum of absolute forces of each row.
  Values residual(const Values &U, Values *magnitude = nullptr)
  {
    Values F;
    EXPECT_EQ(Residual(U, F, magnitude), 0);
    return F;
  }

  /// The matrix, its pattern made to cover the pairs of facets that meet at U. Rows in full.
  std::vector<Values> jacobian(const Values &U)
  {
    std::vector<Values> rows;
    EXPECT_EQ(Jacobian(U, rows), 0);
    return rows;
  }

  /// Statuses of the slave nodes in the last evaluation, counted: open, stick, slip.
  std::array<int, 3> statuses() const
  {
    std::array<int, 3> count{};
    for (ContactStatus status : problem.system.contact->lower_face().statuses())
      ++count[static_cast<std::size_t>(status)];
    return count;
  }

  Problem &problem;
  double time, shift;

private:
  PetscErrorCode Local(const Values &values, Vec local) const
  {
    Vec global;
    PetscScalar *array;
    PetscFunctionBeginUser;
    PetscCall(DMGetGlobalVector(problem.system.mesh.dm, &global));
    PetscCall(VecGetArray(global, &array));
    std::copy(values.begin(), values.end(), array);
    PetscCall(VecRestoreArray(global, &array));
    PetscCall(VecZeroEntries(local));
    PetscCall(DMGlobalToLocal(problem.system.mesh.dm, global, INSERT_VALUES, local));
    PetscCall(DMRestoreGlobalVector(problem.system.mesh.dm, &global));
    PetscFunctionReturn(0);
  }

  PetscErrorCode LocalState(const Values &U, Values &u, Values &rate) const
  {
    Vec local;
    Values velocity(U.size());
    PetscFunctionBeginUser;
    for (std::size_t k = 0; k < U.size(); ++k) velocity[k] = shift * (U[k] - start[k]);
    PetscCall(DMGetLocalVector(problem.system.mesh.dm, &local));
    PetscCall(Local(U, local));
    u = values(local);
    PetscCall(Local(velocity, local));
    rate = values(local);
    PetscCall(DMRestoreLocalVector(problem.system.mesh.dm, &local));
    problem.system.SetBoundary(problem.stepper.plates(time, 0), u.data(), rate.data());
    PetscFunctionReturn(0);
  }

  PetscErrorCode Global(const Values &local_values, Values &global_values) const
  {
    Vec local, global;
    PetscScalar *array;
    PetscFunctionBeginUser;
    PetscCall(DMGetLocalVector(problem.system.mesh.dm, &local));
    PetscCall(DMGetGlobalVector(problem.system.mesh.dm, &global));
    PetscCall(VecGetArray(local, &array));
    std::copy(local_values.begin(), local_values.end(), array);
    PetscCall(VecRestoreArray(local, &array));
    PetscCall(VecZeroEntries(global));
    PetscCall(DMLocalToGlobal(problem.system.mesh.dm, local, ADD_VALUES, global));
    global_values = values(global);
    PetscCall(DMRestoreGlobalVector(problem.system.mesh.dm, &global));
    PetscCall(DMRestoreLocalVector(problem.system.mesh.dm, &local));
    PetscFunctionReturn(0);
  }

  PetscErrorCode Residual(const Values &U, Values &F, Values *magnitude)
  {
    Values u, rate;
    PetscFunctionBeginUser;
    PetscCall(LocalState(U, u, rate));
    Values f(u.size(), 0.0), sizes(u.size(), 0.0);
    PetscCall(problem.system.AddResidual(problem.stepper.solve(time), u.data(), rate.data(), f.data(),
                                         sizes.data()));
    EXPECT_FALSE(problem.system.failure.bulk);
    EXPECT_EQ(problem.system.failure.contact, "");
    PetscCall(Global(f, F));
    if (magnitude) PetscCall(Global(sizes, *magnitude));
    PetscFunctionReturn(0);
  }

  PetscErrorCode Jacobian(const Values &U, std::vector<Values> &rows)
  {
    Values u, rate;
    bool covered = true;
    PetscFunctionBeginUser;
    PetscCall(LocalState(U, u, rate));
    if (problem.system.contact)
      PetscCall(problem.system.contact->UpdateCandidates(problem.stepper.plates(time, 1 / shift), u.data(),
                                                         covered));
    if (!covered) PetscCall(problem.stepper.BuildMatrix());
    PetscCall(MatZeroEntries(problem.stepper.jacobian));
    PetscCall(problem.system.AddJacobian(problem.stepper.solve(time), u.data(), rate.data(), shift,
                                         problem.stepper.jacobian));
    EXPECT_FALSE(problem.system.failure.bulk);
    EXPECT_EQ(problem.system.failure.contact, "");
    PetscCall(MatAssemblyBegin(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(problem.stepper.jacobian, MAT_FINAL_ASSEMBLY));
    rows.assign(U.size(), Values(U.size(), 0.0));
    for (std::size_t i = 0; i < U.size(); ++i) {
      PetscInt n;
      const PetscInt *columns;
      const PetscScalar *entries;
      PetscCall(MatGetRow(problem.stepper.jacobian, static_cast<PetscInt>(i), &n, &columns, &entries));
      for (PetscInt k = 0; k < n; ++k) rows[i][static_cast<std::size_t>(columns[k])] = entries[k];
      PetscCall(MatRestoreRow(problem.stepper.jacobian, static_cast<PetscInt>(i), &n, &columns, &entries));
    }
    PetscFunctionReturn(0);
  }

  Values start;
};

} // namespace tribogel::test
