/// Contact of a body's side wall with the rigid plates in the PETSc world. Each node is handled by the rank
/// that owns it; nothing is communicated.
#pragma once

#include "contact/plate_frames.hpp"
#include "mesh/mesh.hpp"

namespace tribogel
{

struct PlateNodeBlock;

class WallOnPlate
{
public:
  /// The nodes of `wall` with a multiplier, save those in `taken` (indices into the surface).
  void SetUp(const Mesh &mesh, const Scene &scene, int body, const Surface &wall,
             const std::vector<bool> &taken);

  void AddResidual(const PlateFrames &frames, const double *U, double *F, double *magnitude) const;
  PetscErrorCode AddJacobian(const PlateFrames &frames, const double *U, Mat A) const;
  PetscErrorCode AddPattern(Mat A) const;

  /// dF / d travel of the top plate: of a gel between both plates, against whose frame it moves.
  void AddTravelSlope(const PlateFrames &frames, const double *U, double *by_travel) const;
  void AddRoundOff(double *magnitude) const;

  /// What the plate above the body does to this rank's nodes.
  Wrench ReactionOfTopPlate(const double *U) const;

private:
  struct WallNode {
    int node;      ///< index into Mesh::nodes
    double D, c_N; ///< as in CurveGeometry
    bool above;    ///< which plate
    double gap;    ///< of the undeformed node, while the plates do not move against the body's frame [mm]
  };

  PlateNodeBlock Block(const WallNode &wall_node, const PlateFrames &frames, const double *U) const;

  const Mesh *mesh = nullptr;
  Vector3<double> up{0, 0, 1}; ///< the plates' normal
  bool spans_both =
      false; ///< one gel between the plates: the upper one moves against the frame of its unknowns
  std::vector<WallNode> nodes;
  double extent = 0; ///< of the scene, for round-off [mm]
};

} // namespace tribogel
