#include "linear/condensation.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

MPI_Comm comm_of(Mat A)
{
  return PetscObjectComm(reinterpret_cast<PetscObject>(A));
}

/// The part of A with these rows and columns, in its old place if there is one.
PetscErrorCode Cut(Mat A, IS rows, IS columns, MatHandle &part)
{
  Mat old = part;
  PetscFunctionBegin;
  PetscCall(MatCreateSubMatrix(A, rows, columns, old ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX,
                               old ? &old : part.put()));
  PetscFunctionReturn(0);
}

/// X Y, in its old place if there is one.
PetscErrorCode Multiply(Mat X, Mat Y, MatHandle &product)
{
  Mat old = product;
  PetscFunctionBegin;
  PetscCall(MatMatMult(X, Y, old ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                       old ? &old : product.put()));
  PetscFunctionReturn(0);
}

/// A matrix of so many own rows and columns with room for `per_row` entries, on this rank and off it.
/// MatMatMult may leave fewer than that. No row can have more than there are columns.
PetscErrorCode CreatePart(MPI_Comm comm, PetscInt rows, PetscInt columns,
                          const std::vector<PetscInt> &per_row, MatHandle &B)
{
  PetscInt all = columns;
  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPIU_INT, MPI_SUM, comm));
  std::vector<PetscInt> own = per_row, of_others = per_row;
  for (PetscInt &entries : own) entries = std::min(entries, columns);
  for (PetscInt &entries : of_others) entries = std::min(entries, all - columns);
  PetscCall(MatCreateAIJ(comm, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                         of_others.data(), B.put()));
  PetscCall(MatSetOption(B, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  PetscCall(MatSetOption(B, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscFunctionReturn(0);
}

PetscErrorCode Assemble(Mat B)
{
  PetscFunctionBegin;
  PetscCall(MatAssemblyBegin(B, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(B, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

template <class Block>
PetscErrorCode SetBlock(Mat B, PetscInt row, PetscInt column, const Block &values,
                        InsertMode mode = INSERT_VALUES)
{
  const PetscInt rows[] = {row, row + 1, row + 2}, columns[] = {column, column + 1, column + 2};
  PetscFunctionBegin;
  PetscCall(MatSetValues(B, 3, rows, 3, columns, values.data(), mode));
  PetscFunctionReturn(0);
}

} // namespace

/// Index sets and layouts for a new pattern of A.
PetscErrorCode Condensation::List()
{
  std::vector<PetscInt> s, l, i;
  PetscInt last;
  PetscFunctionBegin;
  const MPI_Comm comm = comm_of(A);
  parts = {};
  nodes.assign(unknowns->multiplier.size(), {});
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    nodes[a].slave = unknowns->slave[a];
    nodes[a].multiplier = unknowns->multiplier[a];
    for (int k = 0; k < 3; ++k) l.push_back(nodes[a].multiplier + k);
    for (int k = 0; k < 3 && nodes[a].whole(); ++k) {
      s.push_back(nodes[a].slave + k);
      i.push_back(nodes[a].slave + k);
    }
    for (int k = 0; k < 3; ++k) i.push_back(nodes[a].multiplier + k);
  }
  PetscCall(columns.Gather(comm, *unknowns));
  slave_at.clear();
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (nodes[a].whole()) slave_at.emplace(columns.reduced(nodes[a].slave), a);
  PetscCall(MatGetOwnershipRange(A, &first, &last));
  const auto create = [comm](const std::vector<PetscInt> &list, IsHandle &is) {
    return ISCreateGeneral(comm, static_cast<PetscInt>(list.size()), list.data(), PETSC_COPY_VALUES,
                           is.put());
  };
  PetscCall(create(unknowns->displacement, parts.u));
  PetscCall(create(s, parts.s));
  PetscCall(create(l, parts.l));
  PetscCall(create(i, parts.i));
  PetscFunctionReturn(0);
}

/// P: of the slaves' displacements, by all displacements.
PetscErrorCode Condensation::BuildRight()
{
  PetscInt row;
  PetscFunctionBegin;
  if (!static_cast<Mat>(parts.P)) {
    std::vector<PetscInt> per_row;
    for (const InterfaceNode &node : nodes)
      for (int k = 0; k < 3 && node.whole(); ++k)
        per_row.push_back(3 + static_cast<PetscInt>(node.master.size()));
    PetscCall(CreatePart(comm_of(A), static_cast<PetscInt>(per_row.size()),
                         static_cast<PetscInt>(unknowns->displacement.size()), per_row, parts.P));
  }
  PetscCall(MatGetOwnershipRange(parts.P, &row, nullptr));
  for (const InterfaceNode &node : nodes) {
    if (!node.whole()) continue;
    const InterfaceNode::Matrix3 own = node.keeps - InterfaceNode::Matrix3::Identity();
    PetscCall(SetBlock(parts.P, row, columns.reduced(node.slave), own));
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> W = -node.holds * node.B;
    std::vector<PetscInt> masters;
    for (PetscInt column : node.master) masters.push_back(columns.reduced(column));
    const PetscInt rows[] = {row, row + 1, row + 2};
    PetscCall(MatSetValues(parts.P, 3, rows, static_cast<PetscInt>(masters.size()), masters.data(), W.data(),
                           INSERT_VALUES));
    row += 3;
  }
  PetscCall(Assemble(parts.P));
  PetscFunctionReturn(0);
}

/// -G D^-1: what displacements' equations take of the slave's forces.
PetscErrorCode Condensation::Eliminate()
{
  PetscInt row, column;
  PetscFunctionBegin;
  if (!static_cast<Mat>(parts.minus_D_inverse)) {
    PetscInt interface_rows;
    PetscCall(ISGetLocalSize(parts.i, &interface_rows));
    const std::vector<PetscInt> per_row(3 * nodes.size(), 3);
    PetscCall(CreatePart(comm_of(A), static_cast<PetscInt>(per_row.size()), interface_rows, per_row,
                         parts.minus_D_inverse));
  }
  PetscCall(MatGetOwnershipRange(parts.minus_D_inverse, &row, nullptr));
  PetscCall(MatGetOwnershipRangeColumn(parts.minus_D_inverse, &column, nullptr));
  for (const InterfaceNode &node : nodes) {
    const InterfaceNode::Matrix3 minus = -node.D_inverse;
    if (node.whole()) PetscCall(SetBlock(parts.minus_D_inverse, row, column, minus));
    row += 3;
    column += node.whole() ? 6 : 3;
  }
  PetscCall(Assemble(parts.minus_D_inverse));
  PetscCall(Multiply(parts.A_ul, parts.minus_D_inverse, parts.eliminated));
  PetscFunctionReturn(0);
}

/// L: equations of the displacements, by those of the interface.
PetscErrorCode Condensation::BuildLeft()
{
  const PetscInt *column;
  const PetscScalar *value;
  PetscInt row, own_column, entries;
  PetscFunctionBegin;
  PetscCall(Eliminate());
  PetscCall(MatGetOwnershipRange(parts.eliminated, &row, nullptr));
  PetscCall(MatGetOwnershipRangeColumn(parts.eliminated, &own_column, nullptr));
  const auto displacements = static_cast<PetscInt>(unknowns->displacement.size());
  std::vector<PetscInt> slave_rows;
  for (const InterfaceNode &node : nodes)
    for (int k = 0; k < 3 && node.whole(); ++k) slave_rows.push_back(columns.reduced(node.slave) + k);
  std::vector<bool> of_slave(displacements, false);
  for (PetscInt r : slave_rows) of_slave[r - row] = true;
  if (!static_cast<Mat>(parts.L)) {
    std::vector<PetscInt> per_row(displacements, 6);
    for (PetscInt r = 0; r < displacements; ++r) {
      if (of_slave[r]) continue;
      PetscCall(MatGetRow(parts.eliminated, row + r, &per_row[r], nullptr, nullptr));
      entries = per_row[r];
      PetscCall(MatRestoreRow(parts.eliminated, row + r, &entries, nullptr, nullptr));
    }
    PetscInt interface_rows;
    PetscCall(ISGetLocalSize(parts.i, &interface_rows));
    PetscCall(CreatePart(comm_of(A), displacements, interface_rows, per_row, parts.L));
  }
  for (PetscInt r = row; r < row + displacements; ++r) {
    if (of_slave[r - row]) continue;
    PetscCall(MatGetRow(parts.eliminated, r, &entries, &column, &value));
    PetscCall(MatSetValues(parts.L, 1, &r, entries, column, value, INSERT_VALUES));
    PetscCall(MatRestoreRow(parts.eliminated, r, &entries, &column, &value));
  }
  for (const InterfaceNode &node : nodes) {
    if (node.whole()) {
      const InterfaceNode::Matrix3 force = node.force - InterfaceNode::Matrix3::Identity();
      PetscCall(SetBlock(parts.L, columns.reduced(node.slave), own_column, force));
      PetscCall(SetBlock(parts.L, columns.reduced(node.slave), own_column + 3, node.condition));
    }
    own_column += node.whole() ? 6 : 3;
  }
  PetscCall(Assemble(parts.L));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Read(Mat given, const std::shared_ptr<const ContactUnknowns> &list, bool &anew)
{
  PetscObjectState pattern_now;
  PetscFunctionBegin;
  PetscCall(MatGetNonzeroState(given, &pattern_now));
  anew = given != static_cast<Mat>(A) || list != unknowns || pattern_now != pattern;
  pattern = pattern_now;
  unknowns = list;
  PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(given)));
  *A.put() = given;
  if (anew) PetscCall(List());
  for (InterfaceNode &node : nodes) PetscCall(node.Read(A, columns));
  PetscFunctionReturn(0);
}

/// Appends a row of A_uu.
PetscErrorCode Condensation::AppendOwn(PetscInt row, SparseRow &entries)
{
  PetscInt size;
  const PetscInt *column;
  const PetscScalar *value;
  PetscFunctionBegin;
  PetscCall(MatGetRow(A, row, &size, &column, &value));
  const std::vector<PetscInt> &multipliers = columns.multipliers;
  auto next =
      size == 0 ? multipliers.end() : std::lower_bound(multipliers.begin(), multipliers.end(), *column - 2);
  for (PetscInt k = 0; k < size; ++k) { // rising columns
    while (next != multipliers.end() && *next + 3 <= column[k]) ++next;
    if (next != multipliers.end() && *next <= column[k]) continue;
    entries.emplace_back(column[k] - 3 * static_cast<PetscInt>(next - multipliers.begin()), value[k]);
  }
  PetscCall(MatRestoreRow(A, row, &size, &column, &value));
  PetscFunctionReturn(0);
}

/// Of row k of this rank's part of S what is not a product: A_uu and what holds still the directions that
/// nothing acts on.
PetscErrorCode Condensation::OwnRow(std::size_t k, SparseRow &entries)
{
  const PetscInt row = first_reduced + static_cast<PetscInt>(k);
  PetscFunctionBegin;
  entries.clear();
  PetscCall(AppendOwn(unknowns->displacement[k], entries));
  if (const auto next = slave_at.upper_bound(row); next != slave_at.begin()) {
    const auto &[start, a] = *std::prev(next);
    for (int j = 0; j < 3 && row - start < 3; ++j)
      entries.emplace_back(start + j, nodes[a].idle(row - start, j));
  }
  PetscFunctionReturn(0);
}

/// The columns of row k, rising. All products are there.
PetscErrorCode Condensation::ColumnsOfRow(std::size_t k, SparseRow &entries)
{
  PetscInt size;
  const PetscInt *column;
  const PetscInt row = first_reduced + static_cast<PetscInt>(k);
  PetscFunctionBegin;
  PetscCall(OwnRow(k, entries));
  for (Mat part : std::initializer_list<Mat>{parts.LA_iu, parts.A_usP, parts.LA_isP}) {
    PetscCall(MatGetRow(part, row, &size, &column, nullptr));
    for (PetscInt j = 0; j < size; ++j) entries.emplace_back(column[j], 0);
    PetscCall(MatRestoreRow(part, row, &size, &column, nullptr));
  }
  std::sort(entries.begin(), entries.end(), [](const auto &x, const auto &y) { return x.first < y.first; });
  const auto same = [](const auto &x, const auto &y) { return x.first == y.first; };
  entries.erase(std::unique(entries.begin(), entries.end(), same), entries.end());
  PetscFunctionReturn(0);
}

/// S with room for its rows.
PetscErrorCode Condensation::CreateReduced()
{
  SparseRow entries;
  MatNullSpace rigid;
  PetscFunctionBegin;
  const auto rows = static_cast<PetscInt>(unknowns->displacement.size());
  std::vector<PetscInt> on(rows), off(rows);
  for (PetscInt k = 0; k < rows; ++k) {
    PetscCall(ColumnsOfRow(k, entries));
    on[k] = static_cast<PetscInt>(std::count_if(entries.begin(), entries.end(), [&](const auto &entry) {
      return entry.first >= first_reduced && entry.first < first_reduced + rows;
    }));
    off[k] = static_cast<PetscInt>(entries.size()) - on[k];
  }
  PetscCall(MatCreate(comm_of(A), parts.S.put()));
  PetscCall(MatSetSizes(parts.S, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(parts.S, MATAIJ));
  if (unknowns->whole_nodes) PetscCall(MatSetBlockSize(parts.S, 3));
  PetscCall(MatSeqAIJSetPreallocation(parts.S, 0, on.data()));
  PetscCall(MatMPIAIJSetPreallocation(parts.S, 0, on.data(), 0, off.data()));
  PetscCall(MatSetOption(parts.S, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  if (!unknowns->whole_nodes) PetscFunctionReturn(0);
  PetscCall(MatNullSpaceCreateRigidBody(unknowns->place, &rigid));
  PetscCall(MatSetNearNullSpace(parts.S, rigid));
  PetscCall(MatNullSpaceDestroy(&rigid));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::AddOwnRows()
{
  SparseRow entries;
  std::vector<PetscInt> column;
  std::vector<PetscScalar> value;
  PetscFunctionBegin;
  for (std::size_t k = 0; k < unknowns->displacement.size(); ++k) {
    const PetscInt row = first_reduced + static_cast<PetscInt>(k);
    PetscCall(OwnRow(k, entries));
    column.clear();
    value.clear();
    for (const auto &[c, v] : entries) {
      column.push_back(c);
      value.push_back(v);
    }
    PetscCall(MatSetValues(parts.S, 1, &row, static_cast<PetscInt>(column.size()), column.data(),
                           value.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::AddRows(Mat product)
{
  PetscInt first_row, last_row, size;
  const PetscInt *column;
  const PetscScalar *value;
  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(product, &first_row, &last_row));
  for (PetscInt row = first_row; row < last_row; ++row) {
    PetscCall(MatGetRow(product, row, &size, &column, &value));
    PetscCall(MatSetValues(parts.S, 1, &row, size, column, value, ADD_VALUES));
    PetscCall(MatRestoreRow(product, row, &size, &column, &value));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Reduce()
{
  PetscFunctionBegin;
  PetscCall(Cut(A, parts.u, parts.s, parts.A_us));
  PetscCall(Cut(A, parts.u, parts.l, parts.A_ul));
  PetscCall(Cut(A, parts.i, parts.u, parts.A_iu));
  PetscCall(Cut(A, parts.i, parts.s, parts.A_is));
  PetscCall(BuildRight());
  PetscCall(BuildLeft());
  PetscCall(Multiply(parts.L, parts.A_is, parts.LA_is));
  PetscCall(MatGetOwnershipRange(parts.L, &first_reduced, nullptr));
  const struct {
    Mat left, right;
    MatHandle &product;
  } products[] = {{parts.L, parts.A_iu, parts.LA_iu},
                  {parts.A_us, parts.P, parts.A_usP},
                  {parts.LA_is, parts.P, parts.LA_isP}};
  if (!static_cast<Mat>(parts.S)) {
    for (const auto &[left, right, product] : products) PetscCall(Multiply(left, right, product));
    PetscCall(MatCreateVecs(parts.A_is, parts.of_slaves.put(), parts.of_interface.put()));
    PetscCall(MatCreateVecs(parts.A_iu, parts.displacements.put(), nullptr));
    PetscCall(CreateReduced());
  } else
    PetscCall(MatZeroEntries(parts.S));
  PetscCall(AddOwnRows());
  for (const auto &[left, right, product] : products) { // no two at once where an inner solver holds the rest
    if (!static_cast<Mat>(product)) PetscCall(Multiply(left, right, product));
    PetscCall(AddRows(product));
    product.reset();
  }
  PetscCall(Assemble(parts.S));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Restrict(Vec f, Vec g)
{
  const PetscScalar *values;
  PetscScalar *of_displacements, *w, *of_interface;
  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(f, &values));
  PetscCall(VecGetArrayWrite(g, &of_displacements));
  PetscCall(VecGetArrayWrite(parts.of_slaves, &w));
  PetscCall(VecGetArrayWrite(parts.of_interface, &of_interface));
  for (std::size_t k = 0; k < unknowns->displacement.size(); ++k)
    of_displacements[k] = values[unknowns->displacement[k] - first];
  PetscScalar *slave = w, *equation = of_interface;
  for (const InterfaceNode &node : nodes) {
    const Eigen::Map<const Eigen::Vector3d> condition(values + node.multiplier - first);
    if (node.whole()) {
      const Eigen::Vector3d held = node.holds * condition;
      equation = std::copy_n(values + node.slave - first, 3, equation);
      slave = std::copy_n(held.data(), 3, slave);
    }
    equation = std::copy_n(condition.data(), 3, equation);
  }
  PetscCall(VecRestoreArrayWrite(parts.of_interface, &of_interface));
  PetscCall(VecRestoreArrayWrite(parts.of_slaves, &w));
  PetscCall(VecRestoreArrayWrite(g, &of_displacements));
  PetscCall(VecRestoreArrayRead(f, &values));
  PetscCall(VecScale(parts.of_slaves, -1));
  PetscCall(MatMultAdd(parts.L, parts.of_interface, g, g));
  PetscCall(MatMultAdd(parts.A_us, parts.of_slaves, g, g));
  PetscCall(MatMultAdd(parts.LA_is, parts.of_slaves, g, g));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Extend(Vec f, Vec y, Vec x)
{
  const PetscScalar *values, *forces, *change;
  PetscScalar *displacement, *solution;
  PetscFunctionBegin;
  PetscCall(MatMult(parts.P, y, parts.of_slaves));
  PetscCall(VecCopy(y, parts.displacements));
  PetscCall(VecGetArrayRead(f, &values));
  PetscCall(VecGetArray(parts.displacements, &displacement));
  PetscCall(VecGetArrayRead(parts.of_slaves, &change));
  const auto given = [&](PetscInt row) { return Eigen::Map<const Eigen::Vector3d>(values + row - first); };
  for (const PetscScalar *held = change; const InterfaceNode &node : nodes) {
    if (!node.whole()) continue;
    Eigen::Map<Eigen::Vector3d>(displacement + columns.reduced(node.slave) - first_reduced) +=
        Eigen::Map<const Eigen::Vector3d>(held) + node.holds * given(node.multiplier);
    held += 3;
  }
  PetscCall(VecRestoreArrayRead(parts.of_slaves, &change));
  PetscCall(VecRestoreArray(parts.displacements, &displacement));
  PetscCall(MatMult(parts.A_iu, parts.displacements, parts.of_interface));
  PetscCall(VecGetArrayRead(parts.displacements, &change));
  PetscCall(VecGetArrayRead(parts.of_interface, &forces));
  PetscCall(VecGetArrayWrite(x, &solution));
  for (std::size_t k = 0; k < unknowns->displacement.size(); ++k)
    solution[unknowns->displacement[k] - first] = change[k];
  for (const PetscScalar *force = forces; const InterfaceNode &node : nodes) {
    Eigen::Map<Eigen::Vector3d> multiplier(solution + node.multiplier - first);
    multiplier.setZero();
    if (node.whole()) {
      multiplier = node.D_inverse * (given(node.slave) - Eigen::Map<const Eigen::Vector3d>(force));
      force += 3;
    }
    const Eigen::Vector3d condition =
        given(node.multiplier) - Eigen::Map<const Eigen::Vector3d>(force) - node.Z * multiplier;
    multiplier += node.alone * condition;
    force += 3;
  }
  PetscCall(VecRestoreArrayWrite(x, &solution));
  PetscCall(VecRestoreArrayRead(parts.of_interface, &forces));
  PetscCall(VecRestoreArrayRead(parts.displacements, &change));
  PetscCall(VecRestoreArrayRead(f, &values));
  PetscFunctionReturn(0);
}

} // namespace tribogel
