#include "contact/contact.hpp"

#include <algorithm>
#include <set>

namespace tribogel
{

namespace
{

/// The lower half of a wall, which is nearer to the other gel than to its own plate; `taken` marks its nodes.
Surface lower_half(const Surface &wall, int axial, std::vector<bool> &taken)
{
  const auto height = [&](int a) { return wall.node[static_cast<std::size_t>(a)].X[axial]; };
  double foot = height(0), head = height(0);
  for (int a = 0; a < static_cast<int>(wall.node.size()); ++a) {
    foot = std::min(foot, height(a));
    head = std::max(head, height(a));
  }
  std::vector<bool> used(wall.node.size(), false);
  std::vector<std::array<int, 9>> facets;
  for (const auto &facet : wall.facet) {
    if (std::any_of(facet.begin(), facet.end(),
                    [&](int a) { return a >= 0 && height(a) > 0.5 * (foot + head); }))
      continue;
    facets.push_back(facet);
    for (int a : facet)
      if (a >= 0) used[a] = true;
  }
  Surface half;
  std::vector<int> place(wall.node.size(), -1);
  for (std::size_t a = 0; a < used.size(); ++a) {
    if (!used[a]) continue;
    taken[a] = true;
    place[a] = static_cast<int>(half.node.size());
    half.node.push_back(wall.node[a]);
  }
  for (auto &facet : facets)
    for (int &a : facet)
      if (a >= 0) a = place[a];
  half.facet = std::move(facets);
  return half;
}

/// Nodes of a wall that belong to the lower face too: the crease. A node is known by its unknowns.
std::vector<bool> crease_of(const Surface &wall, const Surface &face)
{
  std::set<PetscInt> unknowns;
  for (const SurfaceNode &node : face.node) unknowns.insert(node.displacement[0]);
  std::vector<bool> shared;
  for (const SurfaceNode &node : wall.node)
    shared.push_back(node.displacement[0] >= 0 && unknowns.count(node.displacement[0]) > 0);
  return shared;
}

} // namespace

PetscErrorCode Contact::SetUp(MPI_Comm on, const Mesh &mesh, const Scene &scene)
{
  PetscFunctionBeginUser;
  comm = on;
  friction = scene.friction;
  if (scene.has_contact()) {
    gels.emplace_back();
    PetscCall(gels.back().SetUp(comm, mesh, scene, mesh.slave, {}));
  }
  for (int body : {bottom_body, top_body}) {
    const Surface &wall = mesh.wall[body];
    if (wall.facet.empty()) continue;
    std::vector<bool> taken(wall.node.size(), false);
    if (body == top_body) {
      taken = crease_of(wall, mesh.slave);
      const Surface lower = lower_half(wall, mesh.dim - 1, taken);
      if (!lower.facet.empty()) {
        gels.emplace_back();
        PetscCall(gels.back().SetUp(comm, mesh, scene, lower, crease_of(lower, mesh.slave)));
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
  for (GelOnGel &gel : gels) PetscCall(gel.BeginStep(frames, U));
  PetscFunctionReturn(0);
}

void Contact::BeginAttempt()
{
  for (GelOnGel &gel : gels) gel.BeginAttempt();
}

PetscErrorCode Contact::AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                    const double *Udot, double *F, double *magnitude, std::string &failure)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  for (GelOnGel &gel : gels) gel.failed_at.reset();
  for (GelOnGel &gel : gels) {
    const FrictionMemory own = memory.part(node, gel.slave_nodes());
    if (failure.empty()) PetscCall(gel.AddResidual(frames, own, U, Udot, F, magnitude, failure));
    node += gel.slave_nodes();
  }
  for (const WallOnPlate &plate : plates) plate.AddResidual(frames, U, F, magnitude);
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                    const double *Udot, double shift, Mat A, std::string &failure)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  for (GelOnGel &gel : gels) gel.failed_at.reset();
  for (GelOnGel &gel : gels) {
    const FrictionMemory own = memory.part(node, gel.slave_nodes());
    if (failure.empty()) PetscCall(gel.AddJacobian(frames, own, U, Udot, shift, A, failure));
    node += gel.slave_nodes();
  }
  for (const WallOnPlate &plate : plates) PetscCall(plate.AddJacobian(frames, U, A));
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory,
                                        const double *U, const double *Udot, double shift, double *by_travel,
                                        double *by_turn, std::string &failure)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  for (GelOnGel &gel : gels) {
    const FrictionMemory own = memory.part(node, gel.slave_nodes());
    if (failure.empty())
      PetscCall(gel.AddMotionSlopes(frames, own, U, Udot, shift, by_travel, by_turn, failure));
    node += gel.slave_nodes();
  }
  for (const WallOnPlate &plate : plates) plate.AddTravelSlope(frames, U, by_travel);
  PetscFunctionReturn(0);
}

FrictionHistory Contact::InitialHistory() const
{
  FrictionHistory history;
  if (!friction.has_memory()) return history;
  std::size_t nodes = 0;
  for (const GelOnGel &gel : gels) nodes += gel.slave_nodes();
  history.values.assign(nodes, friction.law()->initial_memory());
  return history;
}

PetscErrorCode Contact::Advance(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                const double *Udot, FrictionHistory &next)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  next.values.resize(memory.start.size());
  for (GelOnGel &gel : gels) {
    const std::span<double> own = std::span(next.values).subspan(node, gel.slave_nodes());
    PetscCall(gel.Advance(frames, memory.part(node, gel.slave_nodes()), U, Udot, own));
    node += gel.slave_nodes();
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  PetscFunctionBeginUser;
  covered = true;
  for (GelOnGel &gel : gels) {
    bool inside;
    PetscCall(gel.UpdateCandidates(frames, U, inside));
    covered = covered && inside;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddPattern(Mat A) const
{
  PetscFunctionBeginUser;
  for (const GelOnGel &gel : gels) PetscCall(gel.AddPattern(A));
  for (const WallOnPlate &plate : plates) PetscCall(plate.AddPattern(A));
  PetscFunctionReturn(0);
}

void Contact::AddRoundOff(double *magnitude) const
{
  for (const GelOnGel &gel : gels) gel.AddRoundOff(magnitude);
  for (const WallOnPlate &plate : plates) plate.AddRoundOff(magnitude);
}

Wrench Contact::WallReaction(const double *U) const
{
  Wrench wrench;
  for (const WallOnPlate &plate : plates) wrench += plate.ReactionOfTopPlate(U);
  return wrench;
}

PetscErrorCode Contact::Results(const PlateFrames &frames, const double *U, const double *Udot,
                                ContactResults &results, const FrictionMemory &memory)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  results = {};
  for (GelOnGel &gel : gels) {
    SurfaceResults surface;
    double force, torque;
    const FrictionMemory own = memory.part(node, gel.slave_nodes());
    PetscCall(gel.Results(frames, own, U, Udot, surface, force, torque));
    node += gel.slave_nodes();
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
