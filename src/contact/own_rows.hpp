/// Adds blocks to the rows of a matrix that one process holds whole. MatSetValues searches each entry among
/// the row's; here entries are looked for where those of the block's last row were, or next to the last one:
/// the unknowns of a node have the same columns, and lie side by side.
#pragma once

#include <petscmat.h>

#include <algorithm>
#include <vector>

namespace tribogel
{

class OwnRows
{
public:
  /// Between Open and Close the matrix is not to be used. Matrices of other types stay closed.
  PetscErrorCode Open(Mat matrix)
  {
    PetscBool serial, known;
    PetscFunctionBeginUser;
    PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATSEQAIJ, &serial));
    if (!serial) PetscFunctionReturn(0);
    A = matrix;
    PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &count, &start, &column, &known));
    PetscCheck(known, PETSC_COMM_SELF, PETSC_ERR_SUP, "the matrix does not show its rows");
    PetscCall(MatSeqAIJGetArray(A, &value));
    PetscFunctionReturn(0);
  }

  PetscErrorCode Close()
  {
    PetscBool known;
    PetscFunctionBeginUser;
    if (!A) PetscFunctionReturn(0);
    PetscCall(MatSeqAIJRestoreArray(A, &value));
    PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &count, &start, &column, &known));
    A = nullptr;
    PetscFunctionReturn(0);
  }

  bool is_open() const { return A != nullptr; }

  /// `values` by rows; negative indices are left out.
  PetscErrorCode Add(const std::vector<PetscInt> &rows, const std::vector<PetscInt> &columns,
                     const double *values)
  {
    PetscFunctionBeginUser;
    offset.assign(columns.size(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i] < 0) continue;
      const PetscInt first = start[rows[i]], end = start[rows[i] + 1];
      PetscInt next = first;
      for (std::size_t j = 0; j < columns.size(); ++j) {
        if (columns[j] < 0) continue;
        PetscInt place = first + offset[j];
        if (place >= end || column[place] != columns[j]) place = find(columns[j], next, first, end);
        PetscCheck(place < end && column[place] == columns[j], PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
                   "no room for row %d, column %d", static_cast<int>(rows[i]), static_cast<int>(columns[j]));
        value[place] += values[i * columns.size() + j];
        offset[j] = place - first;
        next = place + 1;
      }
    }
    PetscFunctionReturn(0);
  }

private:
  Mat A = nullptr;
  PetscInt count = 0;
  const PetscInt *start = nullptr, *column = nullptr;
  PetscScalar *value = nullptr;
  std::vector<PetscInt> offset; ///< in its row, of each column in the last row

  PetscInt find(PetscInt wanted, PetscInt next, PetscInt first, PetscInt end) const
  {
    if (next < end && column[next] == wanted) return next;
    return static_cast<PetscInt>(std::lower_bound(column + first, column + end, wanted) - column);
  }
};

} // namespace tribogel
