/// The contact Jacobian without its multipliers and without the slave displacements that contact conditions
/// prescribe (THEORY 3.8).
///
/// Rows and columns of the Jacobian A in blocks: r displacements of all nodes that carry no multiplier, s
/// displacements of the slave nodes, l their multipliers. Node by node, three of each,
///
///     forces      F_r:  K_rr u_r + K_rs u_s + G l  = f_r
///                 F_s:  K_sr u_r + K_ss u_s + D l  = f_s       D block diagonal, since the multiplier's
///                 basis is dual
///     conditions  C:    B u_r    + H u_s    + Z l  = f_C       H, Z block diagonal but for the turning of
///     normals
///
/// 1. F_r - G D^-1 F_s is free of l.
/// 2. The rows of [Z kappa, H] of a node, kappa = K_aa/D, made orthonormal, and the singular values of the
/// part with Z
///    say which directions are held (closed, sticking: Z = 0 there) and which are free. A free direction
///    keeps its force row, its multiplier replaced by the condition; a held one gives its displacement, u_s =
///    X u_f + W u_r + w(f_C).
/// 3. S = (E + L) A (E' + P) with E and E' = E^T what takes displacements from all unknowns. L, P have
/// entries for the
///    interface only: with u all displacements and i the equations F_s, C of the interface,
///
///        S = A_uu + L A_iu + (A_us + L A_is) P        (3.15)
///
///    so that nothing the size of A is made beside S. Held directions of slave nodes remain as unknowns that
///    nothing acts on, so that every node has three.
///
/// Eliminating multipliers alone (1) leaves a spectrum on which smoothers fail; with 2 it is that of an
/// elastic body. What is left out, H between neighbours, is small of the order of gaps: S is for
/// preconditioning.
///
/// All patterns follow from that of A, whatever the values: S, and what inner solvers have derived from it,
/// lasts as long as A's pattern. (With entries only where nodes have met S is smaller, but while surfaces
/// move each Newton iteration makes new ones meet: multigrid was set up anew each time, a fifth of the time
/// at 1.15 million unknowns.)
#pragma once

#include "linear/interface_node.hpp"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace tribogel
{

class Condensation
{
public:
  /// Whether reduced() will be another matrix than before (`anew`), or the same one with new values; whoever
  /// holds the old one lets go before Reduce. Collective.
  PetscErrorCode Read(Mat A, const std::shared_ptr<const ContactUnknowns> &unknowns, bool &anew);

  /// Computes reduced(). Collective.
  PetscErrorCode Reduce();

  /// Right-hand side of S y = g for A x = f, and x from y. Collective.
  PetscErrorCode Restrict(Vec f, Vec g);
  PetscErrorCode Extend(Vec f, Vec y, Vec x);

  Mat reduced() const { return parts.S; } ///< has the rigid body modes as its near null space

private:
  using IsHandle = Handle<IS, ISDestroy>;
  using SparseRow = std::vector<std::pair<PetscInt, PetscScalar>>; ///< columns and values

  PetscErrorCode List();
  PetscErrorCode BuildRight();
  PetscErrorCode Eliminate();
  PetscErrorCode BuildLeft();
  PetscErrorCode AppendOwn(PetscInt row, SparseRow &entries);
  PetscErrorCode OwnRow(std::size_t k, SparseRow &entries);
  PetscErrorCode ColumnsOfRow(std::size_t k, SparseRow &entries);
  PetscErrorCode CreateReduced();
  PetscErrorCode AddOwnRows();
  PetscErrorCode AddRows(Mat product);

  std::shared_ptr<const ContactUnknowns> unknowns;
  MatHandle A;
  PetscObjectState pattern = 0; ///< of A
  InterfaceColumns columns;
  std::vector<InterfaceNode> nodes;
  std::map<PetscInt, std::size_t> slave_at; ///< whole nodes by the first of their rows of S
  PetscInt first = 0, first_reduced = 0;    ///< own rows of A, of S

  /// What lasts as long as the pattern of A. Rows and columns: u displacements, s slaves' displacements, l
  /// multipliers, i for each node its three force rows (unless prescribed) and its three conditions.
  struct {
    IsHandle u, s, l, i;
    MatHandle A_us, A_iu, A_is, A_ul;
    MatHandle minus_D_inverse; ///< l by i
    MatHandle eliminated;      ///< u by i
    MatHandle L, P;            ///< u by i; s by u
    MatHandle LA_is;
    MatHandle LA_iu, LA_isP, A_usP; ///< only while S is summed: inner solvers need the room
    MatHandle S;
    VecHandle of_interface, of_slaves, displacements;
  } parts;
};

} // namespace tribogel
