/// Contact of a slave surface of the top gel (its lower face, or its wall that may roll) with the bottom gel
/// in the PETSc world, in the half plane or in 3-D: both surfaces are small, so every rank holds their nodal
/// values; the slave nodes are shared out evenly, whatever the bulk's partition is, and the forces go home by
/// one reduction.
#pragma once

#include "contact/contact_operator.hpp"
#include "contact/friction_memory.hpp"
#include "contact/plate_frames.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tribogel
{

/// What a slave surface of the top gel looks like at one state; the same on every rank.
struct SurfaceResults {
  std::vector<NodeResult> nodes;           ///< of the slave
  std::vector<SurfacePlace> slave, master; ///< where the nodes are
  std::vector<bool> on_crease;             ///< of a wall: nodes that belong to the lower face; empty on that
};

class GelOnGel
{
public:
  /// `on_crease` marks the nodes of a side wall that belong to the lower face; empty: the slave is that face.
  PetscErrorCode SetUp(MPI_Comm comm, const Mesh &mesh, const Scene &scene, Surface slave,
                       std::vector<bool> on_crease);

  /// Before a step from U: which facets of a wall may touch during it. Collective.
  PetscErrorCode BeginStep(const PlateFrames &frames, const double *U);

  /// Before each solve of that step.
  void BeginAttempt();

  /// Contact forces and conditions are added to the local array `F` (at nodes that this rank owns) and their
  /// absolute parts to `magnitude`. On failure `failure` says why, on every rank. Collective.
  PetscErrorCode AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double *F, double *magnitude, std::string &failure);

  /// dF/dU + shift dF/dUdot, into `A` by global indices. Collective.
  PetscErrorCode AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double shift, Mat A, std::string &failure);

  /// What is remembered after a solve that ended at U: nodes that are open forget. `next` is the slave's.
  /// Collective.
  PetscErrorCode Advance(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                         const double *Udot, std::span<double> next);

  /// dF / d travel and / d angle of the top plate, whose rates change by shift times as much, into local
  /// arrays. Collective.
  PetscErrorCode AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                 const double *Udot, double shift, double *by_travel, double *by_turn,
                                 std::string &failure);

  /// Where undeformed gels stand so: the share of the slave that hangs over the master's edge, or why they
  /// cannot. Collective.
  PetscErrorCode AtRest(const PlateFrames &frames, double &share, std::string &failure);

  /// Finds the pairs of facets that meet at U and whether the matrix pattern covers them; if not, the next
  /// AddPattern does, with room for further sliding. Collective.
  PetscErrorCode UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered);
  PetscErrorCode AddPattern(Mat A) const;

  /// Round-off of the gap, as a force, added to the local array.
  void AddRoundOff(double *magnitude) const;

  /// Nodal results of the slave, and force [N] and torque [N mm] that the tractions transmit, signed as the
  /// plate's reactions; the same on every rank. Collective.
  PetscErrorCode Results(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                         const double *Udot, SurfaceResults &results, double &force, double &torque);

  std::size_t slave_nodes() const { return slave.node.size(); }

  /// Of each slave node: whether it carries a multiplier, and the constant diagonal of the mortar matrix
  /// [mm^2].
  struct Weight {
    bool carries;
    double D;
  };
  std::vector<Weight> weights() const;

  /// Of slave node a in the last evaluation by a single rank.
  NodeResult result(int a) const;

  /// Of the nodes that carry a multiplier, in the last evaluation of a residual or Jacobian by a single rank.
  std::vector<ContactStatus> statuses() const;

  /// Reference place of a facet that could not be evaluated, of the last evaluation; the same on every rank.
  std::optional<std::array<double, 3>> failed_at;

  /// Of the slave beyond the master's edge in the last evaluation, reference length or area [mm or mm^2].
  double overhang = 0;

private:
  PetscErrorCode Gather(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                        ContactState<double> &state, const FrictionMemory &memory = {}) const;
  void Unpack(const PlateFrames &frames, const std::vector<double> &values, double shift,
              ContactState<double> &state) const;
  PetscErrorCode Evaluate(const ContactState<double> &state, bool derivatives, std::string &failure);
  void Indices(const std::vector<ContactUnknown> &unknowns, std::vector<PetscInt> &indices) const;
  PetscErrorCode Add(const ContactBlock &block, Mat A) const;
  PetscErrorCode AddSurfaceSums(std::vector<double> &sums, double *one, double *other) const;
  PetscErrorCode ShareFailure(const MortarReport &report, std::string &failure);

  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, size = 1;
  int first = 0, last = 0; ///< this rank's share of the slave nodes
  const Mesh *mesh = nullptr;
  Surface slave;
  std::optional<ContactOperator> model;
  std::vector<int> failed;        ///< wall facets that could not be evaluated in the last attempt
  ContactOperator::Pairs pattern; ///< pairs of facets that the matrix has room for
  double margin = 0;              ///< sliding that the pattern allows for [mm]
  PetscLogEvent search_event = 0, mortar_event = 0;
};

} // namespace tribogel
