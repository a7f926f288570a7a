/// All contact of a scene: the top gel's lower face on the bottom gel, its wall that rolls on, the walls at
/// the plates. Every slave node belongs to exactly one of them.
#pragma once

#include "contact/gel_on_gel.hpp"
#include "contact/wall_on_plate.hpp"

namespace tribogel
{

struct ContactResults {
  std::vector<SurfaceResults>
      surfaces;                 ///< the lower face, then the wall (if it may touch); empty for a single gel
  double force = 0, torque = 0; ///< that the gels transmit, signed as the plate's reactions [N, N mm]
  Wrench wall;                  ///< what the top plate does to a wall, all ranks'
};

class Contact
{
public:
  PetscErrorCode SetUp(MPI_Comm comm, const Mesh &mesh, const Scene &scene);

  /// Before a step from U: which part of the wall may roll onto the bottom gel during it. Collective.
  PetscErrorCode BeginStep(const PlateFrames &frames, const double *U);

  /// Before each solve of that step: a part of the wall that made the last one fail sits out.
  void BeginAttempt();

  /// Contact forces and conditions are added to the local array `F` (at nodes that this rank owns) and their
  /// absolute parts to `magnitude`. On failure `failure` says why, on every rank. Collective.
  PetscErrorCode AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double *F, double *magnitude, std::string &failure);

  /// dF/dU + shift dF/dUdot, into `A`. Collective.
  PetscErrorCode AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double shift, Mat A, std::string &failure);

  /// dF / d travel [N/mm] and / d angle [N/rad] of the top plate through the contact, whose rates change by
  /// shift times as much, added to local arrays. Collective.
  PetscErrorCode AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                 const double *Udot, double shift, double *by_travel, double *by_turn,
                                 std::string &failure);

  /// What friction remembers of contacts that have just been made; empty for a law without memory.
  FrictionHistory InitialHistory() const;

  /// What it remembers after a solve that ended at U. Collective.
  PetscErrorCode Advance(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                         const double *Udot, FrictionHistory &next);

  /// Where undeformed gels stand so: the share of the top one's face that hangs over the edge of the bottom
  /// one's, or why they cannot. Collective.
  PetscErrorCode AtRest(const PlateFrames &frames, double &share, std::string &failure)
  {
    return gels.front().AtRest(frames, share, failure);
  }

  /// Finds the pairs of facets that meet at U and whether the matrix pattern covers them; if not, the next
  /// AddPattern does, with room for further sliding. Collective.
  PetscErrorCode UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered);
  PetscErrorCode AddPattern(Mat A) const;

  /// Round-off of the gap, as a force, added to the local array.
  void AddRoundOff(double *magnitude) const;

  PetscErrorCode Results(const PlateFrames &frames, const double *U, const double *Udot,
                         ContactResults &results, const FrictionMemory &memory = {});

  /// What the top plate does to this rank's wall nodes.
  Wrench WallReaction(const double *U) const;

  bool between_gels() const { return !gels.empty(); }
  const GelOnGel &lower_face() const { return gels.front(); }
  double overhang() const { return gels.front().overhang; }

  /// Reference place on the top gel of a facet that could not be evaluated last; empty: there was none.
  std::optional<std::array<double, 3>> failed_at() const
  {
    for (const GelOnGel &gel : gels)
      if (gel.failed_at) return gel.failed_at;
    return {};
  }

private:
  MPI_Comm comm = MPI_COMM_NULL;
  Friction friction;
  std::vector<GelOnGel> gels;
  std::vector<WallOnPlate> plates;
};

} // namespace tribogel
