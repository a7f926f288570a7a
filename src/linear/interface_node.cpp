#include "linear/interface_node.hpp"

#include <Eigen/Dense>

#include <algorithm>

namespace tribogel
{

namespace
{

/// A direction is held where its condition depends on the multiplier this little, as the sine of an angle:
/// what is called held errs by that part, what is called free is stiffer than the gel by its inverse.
constexpr double held_below = 0.05;

constexpr double rank_tolerance = 1e-10; ///< of singular values, relative to the largest

using Square = Eigen::Matrix3d;

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd &M)
{
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd &s = svd.singularValues();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(M.cols(), M.rows());
  for (Eigen::Index j = 0; j < s.size(); ++j)
    if (s[j] > rank_tolerance * s[0])
      inverse += svd.matrixV().col(j) * svd.matrixU().col(j).transpose() / s[j];
  return inverse;
}

/// Projection on the directions that D takes to nothing. Exactly zero if there are none: 1 - D^-1 D would be
/// round-off, and its pseudo-inverse the inverse of that.
Square null_projection(const Square &D)
{
  const Eigen::JacobiSVD<Square> svd(D, Eigen::ComputeFullV);
  const auto rank = (svd.singularValues().array() > rank_tolerance * svd.singularValues()[0]).count();
  return svd.matrixV().rightCols(3 - rank) * svd.matrixV().rightCols(3 - rank).transpose();
}

/// First indices of all ranks, sorted, without those that are absent.
PetscErrorCode GatherFirsts(MPI_Comm comm, const std::vector<PetscInt> &own, std::vector<PetscInt> &all)
{
  IS mine, gathered;
  const PetscInt *indices;
  PetscInt size;
  PetscFunctionBegin;
  PetscCall(ISCreateGeneral(comm, static_cast<PetscInt>(own.size()), own.data(), PETSC_USE_POINTER, &mine));
  PetscCall(ISAllGather(mine, &gathered));
  PetscCall(ISGetLocalSize(gathered, &size));
  PetscCall(ISGetIndices(gathered, &indices));
  all.assign(indices, indices + size);
  PetscCall(ISRestoreIndices(gathered, &indices));
  PetscCall(ISDestroy(&gathered));
  PetscCall(ISDestroy(&mine));
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

} // namespace

PetscErrorCode InterfaceColumns::Gather(MPI_Comm comm, const ContactUnknowns &unknowns)
{
  PetscFunctionBegin;
  PetscCall(GatherFirsts(comm, unknowns.slave, slaves));
  PetscCall(GatherFirsts(comm, unknowns.multiplier, multipliers));
  PetscFunctionReturn(0);
}

bool InterfaceColumns::has(PetscInt column) const
{
  return among(slaves, column) || among(multipliers, column);
}

PetscInt InterfaceColumns::reduced(PetscInt column) const
{
  const auto before = std::lower_bound(multipliers.begin(), multipliers.end(), column) - multipliers.begin();
  return column - 3 * static_cast<PetscInt>(before);
}

PetscErrorCode InterfaceNode::ReadRow(Mat A, PetscInt row, int i, Matrix3 &by_slave, Matrix3 &by_multiplier,
                                      const InterfaceColumns *masters)
{
  PetscInt entries;
  const PetscInt *column;
  const PetscScalar *value;
  PetscFunctionBegin;
  PetscCall(MatGetRow(A, row, &entries, &column, &value));
  for (PetscInt k = 0; k < entries; ++k) {
    const PetscInt to_slave = column[k] - slave, to_multiplier = column[k] - multiplier;
    if (whole() && to_slave >= 0 && to_slave < 3)
      by_slave(i, to_slave) = value[k];
    else if (to_multiplier >= 0 && to_multiplier < 3)
      by_multiplier(i, to_multiplier) = value[k];
    else if (masters && !masters->has(column[k])) {
      const auto place = std::find(master.begin(), master.end(), column[k]);
      const auto j = place - master.begin();
      if (place == master.end()) {
        master.push_back(column[k]);
        B.conservativeResize(3, j + 1);
        B.rightCols<1>().setZero();
      }
      B(i, j) = value[k];
    }
  }
  PetscCall(MatRestoreRow(A, row, &entries, &column, &value));
  PetscFunctionReturn(0);
}

PetscErrorCode InterfaceNode::Read(Mat A, const InterfaceColumns &columns)
{
  PetscFunctionBegin;
  for (int i = 0; i < 3; ++i) {
    if (whole()) PetscCall(ReadRow(A, slave + i, i, K, D, nullptr));
    PetscCall(ReadRow(A, multiplier + i, i, H, Z, &columns));
  }
  Classify();
  PetscFunctionReturn(0);
}

void InterfaceNode::Classify()
{
  D_inverse = force = condition = keeps = holds = idle = Matrix3::Zero();
  const double force_per_multiplier = D.norm();
  if (force_per_multiplier == 0) { // a node that the contact has left out, or one of a plate
    force = keeps = Matrix3::Identity();
    alone = pseudo_inverse(Z);
    return;
  }
  D_inverse = pseudo_inverse(D);
  const Square lame = null_projection(D); // multipliers without a force
  alone = lame.isZero(0) ? lame : Square(lame * pseudo_inverse(Z * lame));
  const double stiffness = K.trace() / 3, kappa = stiffness / force_per_multiplier;

  Eigen::Matrix<double, 6, 3> both;
  both << kappa * Z.transpose(), H.transpose();
  const Eigen::HouseholderQR<Eigen::Matrix<double, 6, 3>> qr(both);
  const Square R = qr.matrixQR().topRows<3>().template triangularView<Eigen::Upper>();
  const Eigen::Matrix<double, 6, 3> Q = qr.householderQ() * Eigen::Matrix<double, 6, 3>::Identity();
  const Eigen::JacobiSVD<Square> svd(Q.topRows<3>().transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Square &U = svd.matrixU(), &V = svd.matrixV();
  const Square combine = U.transpose() * R.transpose().inverse(); // of the conditions

  const auto held = (svd.singularValues().array() <= held_below).count(); // the last ones
  for (Eigen::Index j = 0; j < 3 - held; ++j) {
    const Eigen::Vector3d v = V.col(j);
    force += v * v.transpose();
    condition -= v * (v.dot(D * v) * kappa / svd.singularValues()[j]) * combine.row(j);
  }
  keeps = Matrix3::Identity();
  if (held == 0) return;
  const Eigen::MatrixXd N = combine.bottomRows(held) * H, N_inverse = pseudo_inverse(N);
  const Square holding = N_inverse * N; // projection on the directions that are held
  holds = N_inverse * combine.bottomRows(held);
  keeps -= holding;
  idle = stiffness * V.rightCols(held) * V.rightCols(held).transpose() * holding;
}

} // namespace tribogel
