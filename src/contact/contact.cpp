#include "contact/contact.hpp"

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

SurfaceReference reference_of(const SurfaceChain &chain)
{
  SurfaceReference surface;
  for (const SurfaceNode &node : chain.node) surface.X.push_back({node.X[0], node.X[1]});
  surface.facets = chain.facet;
  return surface;
}

std::string describe(MortarStatus status, double r)
{
  const char *why = status == MortarStatus::folded          ? "a contact facet is folded"
                    : status == MortarStatus::no_projection ? "a contact facet cannot be projected"
                                                            : "a contact facet meets nothing";
  std::ostringstream text;
  text << why << " near R = " << r << " mm of the top gel's lower face";
  return text.str();
}

} // namespace

PetscErrorCode Contact::SetUp(MPI_Comm on, const Mesh &both, const Scene &scene)
{
  ContactParameters parameters;
  PetscFunctionBeginUser;
  comm = on;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  mesh = &both;
  friction = scene.friction;
  parameters.order = mesh->order;
  parameters.twist_length = scene.twist_length();
  parameters.softer_modulus =
      std::min(scene.top.material.equilibrium.shear_modulus(), scene.bottom.material.equilibrium.shear_modulus());
  for (const SurfaceNode &node : mesh->slave.node) parameters.carries_multiplier.push_back(node.multiplier);
  contact = AxisymmetricContact(ContactGeometry(reference_of(mesh->slave), reference_of(mesh->master), parameters));
  const auto nodes = static_cast<int>(mesh->slave.node.size());
  first = static_cast<int>(static_cast<long>(nodes) * rank / size);
  last = static_cast<int>(static_cast<long>(nodes) * (rank + 1) / size);
  margin = contact.reference().slave_length / static_cast<double>(mesh->slave.facet.size());

  ContactState<double> rest;
  const std::vector<double> zero(9 * (mesh->slave.node.size() + mesh->master.node.size()), 0.0);
  Unpack({-scene.initial_gap}, zero, 1, rest);
  pattern = contact.candidate_pairs(rest, margin);
  PetscFunctionReturn(0);
}

/// The nine values of each node (u, rate, multiplier; slave nodes first) as the model wants them.
void Contact::Unpack(const PlateFrames &frames, const std::vector<double> &values, double shift,
                     ContactState<double> &state) const
{
  const std::size_t slaves = mesh->slave.node.size();
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

PetscErrorCode Contact::Gather(const PlateFrames &frames, const double *U, const double *Udot, double shift,
                               ContactState<double> &state) const
{
  const std::size_t slaves = mesh->slave.node.size(), nodes = slaves + mesh->master.node.size();
  std::vector<double> values(9 * nodes, 0.0); // every node is filled by its owner; the sum with zeros is exact
  PetscFunctionBeginUser;
  for (std::size_t n = 0; n < nodes; ++n) {
    const SurfaceNode &node = n < slaves ? mesh->slave.node[n] : mesh->master.node[n - slaves];
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
PetscErrorCode Contact::Evaluate(const ContactState<double> &state, bool derivatives, std::string &failure)
{
  PetscFunctionBeginUser;
  const auto pairs = contact.candidate_pairs(state, 0);
  const MortarReport report = contact.update(state, pairs, derivatives, first, last);
  struct {
    int status, facet;
  } worst{static_cast<int>(report.status), report.facet};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_2INT, MPI_MAXLOC, comm));
  PetscCallMPI(MPI_Allreduce(&report.overhang, &overhang, 1, MPI_DOUBLE, MPI_SUM, comm));
  if (worst.status != static_cast<int>(MortarStatus::ok)) {
    const auto &facet = mesh->slave.facet[static_cast<std::size_t>(worst.facet)];
    failure = describe(static_cast<MortarStatus>(worst.status), mesh->slave.node[facet[0]].X[0]);
  } else if (overhang > largest_overhang * contact.reference().slave_length) {
    std::ostringstream text;
    text << "the top gel hangs over the edge of the bottom gel by " << overhang << " mm, more than "
         << 100 * largest_overhang << " % of its face";
    failure = text.str();
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddResidual(const PlateFrames &frames, const double *U, const double *Udot, double *F,
                                    double *magnitude, std::string &failure)
{
  const std::size_t slaves = mesh->slave.node.size(), masters = mesh->master.node.size();
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
    if (!contact.reference().nodes[a].carries) continue;
    contact.node(a, friction, block);
    const Vector3<double> &lambda = state.multiplier[a];
    const double D = contact.reference().nodes[a].D, in_plane = std::hypot(lambda[0], lambda[2]);
    const double extent[3] = {D * in_plane, D * std::abs(lambda[1]), D * in_plane};
    for (int i = 0; i < 3; ++i) {
      add(6 * a + i, block.residual[i], std::abs(block.residual[i]));
      for (std::size_t k = 0; k < block.master_nodes.size(); ++k) {
        const double value = block.residual[3 + 3 * k + i];
        add(6 * slaves + 3 * block.master_nodes[k] + i, value, std::abs(value));
      }
      add(6 * a + 3 + i, block.residual[block.residual.size() - 3 + i], extent[i]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm));
  for (std::size_t n = 0; n < slaves + masters; ++n) {
    const SurfaceNode &node = n < slaves ? mesh->slave.node[n] : mesh->master.node[n - slaves];
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
void Contact::BlockIndices(int a, const std::vector<int> &slaves, const std::vector<int> &masters,
                           std::vector<PetscInt> &rows, std::vector<PetscInt> &columns) const
{
  const auto append = [](std::vector<PetscInt> &list, const std::array<PetscInt, 3> &index) {
    list.insert(list.end(), index.begin(), index.end());
  };
  rows.clear();
  columns.clear();
  append(rows, mesh->slave.node[a].displacement);
  for (int b : slaves) append(columns, mesh->slave.node[b].displacement);
  for (int m : masters) {
    append(rows, mesh->master.node[m].displacement);
    append(columns, mesh->master.node[m].displacement);
  }
  append(rows, mesh->slave.node[a].traction);
  append(columns, mesh->slave.node[a].traction);
}

PetscErrorCode Contact::AddJacobian(const PlateFrames &frames, const double *U, const double *Udot, double shift, Mat A,
                                    std::string &failure)
{
  ContactState<double> state;
  std::vector<PetscInt> rows, columns;
  NodeBlock block;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, shift, state));
  PetscCall(Evaluate(state, true, failure));
  if (!failure.empty()) PetscFunctionReturn(0);
  for (int a = first; a < last; ++a) {
    if (!contact.reference().nodes[a].carries) continue;
    contact.node(a, friction, block);
    BlockIndices(a, block.slave_nodes, block.master_nodes, rows, columns);
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values = block.jacobian;
    PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(), static_cast<PetscInt>(columns.size()),
                           columns.data(), values.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::UpdateCandidates(const PlateFrames &frames, const double *U, bool &covered)
{
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, nullptr, 1, state));
  const auto pairs = contact.candidate_pairs(state, 0);
  covered = std::includes(pattern.begin(), pattern.end(), pairs.begin(), pairs.end());
  if (!covered) pattern = contact.candidate_pairs(state, margin);
  PetscFunctionReturn(0);
}

PetscErrorCode Contact::AddPattern(Mat A) const
{
  const int facets = static_cast<int>(mesh->slave.facet.size()), per_facet = mesh->order + 1;
  std::vector<PetscInt> rows, columns;
  PetscFunctionBeginUser;
  const LineChain &chain = contact.reference().slave_chain;
  for (int a = first; a < last; ++a) {
    if (!contact.reference().nodes[a].carries) continue;
    std::vector<int> slaves{a}, masters;
    for (int k = 0; k < chain.neighbours[a].count; ++k) {
      const int f = chain.neighbours[a].of[k].facet;
      for (int g = std::max(f - 1, 0); g <= std::min(f + 1, facets - 1); ++g) // normals average over neighbours
        for (int b = 0; b < per_facet; ++b) index_in(slaves, mesh->slave.facet[g][b]);
      for (const auto &[slave_facet, m] : pattern)
        if (slave_facet == f)
          for (int b = 0; b < per_facet; ++b) index_in(masters, mesh->master.facet[m][b]);
    }
    BlockIndices(a, slaves, masters, rows, columns);
    const std::vector<double> zeros(rows.size() * columns.size(), 0.0);
    PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(), static_cast<PetscInt>(columns.size()),
                           columns.data(), zeros.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

void Contact::AddRoundOff(double *magnitude) const
{
  double extent = 0;
  for (const SurfaceNode &node : mesh->slave.node) extent = std::max({extent, node.X[0], std::abs(node.X[1])});
  for (std::size_t a = 0; a < mesh->slave.node.size(); ++a) {
    const SurfaceNode &node = mesh->slave.node[a];
    if (node.local < 0 || !node.multiplier) continue;
    const auto &constants = contact.reference().nodes[a];
    const PetscInt row = mesh->nodes[node.local].traction;
    for (int i = 0; i < 3; ++i)
      magnitude[row + i] += std::numeric_limits<double>::epsilon() * constants.D * constants.c_N * extent;
  }
}

PetscErrorCode Contact::Results(const PlateFrames &frames, const double *U, const double *Udot,
                                ContactState<double> &state, std::vector<NodeResult> &results, double &force,
                                double &torque)
{
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state));
  const auto pairs = contact.candidate_pairs(state, 0);
  contact.update(state, pairs, false);
  results.clear();
  force = torque = 0;
  for (int a = 0; a < static_cast<int>(mesh->slave.node.size()); ++a) {
    results.push_back(contact.result(a, friction));
    const auto [axial, turning] = contact.resultant(a);
    force += axial;
    torque -= turning;
  }
  PetscFunctionReturn(0);
}

} // namespace tribogel
