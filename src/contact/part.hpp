/// What every part of a scene's contact does: a slave surface on a master, or walls at the plates. Each slave
/// node belongs to exactly one part.
#pragma once

#include "contact/friction_memory.hpp"
#include "contact/plate_frames.hpp"

#include <petscmat.h>

#include <string>

namespace tribogel
{

class ContactPart
{
public:
  virtual ~ContactPart() = default;

  /// Before a step from U: which facets may touch during it. Collective.
  virtual PetscErrorCode BeginStep(const PlateFrames &, const double * /*U*/) { return 0; }

  /// Before each solve of that step: what made the last one fail may sit out.
  virtual void BeginAttempt() {}

  /// Contact forces and conditions are added to the local array `F` (at nodes that this rank owns) and their
  /// absolute parts to `magnitude`. On failure `failure` says why, on every rank. Collective.
  virtual PetscErrorCode AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                     const double *Udot, double *F, double *magnitude,
                                     std::string &failure) = 0;

  /// dF/dU + shift dF/dUdot, into `A` by global indices. Collective.
  virtual PetscErrorCode AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                     const double *Udot, double shift, Mat A, std::string &failure) = 0;

  /// dF / d travel [N/mm] and / d angle [N/rad] of the top plate, whose rates change by shift times as much,
  /// added to local arrays. Collective.
  virtual PetscErrorCode AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory,
                                         const double *U, const double *Udot, double shift, double *by_travel,
                                         double *by_turn, std::string &failure) = 0;

  /// Finds the pairs of facets that meet at U and whether the matrix pattern covers them; if not, the next
  /// AddPattern does, with room for further sliding. Collective.
  virtual PetscErrorCode UpdateCandidates(const PlateFrames &, const double * /*U*/, bool &covered)
  {
    covered = true;
    return 0;
  }
  virtual PetscErrorCode AddPattern(Mat A) const = 0;

  /// Round-off of the gap, as a force, added to the local array.
  virtual void AddRoundOff(double *magnitude) const = 0;

  /// What the top plate does to this rank's nodes of the part.
  virtual Wrench ReactionOfTopPlate(const double * /*U*/) const { return {}; }

  /// For each of which friction may remember a number.
  virtual std::size_t slave_nodes() const { return 0; }

  /// What friction remembers of them after a solve that ended at U. Collective.
  virtual PetscErrorCode Advance(const PlateFrames &, const FrictionMemory &, const double * /*U*/,
                                 const double * /*Udot*/, std::span<double> /*next*/)
  {
    return 0;
  }
};

} // namespace tribogel
