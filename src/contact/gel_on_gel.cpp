#include "contact/gel_on_gel.hpp"

#include "tribogel/scene/overhang.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribogel
{

namespace
{

/// Sliding that a matrix pattern allows for, in facets. A whole facet makes the condensed matrix in space
/// (linear/) a fifth larger and MUMPS 7 % slower than half a one; a quarter rebuilds the pattern more often
/// and gains nothing.
constexpr double margin_in_facets = 0.5;

std::string describe(MortarStatus status, int dim, const SurfaceNode &near, bool wall)
{
  const char *why = status == MortarStatus::folded          ? "a contact facet is folded"
                    : status == MortarStatus::no_projection ? "a contact facet cannot be projected"
                                                            : "a contact facet meets nothing";
  return std::string(why) + " near " + describe_place(dim, near.X) + " of the top gel's " +
         (wall ? "side wall" : "lower face");
}

} // namespace

PetscErrorCode GelOnGel::SetUp(MPI_Comm on, const Mesh &both, const Scene &scene, Surface surface,
                               std::vector<bool> on_crease)
{
  PetscFunctionBeginUser;
  comm = on;
  PetscClassId id;
  PetscCall(PetscClassIdRegister("tribogel contact", &id));
  PetscCall(PetscLogEventRegister("GelContactSearch", id, &search_event));
  PetscCall(PetscLogEventRegister("GelContactMortar", id, &mortar_event));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  mesh = &both;
  slave = std::move(surface);
  for (std::size_t a = 0; a < on_crease.size(); ++a)
    if (on_crease[a]) { // its multiplier belongs to the lower face
      slave.node[a].multiplier = false;
      slave.node[a].traction.fill(-1);
    }
  model.emplace(both, scene, slave, std::move(on_crease));
  const auto nodes = static_cast<int>(slave.node.size());
  first = static_cast<int>(static_cast<long>(nodes) * rank / size);
  last = static_cast<int>(static_cast<long>(nodes) * (rank + 1) / size);
  margin = margin_in_facets * model->facet_size();

  ContactState<double> rest;
  const std::vector<double> zero(9 * (slave.node.size() + mesh->master.node.size()), 0.0);
  PlateFrames touching;
  touching.top_travel = -scene.initial_gap;
  touching.top_axis = scene.misalignment.offset;
  Unpack(touching, zero, 1, rest);
  pattern = model->candidate_pairs(rest, margin);
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::BeginStep(const PlateFrames &frames, const double *U)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  if (!model->is_wall()) PetscFunctionReturn(0);
  PetscCall(Gather(frames, U, nullptr, 1, state));
  model->roll(state);
  for (;;) { // only facets that can be projected now
    const auto nodes = static_cast<int>(slave.node.size());
    const MortarReport report = model->update(state, model->candidate_pairs(state, 0), false, 0, nodes);
    if (report.failed.empty()) break;
    model->touch(model->touching_without(report.failed));
  }
  failed.clear();
  PetscFunctionReturn(0);
}

/// Wall facets that the last attempt could not project sit out the next.
void GelOnGel::BeginAttempt()
{
  if (!model->is_wall() || failed.empty()) return;
  model->touch(model->touching_without(failed));
  failed.clear();
}

/// The nine values of each node (u, rate, multiplier; slave nodes first) as the model wants them.
void GelOnGel::Unpack(const PlateFrames &frames, const std::vector<double> &values, double shift,
                      ContactState<double> &state) const
{
  const std::size_t slaves = slave.node.size();
  const auto vector = [&](std::size_t node, int part) {
    return Vector3<double>(&values[9 * node + 3 * static_cast<std::size_t>(part)]);
  };
  state = {};
  state.shift = shift;
  state.stick_rate = 1 / frames.step;
  for (std::size_t n = 0; n < slaves + mesh->master.node.size(); ++n) {
    SurfaceState<double> &surface = n < slaves ? state.slave : state.master;
    surface.u.push_back(vector(n, 0));
    surface.rate.push_back(vector(n, 1));
    if (n < slaves) state.multiplier.push_back(vector(n, 2));
  }
  state.slave.travel = frames.top_travel;
  state.slave.travel_rate = frames.top_travel_rate;
  state.slave.rotation_rate = frames.top_rate;
  state.master.rotation_rate = frames.bottom_rate;
  state.slave.rotation = frames.top_rotation;
  state.slave_axis = frames.top_axis;
  state.master.rotation = frames.bottom_rotation;
}

PetscErrorCode GelOnGel::AtRest(const PlateFrames &frames, double &share, std::string &failure)
{
  ContactState<double> state;
  const std::vector<double> zero(9 * (slave.node.size() + mesh->master.node.size()), 0.0);
  PetscFunctionBeginUser;
  Unpack(frames, zero, 1, state);
  PetscCall(Evaluate(state, false, failure));
  share = overhang / model->slave_size();
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::Gather(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                                ContactState<double> &state, const FrictionMemory &memory) const
{
  const std::size_t slaves = slave.node.size(), nodes = slaves + mesh->master.node.size();
  std::vector<double> values(9 * nodes,
                             0.0); // every node is filled by its owner; the sum with zeros is exact
  PetscFunctionBeginUser;
  for (std::size_t n = 0; n < nodes; ++n) {
    const SurfaceNode &node = n < slaves ? slave.node[n] : mesh->master.node[n - slaves];
    if (node.local < 0) continue;
    const Node &place = mesh->nodes[node.local];
    for (int i = 0; i < 3; ++i) {
      values[9 * n + i] = U[place.displacement + i];
      values[9 * n + 3 + i] = Udot ? Udot[place.displacement + i] : 0;
      if (place.traction >= 0) values[9 * n + 6 + i] = U[place.traction + i];
    }
  }
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm));
  Unpack(frames, values, shift, state);
  state.memory.assign(memory.start.begin(), memory.start.end());
  state.weights = memory.weights;
  PetscFunctionReturn(0);
}

/// Mortar integrals of this rank's share of the slave nodes; every rank learns of a failure on any.
PetscErrorCode GelOnGel::Evaluate(const ContactState<double> &state, bool derivatives, std::string &failure)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(search_event, 0, 0, 0, 0));
  const auto pairs = model->candidate_pairs(state, 0);
  PetscCall(PetscLogEventEnd(search_event, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(mortar_event, 0, 0, 0, 0));
  const MortarReport report = model->update(state, pairs, derivatives, first, last);
  PetscCall(PetscLogEventEnd(mortar_event, 0, 0, 0, 0));
  // What of the wall lies beyond the master's edge is far from it, or rolls on the extension of its end.
  double beyond = model->is_wall() ? 0 : report.overhang;
  PetscCallMPI(MPI_Allreduce(&beyond, &overhang, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscCall(ShareFailure(report, failure));
  if (failure.empty() && overhang > largest_overhang * model->slave_size()) {
    std::ostringstream text;
    text << "the top gel hangs over the edge of the bottom gel by " << overhang
         << (mesh->dim == 2 ? " mm" : " mm^2") << ", " << 100 * overhang / model->slave_size()
         << " % of its face (at most " << 100 * largest_overhang << " % may)";
    failure = text.str();
  }
  PetscFunctionReturn(0);
}

/// Every rank learns which facets failed on any.
PetscErrorCode GelOnGel::ShareFailure(const MortarReport &report, std::string &failure)
{
  PetscFunctionBeginUser;
  struct {
    int status, facet;
  } worst{static_cast<int>(report.status), report.failed.empty() ? 0 : report.failed.front()};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_2INT, MPI_MAXLOC, comm));
  if (worst.status == static_cast<int>(MortarStatus::ok)) PetscFunctionReturn(0);
  const auto &facet = slave.facet[static_cast<std::size_t>(worst.facet)];
  failed_at = slave.node[facet[0]].X;
  failure =
      describe(static_cast<MortarStatus>(worst.status), mesh->dim, slave.node[facet[0]], model->is_wall());
  std::vector<int> marks(slave.facet.size(), 0);
  for (int f : report.failed) marks[f] = 1;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, marks.data(), static_cast<int>(marks.size()), MPI_INT, MPI_MAX, comm));
  failed.clear();
  for (std::size_t f = 0; f < marks.size(); ++f)
    if (marks[f]) failed.push_back(static_cast<int>(f));
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const auto pairs = model->candidate_pairs(state, 0);
  covered = std::includes(pattern.begin(), pattern.end(), pairs.begin(), pairs.end());
  if (!covered) pattern = model->candidate_pairs(state, margin);
  PetscFunctionReturn(0);
}

std::vector<GelOnGel::Weight> GelOnGel::weights() const
{
  std::vector<Weight> all;
  for (int a = 0; a < static_cast<int>(slave.node.size()); ++a)
    all.push_back({model->constants(a).carries, model->constants(a).D});
  return all;
}

NodeResult GelOnGel::result(int a) const
{
  return model->result(a);
}

std::vector<ContactStatus> GelOnGel::statuses() const
{
  std::vector<ContactStatus> all;
  NodeBlock block;
  for (int a = 0; a < static_cast<int>(slave.node.size()); ++a) {
    if (!model->constants(a).carries) continue;
    model->node(a, block);
    all.push_back(block.status);
  }
  return all;
}

PetscErrorCode GelOnGel::Advance(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                 const double *Udot, std::span<double> next)
{
  ContactState<double> state;
  std::string failure;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state, memory));
  PetscCall(Evaluate(state, false, failure));
  PetscCheck(failure.empty(), comm, PETSC_ERR_PLIB, "a converged step cannot be evaluated again: %s",
             failure.c_str());
  const Friction &friction = model->friction();
  std::fill(next.begin(), next.end(), 0.0);
  for (int a = first; a < last; ++a) { // the sum with the other ranks' zeros is exact
    const NodeResult node = model->result(a);
    next[static_cast<std::size_t>(a)] =
        node.carries && node.status != ContactStatus::open
            ? state.friction_at(a, friction).memory_after(node.velocity.norm())
            : friction.law()->initial_memory();
  }
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, next.data(), static_cast<int>(next.size()), MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::Results(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                 const double *Udot, SurfaceResults &results, double &force, double &torque)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state, memory));
  results = {};
  force = torque = 0;
  const auto nodes = static_cast<int>(slave.node.size());
  model->update(state, model->candidate_pairs(state, 0), false, 0, nodes);
  results.on_crease = model->on_crease();
  for (int a = 0; a < nodes; ++a) {
    NodeResult result = model->result(a);
    if (!result.carries && slave.node[a].multiplier) { // a part of the wall that meets nothing
      result.carries = true;
      result.pressure = 0;
      result.nominal = result.cauchy = Vector3<double>::Zero();
    }
    results.nodes.push_back(result);
    results.slave.push_back(model->slave_place(a));
    const auto [axial, turning] = model->resultant(a);
    force += axial;
    torque -= turning;
  }
  for (int b = 0; b < static_cast<int>(mesh->master.node.size()); ++b)
    results.master.push_back(model->master_place(b));
  PetscFunctionReturn(0);
}

} // namespace tribogel
