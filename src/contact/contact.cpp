#include "contact/contact.hpp"

namespace tribogel
{

namespace
{

/// The lower half of a wall, which is nearer to the other gel than to its own plate; `taken` marks its nodes.
Surface lower_half(const Surface &wall, std::vector<bool> &taken)
{
  const double foot = wall.node[wall.facet.front()[0]].X[1], head = wall.node[wall.facet.back()[1]].X[1];
  Surface half;
  std::vector<int> place(wall.node.size(), -1);
  for (const auto &facet : wall.facet) {
    if (wall.node[facet[1]].X[1] > 0.5 * (foot + head)) break;
    std::array<int, 9> own;
    own.fill(-1);
    for (int b : {0, 2, 1}) {
      if (facet[b] < 0) continue;
      if (place[facet[b]] < 0) {
        place[facet[b]] = static_cast<int>(half.node.size());
        half.node.push_back(wall.node[facet[b]]);
        taken[facet[b]] = true;
      }
      own[b] = place[facet[b]];
    }
    half.facet.push_back(own);
  }
  return half;
}

} // namespace

PetscErrorCode Contact::SetUp(MPI_Comm on, const Mesh &mesh, const Scene &scene)
{
  PetscFunctionBeginUser;
  comm = on;
  if (scene.has_top) {
    gels.emplace_back();
    PetscCall(gels.back().SetUp(comm, mesh, scene, mesh.slave, false));
  }
  for (int body : {bottom_body, top_body}) {
    const Surface &wall = mesh.wall[body];
    if (wall.facet.empty()) continue;
    std::vector<bool> taken(wall.node.size(), false);
    if (mesh.dim == 3) { // the crease belongs to the lower face; no wall rolls on
      for (std::size_t a = 0; a < wall.node.size(); ++a)
        taken[a] = wall.node[a].local >= 0 && mesh.nodes[wall.node[a].local].on(Side::slave);
    } else if (body == top_body) {
      taken[wall.facet.front()[0]] = true; // the crease
      const Surface lower = lower_half(wall, taken);
      if (!lower.facet.empty()) {
        gels.emplace_back();
        PetscCall(gels.back().SetUp(comm, mesh, scene, lower, true));
      }
    }
    plates.emplace_back();
    plates.back().SetUp(mesh, scene, body, wall, taken);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::BeginStep(const PlateFrames &frames, const double *U)
{
  PetscFunctionBeginUser;
  for (GelContact &gel : gels) PetscCall(gel.BeginStep(frames, U));
  PetscFunctionReturn(0);
}

void Contact::BeginAttempt()
{
  for (GelContact &gel : gels) gel.BeginAttempt();
}

PetscErrorCode Contact::AddResidual(const PlateFrames &frames, const double *U, const double *Udot, double *F,
                                    double *magnitude, std::string &failure)
{
  PetscFunctionBeginUser;
  for (GelContact &gel : gels)
    if (failure.empty()) PetscCall(gel.AddResidual(frames, U, Udot, F, magnitude, failure));
  for (const PlateContact &plate : plates) plate.AddResidual(frames, U, F, magnitude);
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddJacobian(const PlateFrames &frames, const double *U, const double *Udot, double shift, Mat A,
                                    std::string &failure)
{
  PetscFunctionBeginUser;
  for (GelContact &gel : gels)
    if (failure.empty()) PetscCall(gel.AddJacobian(frames, U, Udot, shift, A, failure));
  for (const PlateContact &plate : plates) PetscCall(plate.AddJacobian(frames, U, A));
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  PetscFunctionBeginUser;
  covered = true;
  for (GelContact &gel : gels) {
    bool inside;
    PetscCall(gel.UpdateCandidates(frames, U, inside));
    covered = covered && inside;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddPattern(Mat A) const
{
  PetscFunctionBeginUser;
  for (const GelContact &gel : gels) PetscCall(gel.AddPattern(A));
  for (const PlateContact &plate : plates) PetscCall(plate.AddPattern(A));
  PetscFunctionReturn(0);
}

void Contact::AddRoundOff(double *magnitude) const
{
  for (const GelContact &gel : gels) gel.AddRoundOff(magnitude);
  for (const PlateContact &plate : plates) plate.AddRoundOff(magnitude);
}

Wrench Contact::WallReaction(const double *U) const
{
  Wrench wrench;
  for (const PlateContact &plate : plates) wrench += plate.ReactionOfTopPlate(U);
  return wrench;
}

PetscErrorCode Contact::Results(const PlateFrames &frames, const double *U, const double *Udot, ContactResults &results)
{
  PetscFunctionBeginUser;
  results = {};
  for (GelContact &gel : gels) {
    SurfaceResults surface;
    double force, torque;
    PetscCall(gel.Results(frames, U, Udot, surface, force, torque));
    results.force += force;
    results.torque += torque;
    results.surfaces.push_back(std::move(surface));
  }
  results.wall = WallReaction(U);
  for (Vector3<double> *part : {&results.wall.force, &results.wall.moment})
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, part->data(), 3, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

} // namespace tribogel
