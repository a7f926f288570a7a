/// What a slave surface adds to the rows of residual and Jacobian, once it has been evaluated.
#include "contact/gel_on_gel.hpp"
#include "contact/own_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

PetscErrorCode GelOnGel::AddResidual(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                     const double *Udot, double *F, double *magnitude, std::string &failure)
{
  const std::size_t slaves = slave.node.size(), masters = mesh->master.node.size();
  const std::size_t length =
      6 * slaves + 3 * masters; // forces and conditions of the slave, forces of the master
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, 1, state, memory));
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
    model->node(a, block);
    const SlaveNode &constants = model->constants(a);
    const double D = constants.carries ? constants.weight() : constants.extent;
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
  PetscCall(AddSurfaceSums(sums, F, magnitude));
  PetscFunctionReturn(0);
}

/// Two lists of sums over the ranks, each of forces and conditions of the slave's nodes, then forces of the
/// master's, to this rank's nodes in two local arrays.
PetscErrorCode GelOnGel::AddSurfaceSums(std::vector<double> &sums, double *one, double *other) const
{
  const std::size_t slaves = slave.node.size(), masters = mesh->master.node.size();
  const double *force = sums.data(), *size_of = sums.data() + sums.size() / 2;
  PetscFunctionBeginUser;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm));
  for (std::size_t n = 0; n < slaves + masters; ++n) {
    const SurfaceNode &node = n < slaves ? slave.node[n] : mesh->master.node[n - slaves];
    if (node.local < 0) continue;
    const Node &place = mesh->nodes[node.local];
    const std::size_t row = n < slaves ? 6 * n : 6 * slaves + 3 * (n - slaves);
    for (int i = 0; i < 3; ++i) {
      one[place.displacement + i] += force[row + i];
      other[place.displacement + i] += size_of[row + i];
      if (place.traction < 0) continue;
      one[place.traction + i] += force[row + 3 + i];
      other[place.traction + i] += size_of[row + 3 + i];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::AddMotionSlopes(const PlateFrames &frames, const FrictionMemory &memory,
                                         const double *U, const double *Udot, double shift, double *by_travel,
                                         double *by_turn, std::string &failure)
{
  const std::size_t slaves = slave.node.size(), length = 6 * slaves + 3 * mesh->master.node.size();
  ContactState<double> state;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, shift, state, memory));
  PetscCall(Evaluate(state, true, failure));
  if (!failure.empty()) PetscFunctionReturn(0);
  std::vector<double> sums(2 * length, 0.0);
  model->motion_slopes([&](ContactOperator::Motion motion, const ContactUnknown &row,
                           const Vector3<double> &slope) {
    const auto node = static_cast<std::size_t>(row.node);
    if (row.kind == ContactUnknown::multiplier && !slave.node[node].multiplier) return;
    const std::size_t place = row.kind == ContactUnknown::slave        ? 6 * node
                              : row.kind == ContactUnknown::multiplier ? 6 * node + 3
                                                                       : 6 * slaves + 3 * node;
    for (int i = 0; i < 3; ++i)
      sums[(motion == ContactOperator::turn ? length : 0) + place + static_cast<std::size_t>(i)] += slope[i];
  });
  PetscCall(AddSurfaceSums(sums, by_travel, by_turn));
  PetscFunctionReturn(0);
}

void GelOnGel::Indices(const std::vector<ContactUnknown> &unknowns, std::vector<PetscInt> &indices) const
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
PetscErrorCode GelOnGel::Add(const ContactBlock &block, Mat A) const
{
  std::vector<PetscInt> rows, columns;
  std::vector<double> zeros;
  PetscFunctionBeginUser;
  Indices(block.rows, rows);
  Indices(block.columns, columns);
  if (block.values.size() == 0) zeros.assign(rows.size() * columns.size(), 0.0);
  PetscCall(MatSetValues(A, static_cast<PetscInt>(rows.size()), rows.data(),
                         static_cast<PetscInt>(columns.size()), columns.data(),
                         zeros.empty() ? block.values.data() : zeros.data(), ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::AddJacobian(const PlateFrames &frames, const FrictionMemory &memory, const double *U,
                                     const double *Udot, double shift, Mat A, std::string &failure)
{
  ContactState<double> state;
  PetscErrorCode worst = 0;
  OwnRows own;
  std::vector<PetscInt> rows, columns;
  PetscFunctionBeginUser;
  PetscCall(Gather(frames, U, Udot, shift, state, memory));
  PetscCall(Evaluate(state, true, failure));
  if (!failure.empty()) PetscFunctionReturn(0);
  PetscCall(own.Open(A));
  const auto add = [&](const ContactBlock &block) {
    if (own.is_open()) {
      Indices(block.rows, rows);
      Indices(block.columns, columns);
      worst = std::max(worst, own.Add(rows, columns, block.values.data()));
    } else
      worst = std::max(worst, Add(block, A));
  };
  model->jacobian(add);
  PetscCall(worst);
  PetscCall(own.Close());
  PetscFunctionReturn(0);
}

PetscErrorCode GelOnGel::AddPattern(Mat A) const
{
  PetscErrorCode worst = 0;
  PetscFunctionBeginUser;
  const auto add = [&](const ContactBlock &block) { worst = std::max(worst, Add(block, A)); };
  model->pattern(pattern, first, last, add);
  PetscCall(worst);
  PetscFunctionReturn(0);
}

void GelOnGel::AddRoundOff(double *magnitude) const
{
  double extent = 0;
  for (const SurfaceNode &node : slave.node)
    for (double x : node.X) extent = std::max(extent, std::abs(x));
  for (std::size_t a = 0; a < slave.node.size(); ++a) {
    const SurfaceNode &node = slave.node[a];
    if (node.local < 0 || !node.multiplier) continue;
    const SlaveNode &constants = model->constants(static_cast<int>(a));
    const double stiffness = constants.D * constants.c_N;
    const PetscInt row = mesh->nodes[node.local].traction;
    for (int i = 0; i < 3; ++i)
      magnitude[row + i] += std::numeric_limits<double>::epsilon() * stiffness * extent;
  }
}

} // namespace tribogel
