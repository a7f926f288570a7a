/// One slave node's rows of the contact Jacobian (3.14), and which directions contact conditions hold there
/// (THEORY 3.8, step 2).
#pragma once

#include "support/petsc_handles.hpp"

#include <Eigen/Core>

#include <vector>

namespace tribogel
{

/// Which unknowns are what, owned by this rank, by global index.
struct ContactUnknowns {
  std::vector<PetscInt> displacement; ///< all of them, rising
  std::vector<PetscInt> slave,
      multiplier;          ///< first of three, of each node with multiplier; slave -1 if prescribed
  bool whole_nodes = true; ///< every node has three displacements or none, on all ranks
  VecHandle place;         ///< of the node of each displacement, at rest [mm]; block size 3

  /// Order 2: all displacements by those of the cells' vertices, and `place` for the latter; null without.
  MatHandle from_vertices;
  VecHandle vertex_place;
};

/// First indices of the nodes of all ranks, rising.
struct InterfaceColumns {
  std::vector<PetscInt> slaves, multipliers;

  PetscErrorCode Gather(MPI_Comm comm, const ContactUnknowns &unknowns);
  bool has(PetscInt column) const; ///< a slave's displacement or a multiplier

  /// Index among the displacements alone of a displacement's column.
  PetscInt reduced(PetscInt column) const;
};

struct InterfaceNode {
  using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  PetscInt slave = -1, multiplier = -1; ///< as in ContactUnknowns
  Matrix3 K = Matrix3::Zero(), D = Matrix3::Zero(), H = Matrix3::Zero(),
          Z = Matrix3::Zero();  ///< its own blocks
  std::vector<PetscInt> master; ///< columns of B, whatever their values
  Eigen::Matrix<double, 3, Eigen::Dynamic> B;

  Matrix3 D_inverse = Matrix3::Zero();                          ///< pseudo-inverse
  Matrix3 force = Matrix3::Zero(), condition = Matrix3::Zero(); ///< what L takes of F_s and C
  Matrix3 keeps = Matrix3::Zero();                              ///< X X^T
  Matrix3 holds = Matrix3::Zero(); ///< w: u_s of the held directions from C - B u_r
  Matrix3 idle = Matrix3::Zero();  ///< equation of what is held, so that S is regular
  Matrix3 alone = Matrix3::Zero(); ///< multiplier from its own condition, where no force depends on it

  bool whole() const { return slave >= 0; } ///< none of its displacements is prescribed

  /// Reads the node's rows of A and decides what is held.
  PetscErrorCode Read(Mat A, const InterfaceColumns &columns);

  /// The second half of it, from K, D, H and Z.
  void Classify();

private:
  PetscErrorCode ReadRow(Mat A, PetscInt row, int i, Matrix3 &by_slave, Matrix3 &by_multiplier,
                         const InterfaceColumns *masters);
};

} // namespace tribogel
