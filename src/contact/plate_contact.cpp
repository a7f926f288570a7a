#include "contact/plate_contact.hpp"

#include "contact/surface_reference.hpp"
#include "tribogel/contact/axisymmetric_geometry.hpp"
#include "tribogel/contact/solid_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

/// Of one node of a wall, as in ContactGeometry and SolidGeometry.
struct NodeWeight {
  double D, c_N;
};

std::vector<NodeWeight> weights_of(const Surface &wall, int dim, int order, double softer_modulus)
{
  std::vector<NodeWeight> weights;
  const auto list = [&](const auto &geometry) {
    for (const auto &node : geometry.nodes) weights.push_back({node.D, node.c_N});
  };
  if (dim == 2) {
    ContactParameters parameters;
    parameters.order = order;
    parameters.softer_modulus = softer_modulus;
    list(ContactGeometry(chain_of(wall), {}, parameters));
  } else
    list(SolidGeometry(quads_of(wall), {}, {order, softer_modulus, {}}));
  return weights;
}

} // namespace

void PlateContact::SetUp(const Mesh &both, const Scene &scene, int body, const Surface &wall,
                         const std::vector<bool> &taken)
{
  mesh = &both;
  axial = mesh->dim - 1;
  spans_both = !scene.has_top;
  const Specimen &specimen = body == top_body ? scene.top : scene.bottom;
  const std::vector<NodeWeight> weights =
      weights_of(wall, mesh->dim, mesh->order, specimen.material.equilibrium.shear_modulus());
  double foot = std::numeric_limits<double>::infinity(), head = -foot;
  for (const SurfaceNode &node : wall.node) {
    foot = std::min(foot, node.X[axial]);
    head = std::max(head, node.X[axial]);
  }
  extent = scene.bottom.height + (scene.has_top ? scene.initial_gap + scene.top.height : 0);
  for (std::size_t a = 0; a < wall.node.size(); ++a) {
    const SurfaceNode &node = wall.node[a];
    if (node.local < 0 || !node.multiplier || taken[a]) continue;
    // A gel between both plates may meet either, the nearer one; with two gels each has one plate of its own.
    const bool above = body == top_body || (spans_both && node.X[axial] > 0.5 * (foot + head));
    nodes.push_back({node.local, weights[a].D, weights[a].c_N, above ? 1.0 : -1.0, above ? head : foot});
  }
}

PlateNodeBlock PlateContact::Block(const WallNode &wall_node, const PlateFrames &frames, const double *U) const
{
  const Node &node = mesh->nodes[wall_node.node];
  const double plate = wall_node.plate + (spans_both && wall_node.outward > 0 ? frames.top_travel : 0);
  return plate_node(node.X[axial] + U[node.displacement + 2], plate, wall_node.outward,
                    Vector3<double>(&U[node.traction]), wall_node.D, wall_node.c_N);
}

void PlateContact::AddResidual(const PlateFrames &frames, const double *U, double *F, double *magnitude) const
{
  for (const WallNode &wall_node : nodes) {
    const Node &node = mesh->nodes[wall_node.node];
    const PlateNodeBlock block = Block(wall_node, frames, U);
    F[node.displacement + 2] += block.force;
    magnitude[node.displacement + 2] += std::abs(block.force);
    const double *traction = U + node.traction;
    const double in_plane = wall_node.D * std::hypot(traction[0], traction[2]);
    const double size[3] = {in_plane, wall_node.D * std::abs(traction[1]), in_plane};
    for (int i = 0; i < 3; ++i) {
      F[node.traction + i] += block.condition[i];
      magnitude[node.traction + i] += size[i];
    }
  }
}

PetscErrorCode PlateContact::AddJacobian(const PlateFrames &frames, const double *U, Mat A) const
{
  PetscFunctionBeginUser;
  for (const WallNode &wall_node : nodes) {
    const Node &node = mesh->nodes[wall_node.node];
    const PlateNodeBlock block = Block(wall_node, frames, U);
    const PetscInt place[4] = {node.displacement + 2, node.traction, node.traction + 1, node.traction + 2};
    double values[4][4] = {{0, 0, 0, block.d_force}};
    for (int i = 0; i < 3; ++i) {
      values[1 + i][0] = block.d_gap[i];
      for (int j = 0; j < 3; ++j) values[1 + i][1 + j] = block.d_traction(i, j);
    }
    PetscCall(MatSetValuesLocal(A, 4, place, 4, place, &values[0][0], ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PlateContact::AddPattern(Mat A) const
{
  const double zeros[16] = {};
  PetscFunctionBeginUser;
  for (const WallNode &wall_node : nodes) {
    const Node &node = mesh->nodes[wall_node.node];
    const PetscInt place[4] = {node.displacement + 2, node.traction, node.traction + 1, node.traction + 2};
    PetscCall(MatSetValuesLocal(A, 4, place, 4, place, zeros, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

void PlateContact::AddRoundOff(double *magnitude) const
{
  for (const WallNode &wall_node : nodes)
    for (int i = 0; i < 3; ++i)
      magnitude[mesh->nodes[wall_node.node].traction + i] +=
          std::numeric_limits<double>::epsilon() * wall_node.D * wall_node.c_N * extent;
}

double PlateContact::ForceOnTopPlate(const double *U) const
{
  double force = 0;
  for (const WallNode &wall_node : nodes)
    if (wall_node.outward > 0) force -= wall_node.D * U[mesh->nodes[wall_node.node].traction + 2];
  return force;
}

} // namespace tribogel
