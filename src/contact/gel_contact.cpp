#include "contact/gel_contact.hpp"

#include "contact/surface_reference.hpp"
#include "tribogel/contact/rolling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace tribogel
{

namespace
{

/// A slave facet that hangs over the master's edge presses on the master's extension; that is a good picture of a rim
/// that only just overhangs, and of nothing else.
constexpr double largest_overhang = 0.1; // of the slave's length

std::string describe(MortarStatus status, const SurfaceNode &near, bool wall)
{
  const char *why = status == MortarStatus::folded          ? "a contact facet is folded"
                    : status == MortarStatus::no_projection ? "a contact facet cannot be projected"
                                                            : "a contact facet meets nothing";
  std::ostringstream text;
  text << why << " near R = " << near.X[0] << " mm, Z = " << near.X[1] << " mm of the top gel's "
       << (wall ? "side wall" : "lower face");
  return text.str();
}

} // namespace

PetscErrorCode GelContact::SetUp(MPI_Comm on, const Mesh &both, const Scene &scene, Surface curve, bool is_wall)
{
  PetscFunctionBeginUser;
  comm = on;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  mesh = &both;
  slave = std::move(curve);
  wall = is_wall;
  friction = scene.friction;
  parameters.order = mesh->order;
  parameters.twist_length = scene.twist_length();
  parameters.softer_modulus =
      std::min(scene.top.material.equilibrium.shear_modulus(), scene.bottom.material.equilibrium.shear_modulus());
  parameters.starts_at_crease = wall;
  if (wall) slave.node.front().multiplier = false; // it belongs to the lower face
  for (const SurfaceNode &node : slave.node) parameters.carries_multiplier.push_back(node.multiplier);
  Touch(wall ? 0 : static_cast<int>(slave.facet.size()));
  const auto nodes = static_cast<int>(slave.node.size());
  first = static_cast<int>(static_cast<long>(nodes) * rank / size);
  last = static_cast<int>(static_cast<long>(nodes) * (rank + 1) / size);
  margin = contact.reference().slave_length / static_cast<double>(slave.facet.size());

  ContactState<double> rest;
  const std::vector<double> zero(9 * (slave.node.size() + mesh->master.node.size()), 0.0);
  Unpack({-scene.initial_gap}, zero, 1, rest);
  pattern = contact.candidate_pairs(rest, margin);
  PetscFunctionReturn(0);
}

/// Rebuilds the operator for contact of the first `facets` slave facets.
void GelContact::Touch(int facets)
{
  parameters.facets_in_contact = facets;
  contact = AxisymmetricContact(ContactGeometry(reference_of(slave), reference_of(mesh->master), parameters));
}

PetscErrorCode GelContact::BeginStep(const PlateFrames &frames, const double *U)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  if (!wall) PetscFunctionReturn(0);
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const ContactGeometry &geometry = contact.reference();
  const LineChain whole(geometry.slave.facets, mesh->order + 1, static_cast<int>(geometry.slave.X.size()));
  int facets = rolling_facets(whole, positions(geometry.slave, state.slave), geometry.master_chain,
                              positions(geometry.master, state.master));
  if (facets != geometry.slave_chain.facet_count()) Touch(facets);
  while (facets > 0) { // only facets that can be projected now
    const MortarReport report = contact.update(state, contact.candidate_pairs(state, 0), false);
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
  if (wall && failed_facet < contact.reference().slave_chain.facet_count()) Touch(failed_facet);
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
  const auto pairs = contact.candidate_pairs(state, 0);
  const MortarReport report = contact.update(state, pairs, derivatives, first, last);
  struct {
    int status, facet;
  } worst{static_cast<int>(report.status), report.facet};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_2INT, MPI_MAXLOC, comm));
  // What of the wall lies beyond the master's edge is far from it, or rolls on the extension of its end.
  double beyond = wall ? 0 : report.overhang;
  PetscCallMPI(MPI_Allreduce(&beyond, &overhang, 1, MPI_DOUBLE, MPI_SUM, comm));
  if (worst.status != static_cast<int>(MortarStatus::ok)) {
    const auto &facet = slave.facet[static_cast<std::size_t>(worst.facet)];
    failure = describe(static_cast<MortarStatus>(worst.status), slave.node[facet[0]], wall);
    failed_facet = worst.facet;
  } else if (overhang > largest_overhang * contact.reference().slave_length) {
    std::ostringstream text;
    text << "the top gel hangs over the edge of the bottom gel by " << overhang << " mm, more than "
         << 100 * largest_overhang << " % of its face";
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
    contact.node(a, friction, block);
    const Vector3<double> &lambda = state.multiplier[a];
    const auto &constants = contact.reference().nodes[a];
    const double D = constants.carries ? constants.weight() : constants.extent,
                 in_plane = std::hypot(lambda[0], lambda[2]);
    const double extent[3] = {D * in_plane, D * std::abs(lambda[1]), D * in_plane};
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

/// Global rows and columns of a slave node's block, in the order of NodeBlock::jacobian.
void GelContact::BlockIndices(int a, const NodeBlock &block, std::vector<PetscInt> &rows,
                              std::vector<PetscInt> &columns) const
{
  const auto append = [](std::vector<PetscInt> &list, const std::array<PetscInt, 3> &index) {
    list.insert(list.end(), index.begin(), index.end());
  };
  rows.clear();
  columns.clear();
  for (int k = 0; k < block.slave_rows; ++k) append(rows, slave.node[block.slave_nodes[k]].displacement);
  for (int b : block.slave_nodes) append(columns, slave.node[b].displacement);
  for (int m : block.master_nodes) {
    append(rows, mesh->master.node[m].displacement);
    append(columns, mesh->master.node[m].displacement);
  }
  append(rows, slave.node[a].traction);
  append(columns, slave.node[a].traction);
}

PetscErrorCode GelContact::AddJacobian(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                                       Mat A, std::string &failure)
{
  ContactState<double> state;
  std::vector<PetscInt> rows, columns;
  NodeBlock block;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, shift, state));
  PetscCall(Evaluate(state, true, failure));
  if (!failure.empty()) PetscFunctionReturn(0);
  for (int a = first; a < last; ++a) {
    if (!slave.node[a].multiplier) continue;
    contact.node(a, friction, block);
    BlockIndices(a, block, rows, columns);
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values = block.jacobian;
    PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(), static_cast<PetscInt>(columns.size()),
                           columns.data(), values.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const auto pairs = contact.candidate_pairs(state, 0);
  covered = std::includes(pattern.begin(), pattern.end(), pairs.begin(), pairs.end());
  if (!covered) pattern = contact.candidate_pairs(state, margin);
  PetscFunctionReturn(0);
}

PetscErrorCode GelContact::AddPattern(Mat A) const
{
  std::vector<PetscInt> rows, columns;
  PetscFunctionBeginUser;
  for (int a = first; a < last; ++a) {
    if (!slave.node[a].multiplier) continue;
    BlockIndices(a, contact.pattern(a, pattern), rows, columns);
    const std::vector<double> zeros(rows.size() * columns.size(), 0.0);
    PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(), static_cast<PetscInt>(columns.size()),
                           columns.data(), zeros.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

void GelContact::AddRoundOff(double *magnitude) const
{
  double extent = 0;
  for (const SurfaceNode &node : slave.node) extent = std::max({extent, node.X[0], std::abs(node.X[1])});
  for (std::size_t a = 0; a < slave.node.size(); ++a) {
    const SurfaceNode &node = slave.node[a];
    if (node.local < 0 || !node.multiplier) continue;
    const auto &constants = contact.reference().nodes[a];
    const PetscInt row = mesh->nodes[node.local].traction;
    for (int i = 0; i < 3; ++i)
      magnitude[row + i] += std::numeric_limits<double>::epsilon() * constants.D * constants.c_N * extent;
  }
}

PetscErrorCode GelContact::Results(const PlateFrames &frames, const double *U, const double *Udot,
                                   ContactState<double> &state, std::vector<NodeResult> &results, double &force,
                                   double &torque)
{
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state));
  const auto pairs = contact.candidate_pairs(state, 0);
  contact.update(state, pairs, false);
  results.clear();
  force = torque = 0;
  for (int a = 0; a < static_cast<int>(slave.node.size()); ++a) {
    NodeResult result = contact.result(a, friction);
    if (!result.carries && slave.node[a].multiplier) { // a part of the wall that meets nothing
      result.carries = true;
      result.pressure = 0;
      result.nominal = result.cauchy = Vector3<double>::Zero();
    }
    results.push_back(result);
    const auto [axial, turning] = contact.resultant(a);
    force += axial;
    torque -= turning;
  }
  PetscFunctionReturn(0);
}

} // namespace tribogel
