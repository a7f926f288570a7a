/// The contact Jacobian without its multipliers and without the slave displacements that contact conditions prescribe
/// (THEORY 3.8).
///
/// Rows and columns of the Jacobian A in blocks: r displacements of all nodes that carry no multiplier, s displacements
/// of the slave nodes, l their multipliers. Node by node, three of each,
///
///     forces      F_r:  K_rr u_r + K_rs u_s + G l  = f_r
///                 F_s:  K_sr u_r + K_ss u_s + D l  = f_s       D block diagonal, since the multiplier's basis is dual
///     conditions  C:    B u_r    + H u_s    + Z l  = f_C       H, Z block diagonal but for the turning of normals
///
/// 1. F_r - G D^-1 F_s is free of l.
/// 2. The rows of [Z kappa, H] of a node, kappa = K_aa/D, made orthonormal, and the singular values of the part with Z
///    say which directions are held (closed, sticking: Z = 0 there) and which are free. A free direction keeps its
///    force row, its multiplier replaced by the condition; a held one gives its displacement, u_s = X u_f + W u_r +
///    w(f_C).
/// 3. S = L A P, L the left combinations of 1 and 2, P = [1; X X^T, W]. Held directions of slave nodes remain as
///    unknowns that nothing acts on, so that every node has three.
///
/// Eliminating multipliers alone (1) leaves a spectrum on which smoothers fail; with 2 it is that of an elastic body.
/// What is left out, H between neighbours, is small of the order of gaps: S is for preconditioning.
#pragma once

#include "support/petsc_handles.hpp"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace tribogel
{

/// Which unknowns are what, owned by this rank, by global index.
struct ContactUnknowns {
  std::vector<PetscInt> displacement;      ///< all of them
  std::vector<PetscInt> slave, multiplier; ///< first of three, of each node with multiplier; slave -1 if prescribed
  bool whole_nodes = true;                 ///< every node has three displacements or none, on all ranks
  VecHandle place;                         ///< of the node of each displacement, deformed [mm]; block size 3
};

class Condensation
{
public:
  /// Whether reduced() will be another matrix than before (`anew`), or the same one with new values. Collective.
  PetscErrorCode Read(Mat A, const std::shared_ptr<const ContactUnknowns> &unknowns, bool &anew);

  /// Computes reduced(); where it is another matrix than before, whoever holds the old one lets go first. Collective.
  PetscErrorCode Reduce();

  /// Right-hand side of S y = g for A x = f, and x from y. Collective.
  PetscErrorCode Restrict(Vec f, Vec g);
  PetscErrorCode Extend(Vec f, Vec y, Vec x);

  Mat reduced() const { return S; } ///< has the rigid body modes as its near null space

private:
  using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

  /// Of one slave node, all 3 x 3.
  struct NodeBlocks {
    PetscInt slave, multiplier;
    Matrix3 K = Matrix3::Zero(), D = Matrix3::Zero(), H = Matrix3::Zero(), Z = Matrix3::Zero();
    Matrix3 D_inverse = Matrix3::Zero();                          ///< pseudo-inverse
    Matrix3 force = Matrix3::Zero(), condition = Matrix3::Zero(); ///< what L takes of F_s and C
    Matrix3 keeps = Matrix3::Zero();                              ///< X X^T
    Matrix3 holds = Matrix3::Zero();                              ///< w: u_s of the held directions from C - B u_r
    Matrix3 idle = Matrix3::Zero();                               ///< equation of what is held, so that S is regular
    Matrix3 alone = Matrix3::Zero(); ///< multiplier from its own condition, where no force depends on it
    std::vector<PetscInt> master;    ///< columns of B
    Eigen::Matrix<double, 3, Eigen::Dynamic> B;
  };

  /// First indices of all ranks' nodes, sorted.
  struct ColumnSets {
    std::vector<PetscInt> slaves, multipliers;
  };

  PetscErrorCode ReadRows(int kind, const ColumnSets &sets, NodeBlocks &node);
  PetscErrorCode ReadNodes();
  PetscErrorCode BuildRight(IS displacements);
  PetscErrorCode Eliminate(IS displacements, MatHandle &eliminated);
  PetscErrorCode Remember(Mat M, PetscInt row, std::vector<PetscInt> &met_there);
  PetscErrorCode BuildLeft(IS displacements);
  PetscErrorCode CutInterface();
  static void Classify(NodeBlocks &node);

  std::shared_ptr<const ContactUnknowns> unknowns;
  MatHandle A, P, L, S;
  PetscObjectState pattern = 0;    ///< of A
  MatHandle equations, prescribed; ///< of A: of the interface's equations, of the slave displacements
  VecHandle held, residual, on_interface, on_slave;
  std::vector<NodeBlocks> nodes;

  /// Nodes that have met since A has its pattern. L and P keep their entries, so that the pattern of S, and what inner
  /// solvers have derived from it, is that of the iteration before unless new ones meet.
  struct {
    std::vector<std::vector<PetscInt>> masters, slaves; ///< columns: by slave node; by displacement
    bool grown = false;
  } met;
};

} // namespace tribogel
