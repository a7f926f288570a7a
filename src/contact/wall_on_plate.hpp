/// Contact of a body's side wall with the rigid plates in the PETSc world. Each node is handled by the rank
/// that owns it; nothing is communicated.
#pragma once

#include "contact/part.hpp"
#include "mesh/mesh.hpp"

namespace tribogel
{

struct PlateNodeBlock;

class WallOnPlate final : public ContactPart
{
public:
  /// The nodes of `wall` with a multiplier, save those in `taken` (indices into the surface).
  void SetUp(const Mesh &mesh, const Scene &scene, int body, const Surface &wall,
             const std::vector<bool> &taken);

  PetscErrorCode AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double *F, double *magnitude, std::string &failure) override;
  PetscErrorCode AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                             const double *Udot, double shift, Mat A, std::string &failure) override;
  PetscErrorCode AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                 const double *Udot, double shift, double *by_travel, double *by_turn,
                                 std::string &failure) override;
  PetscErrorCode AddPattern(Mat A) const override;
  void AddRoundOff(double *magnitude) const override;
  Wrench ReactionOfTopPlate(const double *U) const override;

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
