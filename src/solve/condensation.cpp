#include "solve/condensation.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace tribogel
{

namespace
{

using IsHandle = Handle<IS, ISDestroy>;

/// A direction is held where its condition depends on the multiplier this little, as the sine of an angle: what is
/// called held errs by that part, what is called free is stiffer than the gel by its inverse.
constexpr double held_below = 0.05;

constexpr double rank_tolerance = 1e-10; ///< of singular values, relative to the largest

MPI_Comm comm_of(Mat A)
{
  return PetscObjectComm(reinterpret_cast<PetscObject>(A));
}

PetscErrorCode CreateIs(MPI_Comm comm, const std::vector<PetscInt> &indices, IsHandle &is)
{
  PetscFunctionBegin;
  PetscCall(ISCreateGeneral(comm, static_cast<PetscInt>(indices.size()), indices.data(), PETSC_COPY_VALUES, is.put()));
  PetscFunctionReturn(0);
}

/// First indices of all ranks, sorted, without those that are absent.
PetscErrorCode GatherFirsts(MPI_Comm comm, const std::vector<PetscInt> &own, std::vector<PetscInt> &all)
{
  IsHandle mine, gathered;
  const PetscInt *indices;
  PetscInt size;
  PetscFunctionBegin;
  PetscCall(CreateIs(comm, own, mine));
  PetscCall(ISAllGather(mine, gathered.put()));
  PetscCall(ISGetLocalSize(gathered, &size));
  PetscCall(ISGetIndices(gathered, &indices));
  all.assign(indices, indices + size);
  PetscCall(ISRestoreIndices(gathered, &indices));
  std::sort(all.begin(), all.end());
  all.erase(all.begin(), std::lower_bound(all.begin(), all.end(), 0));
  PetscFunctionReturn(0);
}

/// Whether `index` is one of the three that begin at any of `firsts`.
bool among(const std::vector<PetscInt> &firsts, PetscInt index)
{
  const auto next = std::upper_bound(firsts.begin(), firsts.end(), index);
  return next != firsts.begin() && index < *std::prev(next) + 3;
}

/// A square matrix with the layout of A and room for `per_row[i]` entries in its rows, on and off this rank.
PetscErrorCode CreateLike(Mat A, const std::vector<PetscInt> &per_row, MatHandle &B)
{
  PetscInt rows, total;
  std::vector<PetscInt> on = per_row, off = per_row;
  PetscFunctionBegin;
  PetscCall(MatGetLocalSize(A, &rows, nullptr));
  PetscCall(MatGetSize(A, &total, nullptr));
  for (PetscInt &n : on) n = std::min(n, rows);
  for (PetscInt &n : off) n = std::min(n, total - rows);
  PetscCall(MatCreateAIJ(comm_of(A), rows, rows, total, total, 0, on.data(), 0, off.data(), B.put()));
  PetscCall(MatSetOption(B, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
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
PetscErrorCode SetBlock(Mat B, PetscInt row, PetscInt column, const Block &values, InsertMode mode)
{
  const PetscInt rows[] = {row, row + 1, row + 2}, columns[] = {column, column + 1, column + 2};
  PetscFunctionBegin;
  PetscCall(MatSetValues(B, 3, rows, 3, columns, values.data(), mode));
  PetscFunctionReturn(0);
}

using Square = Eigen::Matrix3d;
using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd &M)
{
  const Svd svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd &s = svd.singularValues();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(M.cols(), M.rows());
  for (Eigen::Index j = 0; j < s.size(); ++j)
    if (s[j] > rank_tolerance * s[0]) inverse += svd.matrixV().col(j) * svd.matrixU().col(j).transpose() / s[j];
  return inverse;
}

} // namespace

/// Step 2 of the header for one node.
void Condensation::Classify(NodeBlocks &node)
{
  const double force_per_multiplier = node.D.norm();
  if (force_per_multiplier == 0) { // a node that the contact has left out, or one of a plate
    node.force = node.keeps = Matrix3::Identity();
    node.alone = pseudo_inverse(node.Z);
    return;
  }
  node.D_inverse = pseudo_inverse(node.D);
  const Eigen::MatrixXd lame = Square::Identity() - node.D_inverse * node.D; // multipliers without a force
  node.alone = lame * pseudo_inverse(node.Z * lame);
  const double stiffness = node.K.trace() / 3, kappa = stiffness / force_per_multiplier;

  Eigen::Matrix<double, 6, 3> both;
  both << kappa * node.Z.transpose(), node.H.transpose();
  const Eigen::HouseholderQR<Eigen::Matrix<double, 6, 3>> qr(both);
  const Square R = qr.matrixQR().topRows<3>().template triangularView<Eigen::Upper>();
  const Eigen::Matrix<double, 6, 3> Q = qr.householderQ() * Eigen::Matrix<double, 6, 3>::Identity();
  const Eigen::JacobiSVD<Square> svd(Q.topRows<3>().transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Square &U = svd.matrixU(), &V = svd.matrixV();
  const Square combine = U.transpose() * R.transpose().inverse(); // of the conditions

  const auto held = (svd.singularValues().array() <= held_below).count(); // the last ones
  for (Eigen::Index j = 0; j < 3 - held; ++j) {
    const Eigen::Vector3d v = V.col(j);
    node.force += v * v.transpose();
    node.condition -= v * (v.dot(node.D * v) * kappa / svd.singularValues()[j]) * combine.row(j);
  }
  node.keeps = Matrix3::Identity();
  if (held == 0) return;
  const Eigen::MatrixXd N = combine.bottomRows(held) * node.H, N_inverse = pseudo_inverse(N);
  const Square holding = N_inverse * N; // projection on the directions that are held
  node.holds = N_inverse * combine.bottomRows(held);
  node.keeps -= holding;
  node.idle = stiffness * V.rightCols(held) * V.rightCols(held).transpose() * holding;
}

/// The node's three rows of forces (kind 0) or conditions (1) into its blocks.
PetscErrorCode Condensation::ReadRows(int kind, const ColumnSets &sets, NodeBlocks &node)
{
  PetscFunctionBegin;
  for (int i = 0; i < 3; ++i) {
    const PetscInt row = (kind == 0 ? node.slave : node.multiplier) + i, *column;
    const PetscScalar *value;
    PetscInt entries;
    PetscCall(MatGetRow(A, row, &entries, &column, &value));
    for (PetscInt k = 0; k < entries; ++k) {
      const PetscInt to_slave = column[k] - node.slave, to_multiplier = column[k] - node.multiplier;
      if (node.slave >= 0 && to_slave >= 0 && to_slave < 3)
        (kind == 0 ? node.K : node.H)(i, to_slave) = value[k];
      else if (to_multiplier >= 0 && to_multiplier < 3)
        (kind == 0 ? node.D : node.Z)(i, to_multiplier) = value[k];
      else if (kind == 1 && value[k] != 0 && !among(sets.slaves, column[k]) && !among(sets.multipliers, column[k])) {
        auto place = std::find(node.master.begin(), node.master.end(), column[k]);
        if (place == node.master.end()) {
          node.master.push_back(column[k]);
          met.grown = true;
          node.B.conservativeResize(3, node.B.cols() + 1);
          node.B.rightCols<1>().setZero();
          place = std::prev(node.master.end());
        }
        node.B(i, place - node.master.begin()) = value[k];
      }
    }
    PetscCall(MatRestoreRow(A, row, &entries, &column, &value));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::ReadNodes()
{
  ColumnSets sets;
  PetscFunctionBegin;
  PetscCall(GatherFirsts(comm_of(A), unknowns->slave, sets.slaves));
  PetscCall(GatherFirsts(comm_of(A), unknowns->multiplier, sets.multipliers));
  nodes.assign(unknowns->multiplier.size(), {});
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    nodes[a].slave = unknowns->slave[a];
    nodes[a].multiplier = unknowns->multiplier[a];
    nodes[a].master = met.masters[a];
    nodes[a].B.setZero(3, static_cast<Eigen::Index>(met.masters[a].size()));
    for (int kind = nodes[a].slave < 0 ? 1 : 0; kind < 2; ++kind) PetscCall(ReadRows(kind, sets, nodes[a]));
    met.masters[a] = nodes[a].master;
    Classify(nodes[a]);
  }
  PetscFunctionReturn(0);
}

/// P: of all unknowns, by the displacements.
PetscErrorCode Condensation::BuildRight(IS displacements)
{
  MatHandle square;
  IsHandle all;
  PetscInt first, last;
  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(A, &first, &last));
  std::vector<PetscInt> per_row(last - first, 0);
  for (PetscInt row : unknowns->displacement) per_row[row - first] = 1;
  for (const NodeBlocks &node : nodes)
    for (int i = 0; i < 3 && node.slave >= 0; ++i)
      per_row[node.slave + i - first] = 3 + static_cast<PetscInt>(node.master.size());
  PetscCall(CreateLike(A, per_row, square));
  for (PetscInt row : unknowns->displacement)
    if (per_row[row - first] == 1) PetscCall(MatSetValue(square, row, row, 1, INSERT_VALUES));
  for (const NodeBlocks &node : nodes) {
    if (node.slave < 0) continue;
    PetscCall(SetBlock(square, node.slave, node.slave, node.keeps, INSERT_VALUES));
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> W = -node.holds * node.B;
    const PetscInt own[] = {node.slave, node.slave + 1, node.slave + 2};
    PetscCall(MatSetValues(square, 3, own, static_cast<PetscInt>(node.master.size()), node.master.data(), W.data(),
                           INSERT_VALUES));
  }
  PetscCall(Assemble(square));
  PetscCall(ISCreateStride(comm_of(A), last - first, first, 1, all.put()));
  PetscCall(MatCreateSubMatrix(square, all, displacements, MAT_INITIAL_MATRIX, P.put()));
  PetscFunctionReturn(0);
}

/// -G D^-1: what displacements' equations take of the slave's forces; n rows as displacements, columns as A.
PetscErrorCode Condensation::Eliminate(IS displacements, MatHandle &eliminated)
{
  MatHandle square, inverse, G;
  IsHandle all, multipliers;
  PetscInt first, last;
  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(A, &first, &last));
  std::vector<PetscInt> per_row(last - first, 0), conditions;
  for (const NodeBlocks &node : nodes)
    for (int i = 0; i < 3; ++i) {
      conditions.push_back(node.multiplier + i);
      if (node.slave >= 0) per_row[node.multiplier + i - first] = 3;
    }
  PetscCall(CreateLike(A, per_row, square));
  for (const NodeBlocks &node : nodes) {
    const Matrix3 minus = -node.D_inverse;
    if (node.slave >= 0) PetscCall(SetBlock(square, node.multiplier, node.slave, minus, INSERT_VALUES));
  }
  PetscCall(Assemble(square));
  PetscCall(ISCreateStride(comm_of(A), last - first, first, 1, all.put()));
  PetscCall(CreateIs(comm_of(A), conditions, multipliers));
  PetscCall(MatCreateSubMatrix(A, displacements, multipliers, MAT_INITIAL_MATRIX, G.put()));
  PetscCall(MatCreateSubMatrix(square, multipliers, all, MAT_INITIAL_MATRIX, inverse.put()));
  PetscCall(MatMatMult(G, inverse, MAT_INITIAL_MATRIX, PETSC_DEFAULT, eliminated.put()));
  PetscFunctionReturn(0);
}

/// Adds the columns of M's entries in this row to `met`, and says so.
PetscErrorCode Condensation::Remember(Mat M, PetscInt row, std::vector<PetscInt> &met_there)
{
  const PetscInt *column;
  const PetscScalar *value;
  PetscInt size;
  PetscFunctionBegin;
  PetscCall(MatGetRow(M, row, &size, &column, &value));
  for (PetscInt k = 0; k < size; ++k) {
    if (value[k] == 0 || std::find(met_there.begin(), met_there.end(), column[k]) != met_there.end()) continue;
    met_there.push_back(column[k]);
    met.grown = true;
  }
  PetscCall(MatRestoreRow(M, row, &size, &column, &value));
  PetscFunctionReturn(0);
}

/// L: equations of the displacements, by all equations.
PetscErrorCode Condensation::BuildLeft(IS displacements)
{
  MatHandle square, eliminated;
  IsHandle all;
  PetscInt first, last, reduced;
  PetscFunctionBegin;
  PetscCall(Eliminate(displacements, eliminated));
  PetscCall(MatGetOwnershipRange(A, &first, &last));
  PetscCall(MatGetOwnershipRange(eliminated, &reduced, nullptr));
  std::vector<PetscInt> per_row(last - first, 0);
  std::vector<bool> of_slave(last - first, false);
  for (const NodeBlocks &node : nodes)
    for (int i = 0; i < 3 && node.slave >= 0; ++i) of_slave[node.slave + i - first] = true;
  for (std::size_t r = 0; r < unknowns->displacement.size(); ++r) {
    const PetscInt row = unknowns->displacement[r] - first;
    per_row[row] = of_slave[row] ? 6 : 1;
    if (!of_slave[row]) PetscCall(Remember(eliminated, reduced + static_cast<PetscInt>(r), met.slaves[r]));
    if (!of_slave[row]) per_row[row] += static_cast<PetscInt>(met.slaves[r].size());
  }
  PetscCall(CreateLike(A, per_row, square));
  for (std::size_t r = 0; r < unknowns->displacement.size(); ++r) {
    const PetscInt row = unknowns->displacement[r], *column;
    const PetscScalar *value;
    PetscInt size;
    if (of_slave[row - first]) continue;
    PetscCall(MatSetValue(square, row, row, 1, INSERT_VALUES));
    for (PetscInt k : met.slaves[r]) PetscCall(MatSetValue(square, row, k, 0, INSERT_VALUES));
    PetscCall(MatGetRow(eliminated, reduced + static_cast<PetscInt>(r), &size, &column, &value));
    for (PetscInt k = 0; k < size; ++k)
      if (value[k] != 0) PetscCall(MatSetValue(square, row, column[k], value[k], INSERT_VALUES));
    PetscCall(MatRestoreRow(eliminated, reduced + static_cast<PetscInt>(r), &size, &column, &value));
  }
  for (const NodeBlocks &node : nodes) {
    if (node.slave < 0) continue;
    PetscCall(SetBlock(square, node.slave, node.slave, node.force, INSERT_VALUES));
    PetscCall(SetBlock(square, node.slave, node.multiplier, node.condition, INSERT_VALUES));
  }
  PetscCall(Assemble(square));
  PetscCall(ISCreateStride(comm_of(A), last - first, first, 1, all.put()));
  PetscCall(MatCreateSubMatrix(square, displacements, all, MAT_INITIAL_MATRIX, L.put()));
  PetscFunctionReturn(0);
}

/// S, in its old place where the pattern has not changed.
PetscErrorCode Condensation::Reduce()
{
  MatHandle AP;
  Mat reduced = S;
  const bool anew = !reduced;
  PetscInt first;
  PetscFunctionBegin;
  PetscCall(MatMatMult(A, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, AP.put()));
  PetscCall(MatMatMult(L, AP, anew ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX, PETSC_DEFAULT, anew ? S.put() : &reduced));
  PetscCall(MatGetOwnershipRange(S, &first, nullptr));
  for (const NodeBlocks &node : nodes) {
    if (node.slave < 0) continue;
    const auto place = std::lower_bound(unknowns->displacement.begin(), unknowns->displacement.end(), node.slave);
    const auto row = first + static_cast<PetscInt>(place - unknowns->displacement.begin());
    PetscCall(SetBlock(S, row, row, node.idle, ADD_VALUES));
  }
  PetscCall(Assemble(S));
  if (anew && unknowns->whole_nodes) {
    MatNullSpace rigid;
    PetscCall(MatSetBlockSize(S, 3));
    PetscCall(MatNullSpaceCreateRigidBody(unknowns->place, &rigid));
    PetscCall(MatSetNearNullSpace(S, rigid));
    PetscCall(MatNullSpaceDestroy(&rigid));
  }
  PetscFunctionReturn(0);
}

/// The parts of A that couple the slave's unknowns with all others.
PetscErrorCode Condensation::CutInterface()
{
  IsHandle all, interface, slaves;
  std::vector<PetscInt> interface_rows, slave_columns;
  PetscInt first, last;
  PetscFunctionBegin;
  for (const NodeBlocks &node : nodes)
    for (int i = 0; i < 6; ++i) {
      if (i < 3 && node.slave < 0) continue;
      interface_rows.push_back(i < 3 ? node.slave + i : node.multiplier + i - 3);
      if (i < 3) slave_columns.push_back(node.slave + i);
    }
  PetscCall(MatGetOwnershipRange(A, &first, &last));
  PetscCall(ISCreateStride(comm_of(A), last - first, first, 1, all.put()));
  PetscCall(CreateIs(comm_of(A), interface_rows, interface));
  PetscCall(CreateIs(comm_of(A), slave_columns, slaves));
  PetscCall(MatCreateSubMatrix(A, interface, all, MAT_INITIAL_MATRIX, equations.put()));
  PetscCall(MatCreateSubMatrix(A, all, slaves, MAT_INITIAL_MATRIX, prescribed.put()));
  PetscCall(MatCreateVecs(equations, nullptr, on_interface.put()));
  PetscCall(MatCreateVecs(prescribed, on_slave.put(), residual.put()));
  PetscCall(VecDuplicate(residual, held.put()));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Read(Mat given, const std::shared_ptr<const ContactUnknowns> &list, bool &anew)
{
  IsHandle displacements;
  PetscObjectState pattern_now;
  PetscFunctionBegin;
  unknowns = list;
  PetscCall(MatGetNonzeroState(given, &pattern_now));
  if (given != static_cast<Mat>(A) || pattern_now != pattern) met = {};
  pattern = pattern_now;
  met.masters.resize(unknowns->multiplier.size());
  met.slaves.resize(unknowns->displacement.size());
  met.grown = !static_cast<Mat>(S) || given != static_cast<Mat>(A);
  PetscCall(PetscObjectReference(reinterpret_cast<PetscObject>(given)));
  *A.put() = given;
  PetscCall(ReadNodes());
  PetscCall(CreateIs(comm_of(A), unknowns->displacement, displacements));
  PetscCall(BuildRight(displacements));
  PetscCall(BuildLeft(displacements));
  PetscCallMPI(MPI_Allreduce(&met.grown, &anew, 1, MPI_CXX_BOOL, MPI_LOR, comm_of(A)));
  PetscCall(CutInterface());
  if (anew) S.reset();
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Restrict(Vec f, Vec g)
{
  const PetscScalar *values;
  PetscScalar *w, *s;
  PetscInt first, k = 0;
  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(f, &first, nullptr));
  PetscCall(VecZeroEntries(held));
  PetscCall(VecGetArrayRead(f, &values));
  PetscCall(VecGetArray(held, &w));
  PetscCall(VecGetArray(on_slave, &s));
  for (const NodeBlocks &node : nodes) {
    if (node.slave < 0) continue;
    Eigen::Map<Eigen::Vector3d> u(w + node.slave - first);
    u = node.holds * Eigen::Map<const Eigen::Vector3d>(values + node.multiplier - first);
    Eigen::Map<Eigen::Vector3d>(s + k) = u;
    k += 3;
  }
  PetscCall(VecRestoreArray(on_slave, &s));
  PetscCall(VecRestoreArray(held, &w));
  PetscCall(VecRestoreArrayRead(f, &values));
  PetscCall(MatMult(prescribed, on_slave, residual));
  PetscCall(VecAYPX(residual, -1, f));
  PetscCall(MatMult(L, residual, g));
  PetscFunctionReturn(0);
}

PetscErrorCode Condensation::Extend(Vec f, Vec y, Vec x)
{
  const PetscScalar *values, *forces;
  PetscScalar *solution;
  PetscInt first, k = 0;
  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(f, &first, nullptr));
  PetscCall(MatMultAdd(P, y, held, x));
  PetscCall(MatMult(equations, x, on_interface));
  PetscCall(VecGetArrayRead(f, &values));
  PetscCall(VecGetArrayRead(on_interface, &forces));
  PetscCall(VecGetArray(x, &solution));
  const auto given = [&](PetscInt row) { return Eigen::Map<const Eigen::Vector3d>(values + row - first); };
  for (const NodeBlocks &node : nodes) {
    Eigen::Map<Eigen::Vector3d> multiplier(solution + node.multiplier - first);
    if (node.slave >= 0) {
      multiplier = node.D_inverse * (given(node.slave) - Eigen::Map<const Eigen::Vector3d>(forces + k));
      k += 3;
    }
    const Eigen::Vector3d condition =
        given(node.multiplier) - Eigen::Map<const Eigen::Vector3d>(forces + k) - node.Z * multiplier;
    multiplier += node.alone * condition;
    k += 3;
  }
  PetscCall(VecRestoreArray(x, &solution));
  PetscCall(VecRestoreArrayRead(on_interface, &forces));
  PetscCall(VecRestoreArrayRead(f, &values));
  PetscFunctionReturn(0);
}

} // namespace tribogel
