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
  std::vector<std::unique_ptr<ContactPart>> walls;
  PetscFunctionBeginUser;
  comm = on;
  friction = scene.friction;
  const auto add_gel = [&](const Surface &slave, std::vector<bool> on_crease) {
    auto gel = std::make_unique<GelOnGel>();
    gels.push_back(gel.get());
    parts.push_back(std::move(gel));
    return gels.back()->SetUp(comm, mesh, scene, slave, std::move(on_crease));
  };
  if (scene.has_contact()) PetscCall(add_gel(mesh.slave, {}));
  for (int body : {bottom_body, top_body}) {
    const Surface &wall = mesh.wall[body];
    if (wall.facet.empty()) continue;
    std::vector<bool> taken(wall.node.size(), false);
    if (body == top_body) {
      taken = crease_of(wall, mesh.slave);
      const Surface lower = lower_half(wall, mesh.dim - 1, taken);
      if (!lower.facet.empty()) PetscCall(add_gel(lower, crease_of(lower, mesh.slave)));
    }
    auto at_plates = std::make_unique<WallOnPlate>();
    at_plates->SetUp(mesh, scene, body, wall, taken);
    walls.push_back(std::move(at_plates));
  }
  for (auto &wall : walls) parts.push_back(std::move(wall));
  PetscFunctionReturn(0);
}

template <class OfPart>
PetscErrorCode Contact::EachPart(const FrictionMemory &memory, const OfPart &of_part) const
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  for (const auto &part : parts) {
    PetscCall(of_part(*part, memory.part(node, part->slave_nodes())));
    node += part->slave_nodes();
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::BeginStep(const PlateFrames &frames, const double *U)
{
  PetscFunctionBeginUser;
  for (const auto &part : parts) PetscCall(part->BeginStep(frames, U));
  PetscFunctionReturn(0);
}

void Contact::BeginAttempt()
{
  for (const auto &part : parts) part->BeginAttempt();
}

PetscErrorCode Contact::AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                    const double *Udot, double *F, double *magnitude, std::string &failure)
{
  PetscFunctionBeginUser;
  for (GelOnGel *gel : gels) gel->failed_at.reset();
  PetscCall(EachPart(memory, [&](ContactPart &part, const FrictionMemory &own) -> PetscErrorCode {
    return failure.empty() ? part.AddResidual(frames, own, U, Udot, F, magnitude, failure) : 0;
  }));
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                    const double *Udot, double shift, Mat A, std::string &failure)
{
  PetscFunctionBeginUser;
  for (GelOnGel *gel : gels) gel->failed_at.reset();
  PetscCall(EachPart(memory, [&](ContactPart &part, const FrictionMemory &own) -> PetscErrorCode {
    return failure.empty() ? part.AddJacobian(frames, own, U, Udot, shift, A, failure) : 0;
  }));
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory,
                                        const double *U, const double *Udot, double shift, double *by_travel,
                                        double *by_turn, std::string &failure)
{
  PetscFunctionBeginUser;
  PetscCall(EachPart(memory, [&](ContactPart &part, const FrictionMemory &own) -> PetscErrorCode {
    return failure.empty() ? part.AddMotionSlopes(frames, own, U, Udot, shift, by_travel, by_turn, failure)
                           : 0;
  }));
  PetscFunctionReturn(0);
}

FrictionHistory Contact::InitialHistory() const
{
  FrictionHistory history;
  if (!friction.has_memory()) return history;
  std::size_t nodes = 0;
  for (const auto &part : parts) nodes += part->slave_nodes();
  history.values.assign(nodes, friction.law()->initial_memory());
  return history;
}

PetscErrorCode Contact::Advance(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                const double *Udot, FrictionHistory &next)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  next.values.resize(memory.start.size());
  PetscCall(EachPart(memory, [&](ContactPart &part, const FrictionMemory &own) {
    const std::span<double> values = std::span(next.values).subspan(node, part.slave_nodes());
    node += part.slave_nodes();
    return part.Advance(frames, own, U, Udot, values);
  }));
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  PetscFunctionBeginUser;
  covered = true;
  for (const auto &part : parts) {
    bool inside;
    PetscCall(part->UpdateCandidates(frames, U, inside));
    covered = covered && inside;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddPattern(Mat A) const
{
  PetscFunctionBeginUser;
  for (const auto &part : parts) PetscCall(part->AddPattern(A));
  PetscFunctionReturn(0);
}

void Contact::AddRoundOff(double *magnitude) const
{
  for (const auto &part : parts) part->AddRoundOff(magnitude);
}

Wrench Contact::WallReaction(const double *U) const
{
  Wrench wrench;
  for (const auto &part : parts) wrench += part->ReactionOfTopPlate(U);
  return wrench;
}

PetscErrorCode Contact::Results(const PlateFrames &frames, const double *U, const double *Udot,
                                ContactResults &results, const FrictionMemory &memory)
{
  std::size_t node = 0;
  PetscFunctionBeginUser;
  results = {};
  for (GelOnGel *gel : gels) {
    SurfaceResults surface;
    double force, torque;
    const FrictionMemory own = memory.part(node, gel->slave_nodes());
    PetscCall(gel->Results(frames, own, U, Udot, surface, force, torque));
    node += gel->slave_nodes();
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
