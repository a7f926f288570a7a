#include "contact/gel_contact.hpp"

#include "contact/surface_reference.hpp"
#include "tribogel/contact/axisymmetric_contact.hpp"
#include "tribogel/contact/rolling.hpp"
#include "tribogel/contact/solid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <variant>

namespace tribogel
{

struct ContactModel {
  std::variant<AxisymmetricContact, SolidContact> contact;
  ContactParameters parameters; ///< of a curve

  AxisymmetricContact &curve() { return std::get<AxisymmetricContact>(contact); }
};

GelContact::GelContact() : model(std::make_unique<ContactModel>()) {}
GelContact::GelContact(GelContact &&) noexcept = default;
GelContact::~GelContact() = default;

namespace
{

/// A slave facet that hangs over the master's edge presses on the master's extension; that is a good picture of a rim
/// that only just overhangs, and of nothing else.
constexpr double largest_overhang = 0.1; // of the slave's length or area

/// Rows and columns of a node's block in the order of NodeBlock::jacobian.
ContactBlock unknowns_of(int a, const NodeBlock &block)
{
  ContactBlock all;
  for (int k = 0; k < block.slave_rows; ++k)
    all.rows.push_back({ContactUnknown::slave, block.slave_nodes[static_cast<std::size_t>(k)]});
  for (int b : block.slave_nodes) all.columns.push_back({ContactUnknown::slave, b});
  for (int m : block.master_nodes) {
    all.rows.push_back({ContactUnknown::master, m});
    all.columns.push_back({ContactUnknown::master, m});
  }
  all.rows.push_back({ContactUnknown::multiplier, a});
  all.columns.push_back({ContactUnknown::multiplier, a});
  return all;
}

std::string describe(MortarStatus status, int dim, const SurfaceNode &near, bool wall)
{
  const char *why = status == MortarStatus::folded          ? "a contact facet is folded"
                    : status == MortarStatus::no_projection ? "a contact facet cannot be projected"
                                                            : "a contact facet meets nothing";
  return std::string(why) + " near " + describe_place(dim, near.X) + " of the top gel's " +
         (wall ? "side wall" : "lower face");
}

/// The Jacobian's blocks of slave nodes first <= a < last, and the rows and columns they can have; a curve's come node
/// by node. A wall's first node has its multiplier on the face.
template <class Emit>
void emit_jacobian(const AxisymmetricContact &contact, const Surface &slave, int first, int last,
                   const PolynomialFriction<double> &law, const Emit &emit)
{
  NodeBlock block;
  for (int a = first; a < last; ++a) {
    if (!slave.node[a].multiplier) continue;
    contact.node(a, law, block);
    ContactBlock all = unknowns_of(a, block);
    all.values = block.jacobian;
    emit(all);
  }
}

template <class Emit>
void emit_jacobian(const SolidContact &contact, const Surface &, int, int, const PolynomialFriction<double> &law,
                   const Emit &emit)
{
  contact.jacobian(law, emit);
}

template <class Emit>
void emit_pattern(const AxisymmetricContact &contact, const Surface &slave, FacetPairs pairs, int first, int last,
                  const Emit &emit)
{
  for (int a = first; a < last; ++a)
    if (slave.node[a].multiplier) emit(unknowns_of(a, contact.pattern(a, pairs)));
}

template <class Emit>
void emit_pattern(const SolidContact &contact, const Surface &, const SolidContact::Pairs &pairs, int first, int last,
                  const Emit &emit)
{
  contact.pattern(pairs, first, last, emit);
}

} // namespace

PetscErrorCode GelContact::SetUp(MPI_Comm on, const Mesh &both, const Scene &scene, Surface surface, bool is_wall)
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
  wall = is_wall;
  friction = scene.friction;
  model->parameters.order = mesh->order;
  model->parameters.twist_length = scene.twist_length();
  model->parameters.softer_modulus =
      std::min(scene.top.material.equilibrium.shear_modulus(), scene.bottom.material.equilibrium.shear_modulus());
  model->parameters.starts_at_crease = wall;
  if (wall) slave.node.front().multiplier = false; // it belongs to the lower face
  for (const SurfaceNode &node : slave.node) model->parameters.carries_multiplier.push_back(node.multiplier);
  if (mesh->dim == 2)
    Touch(wall ? 0 : static_cast<int>(slave.facet.size()));
  else
    model->contact = SolidContact(
        SolidGeometry(quads_of(slave), quads_of(mesh->master),
                      {model->parameters.order, model->parameters.softer_modulus, model->parameters.carries_multiplier,
                       scene.contact_integration == ContactIntegration::segments}));
  const auto nodes = static_cast<int>(slave.node.size());
  first = static_cast<int>(static_cast<long>(nodes) * rank / size);
  last = static_cast<int>(static_cast<long>(nodes) * (rank + 1) / size);
  margin = std::visit([](const auto &operation) { return operation.facet_size(); }, model->contact);

  ContactState<double> rest;
  const std::vector<double> zero(9 * (slave.node.size() + mesh->master.node.size()), 0.0);
  PlateFrames touching;
  touching.top_travel = -scene.initial_gap;
  touching.top_axis = scene.misalignment.offset;
  Unpack(touching, zero, 1, rest);
  pattern = std::visit([&](const auto &operation) { return operation.candidate_pairs(rest, margin); }, model->contact);
  PetscFunctionReturn(0);
}

/// Rebuilds the operator of a curve for contact of the first `facets` slave facets.
void GelContact::Touch(int facets)
{
  model->parameters.facets_in_contact = facets;
  model->contact = AxisymmetricContact(ContactGeometry(chain_of(slave), chain_of(mesh->master), model->parameters));
}

PetscErrorCode GelContact::BeginStep(const PlateFrames &frames, const double *U)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  if (!wall) PetscFunctionReturn(0);
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const ContactGeometry &geometry = model->curve().reference();
  const LineChain whole(geometry.slave.facets, mesh->order + 1, static_cast<int>(geometry.slave.X.size()));
  int facets = rolling_facets(whole, positions(geometry.slave, state.slave), geometry.master_chain,
                              positions(geometry.master, state.master));
  if (facets != geometry.slave_chain.facet_count()) Touch(facets);
  while (facets > 0) { // only facets that can be projected now
    const MortarReport report = model->curve().update(state, model->curve().candidate_pairs(state, 0), false);
    if (report.status == MortarStatus::ok) break;
    facets = report.facet;
    Touch(facets);
  }
  failed_facet = facets;
  PetscFunctionReturn(0);
}

/// A wall facet that the last attempt could not project sits out the next.
void GelContact::BeginAttempt()
{
  if (wall && failed_facet < model->curve().reference().slave_chain.facet_count()) Touch(failed_facet);
}

/// The nine values of each node (u, rate, multiplier; slave nodes first) as the model wants them.
void GelContact::Unpack(const PlateFrames &frames, const std::vector<double> &values, double shift,
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

PetscErrorCode GelContact::Gather(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                                  ContactState<double> &state) const
{
  const std::size_t slaves = slave.node.size(), nodes = slaves + mesh->master.node.size();
  std::vector<double> values(9 * nodes, 0.0); // every node is filled by its owner; the sum with zeros is exact
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
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm));
  Unpack(frames, values, shift, state);
  PetscFunctionReturn(0);
}

/// Mortar integrals of this rank's share of the slave nodes; every rank learns of a failure on any.
PetscErrorCode GelContact::Evaluate(const ContactState<double> &state, bool derivatives, std::string &failure)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(search_event, 0, 0, 0, 0));
  const auto pairs =
      std::visit([&](const auto &operation) { return operation.candidate_pairs(state, 0); }, model->contact);
  PetscCall(PetscLogEventEnd(search_event, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(mortar_event, 0, 0, 0, 0));
  const MortarReport report = std::visit(
      [&](auto &operation) { return operation.update(state, pairs, derivatives, first, last); }, model->contact);
  PetscCall(PetscLogEventEnd(mortar_event, 0, 0, 0, 0));
  struct {
    int status, facet;
  } worst{static_cast<int>(report.status), report.facet};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_2INT, MPI_MAXLOC, comm));
  // What of the wall lies beyond the master's edge is far from it, or rolls on the extension of its end.
  double beyond = wall ? 0 : report.overhang;
  PetscCallMPI(MPI_Allreduce(&beyond, &overhang, 1, MPI_DOUBLE, MPI_SUM, comm));
  if (worst.status != static_cast<int>(MortarStatus::ok)) {
    const auto &facet = slave.facet[static_cast<std::size_t>(worst.facet)];
    failure = describe(static_cast<MortarStatus>(worst.status), mesh->dim, slave.node[facet[0]], wall);
    failed_facet = worst.facet;
  } else if (overhang > largest_overhang *
                            std::visit([](const auto &operation) { return operation.slave_size(); }, model->contact)) {
    std::ostringstream text;
    text << "the top gel hangs over the edge of the bottom gel by " << overhang << (mesh->dim == 2 ? " mm" : " mm^2")
         << ", more than " << 100 * largest_overhang << " % of its face";
    failure = text.str();
  }
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::AddResidual(const PlateFrames &frames, const double *U, const double *Udot, double *F,
                                       double *magnitude, std::string &failure)
{
  const std::size_t slaves = slave.node.size(), masters = mesh->master.node.size();
  const std::size_t length = 6 * slaves + 3 * masters; // forces and conditions of the slave, forces of the master
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state));
  PetscCall(Evaluate(state, false, failure));
  if (!failure.empty()) PetscFunctionReturn(0);

  std::vector<double> sums(2 * length, 0.0);
  double *force = sums.data(), *size_of = sums.data() + length;
  const auto add = [&](std::size_t row, double value, double extent) {
    force[row] += value;
    size_of[row] += extent;
  };
  NodeBlock block;
  for (int a = first; a < last; ++a) {
    if (!slave.node[a].multiplier) continue;
    const Vector3<double> &lambda = state.multiplier[a];
    const double D = std::visit(
        [&](const auto &operation) {
          operation.node(a, friction, block);
          const auto &constants = operation.constants(a);
          return constants.carries ? constants.weight() : constants.extent;
        },
        model->contact);
    // In the half plane the tangential condition is one of its own, in 3-D friction acts in all directions.
    const double in_plane = D * (mesh->dim == 2 ? std::hypot(lambda[0], lambda[2]) : lambda.norm());
    const double extent[3] = {in_plane, mesh->dim == 2 ? D * std::abs(lambda[1]) : in_plane, in_plane};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < block.slave_rows; ++k) {
        const double value = block.residual[3 * k + i];
        add(6 * block.slave_nodes[k] + i, value, std::abs(value));
      }
      for (std::size_t k = 0; k < block.master_nodes.size(); ++k) {
        const double value = block.residual[3 * (block.slave_rows + k) + i];
        add(6 * slaves + 3 * block.master_nodes[k] + i, value, std::abs(value));
      }
      add(6 * a + 3 + i, block.residual[block.residual.size() - 3 + i], extent[i]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm));
  for (std::size_t n = 0; n < slaves + masters; ++n) {
    const SurfaceNode &node = n < slaves ? slave.node[n] : mesh->master.node[n - slaves];
    if (node.local < 0) continue;
    const Node &place = mesh->nodes[node.local];
    const std::size_t row = n < slaves ? 6 * n : 6 * slaves + 3 * (n - slaves);
    for (int i = 0; i < 3; ++i) {
      F[place.displacement + i] += force[row + i];
      magnitude[place.displacement + i] += size_of[row + i];
      if (place.traction < 0) continue;
      F[place.traction + i] += force[row + 3 + i];
      magnitude[place.traction + i] += size_of[row + 3 + i];
    }
  }
  PetscFunctionReturn(0);
}

void GelContact::Indices(const std::vector<ContactUnknown> &unknowns, std::vector<PetscInt> &indices) const
{
  indices.clear();
  for (const ContactUnknown &unknown : unknowns) {
    const SurfaceNode &node =
        unknown.kind == ContactUnknown::master ? mesh->master.node[unknown.node] : slave.node[unknown.node];
    const auto &own = unknown.kind == ContactUnknown::multiplier ? node.traction : node.displacement;
    indices.insert(indices.end(), own.begin(), own.end());
  }
}

/// Adds the block's values to the matrix, zeros if it has none.
PetscErrorCode GelContact::Add(const ContactBlock &block, Mat A) const
{
  std::vector<PetscInt> rows, columns;
  std::vector<double> zeros;
  PetscFunctionBeginUser;
  Indices(block.rows, rows);
  Indices(block.columns, columns);
  if (block.values.size() == 0) zeros.assign(rows.size() * columns.size(), 0.0);
  PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(), static_cast<PetscInt>(columns.size()),
                         columns.data(), zeros.empty() ? block.values.data() : zeros.data(), ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::AddJacobian(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                                       Mat A, std::string &failure)
{
  ContactState<double> state;
  PetscErrorCode worst = 0;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, shift, state));
  PetscCall(Evaluate(state, true, failure));
  if (!failure.empty()) PetscFunctionReturn(0);
  const auto add = [&](const ContactBlock &block) { worst = std::max(worst, Add(block, A)); };
  std::visit([&](const auto &operation) { emit_jacobian(operation, slave, first, last, friction, add); },
             model->contact);
  PetscCall(worst);
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const auto candidates = [&](double reach) {
    return std::visit([&](const auto &operation) { return operation.candidate_pairs(state, reach); }, model->contact);
  };
  const auto pairs = candidates(0);
  covered = std::includes(pattern.begin(), pattern.end(), pairs.begin(), pairs.end());
  if (!covered) pattern = candidates(margin);
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::AddPattern(Mat A) const
{
  PetscErrorCode worst = 0;
  PetscFunctionBeginUser;
  const auto add = [&](const ContactBlock &block) { worst = std::max(worst, Add(block, A)); };
  std::visit([&](const auto &operation) { emit_pattern(operation, slave, pattern, first, last, add); }, model->contact);
  PetscCall(worst);
  PetscFunctionReturn(0);
}

void GelContact::AddRoundOff(double *magnitude) const
{
  double extent = 0;
  for (const SurfaceNode &node : slave.node)
    for (double x : node.X) extent = std::max(extent, std::abs(x));
  for (std::size_t a = 0; a < slave.node.size(); ++a) {
    const SurfaceNode &node = slave.node[a];
    if (node.local < 0 || !node.multiplier) continue;
    const double stiffness = std::visit(
        [&](const auto &operation) {
          const auto &constants = operation.constants(static_cast<int>(a));
          return constants.D * constants.c_N;
        },
        model->contact);
    const PetscInt row = mesh->nodes[node.local].traction;
    for (int i = 0; i < 3; ++i) magnitude[row + i] += std::numeric_limits<double>::epsilon() * stiffness * extent;
  }
}

std::vector<GelContact::Weight> GelContact::weights() const
{
  std::vector<Weight> all;
  for (int a = 0; a < static_cast<int>(slave.node.size()); ++a)
    std::visit(
        [&](const auto &operation) {
          all.push_back({operation.constants(a).carries, operation.constants(a).D});
        },
        model->contact);
  return all;
}

NodeResult GelContact::result(int a) const
{
  return std::visit([&](const auto &operation) { return operation.result(a, friction); }, model->contact);
}

std::vector<ContactStatus> GelContact::statuses() const
{
  std::vector<ContactStatus> all;
  NodeBlock block;
  for (int a = 0; a < static_cast<int>(slave.node.size()); ++a)
    std::visit(
        [&](const auto &operation) {
          if (!operation.constants(a).carries) return;
          operation.node(a, friction, block);
          all.push_back(block.status);
        },
        model->contact);
  return all;
}

PetscErrorCode GelContact::Results(const PlateFrames &frames, const double *U, const double *Udot,
                                   SurfaceResults &results, double &force, double &torque)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state));
  results = {};
  force = torque = 0;
  std::visit(
      [&](auto &operation) {
        operation.update(state, operation.candidate_pairs(state, 0), false);
        for (int a = 0; a < static_cast<int>(slave.node.size()); ++a) {
          NodeResult result = operation.result(a, friction);
          if (!result.carries && slave.node[a].multiplier) { // a part of the wall that meets nothing
            result.carries = true;
            result.pressure = 0;
            result.nominal = result.cauchy = Vector3<double>::Zero();
          }
          results.nodes.push_back(result);
          results.slave.push_back(operation.slave_place(a));
          const auto [axial, turning] = operation.resultant(a);
          force += axial;
          torque -= turning;
        }
        for (int b = 0; b < static_cast<int>(mesh->master.node.size()); ++b)
          results.master.push_back(operation.master_place(b));
      },
      model->contact);
  PetscFunctionReturn(0);
}

} // namespace tribogel
