#include "contact/wall_on_plate.hpp"

#include "contact/kernels.hpp"
#include "contact/surface_reference.hpp"
#include "tribogel/contact/curve/geometry.hpp"
#include "tribogel/contact/node/plate.hpp"
#include "tribogel/contact/surface/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

/// Of one node of a wall, as in CurveGeometry and SurfaceGeometry.
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
    CurveParameters parameters;
    parameters.order = order;
    parameters.softer_modulus = softer_modulus;
    list(CurveGeometry(chain_of(wall), {}, parameters));
  } else
    list(SurfaceGeometry(quads_of(wall), {}, {order, softer_modulus, {}}));
  return weights;
}

/// Of the top plate's face in its frame: about y by the tilt.
Vector3<double> upwards(const Scene &scene, int body)
{
  const double tilt = body == top_body ? scene.misalignment.tilt : 0;
  return {std::sin(tilt), 0, std::cos(tilt)};
}

Vector3<double> place_of(const std::array<double, 3> &X, int dim)
{
  return dim == 2 ? Vector3<double>(X[0], 0, X[1]) : Vector3<double>(X[0], X[1], X[2]);
}

} // namespace

void WallOnPlate::SetUp(const Mesh &both, const Scene &scene, int body, const Surface &wall,
                        const std::vector<bool> &taken)
{
  mesh = &both;
  up = upwards(scene, body);
  spans_both = !scene.has_top();
  const Specimen &specimen = body == top_body ? scene.top : scene.bottom;
  const std::vector<NodeWeight> weights =
      weights_of(wall, mesh->dim, mesh->order, specimen.material.equilibrium.shear_modulus());
  const auto height = [&](const SurfaceNode &node) { return up.dot(place_of(node.X, mesh->dim)); };
  double foot = std::numeric_limits<double>::infinity(), head = -foot;
  for (const SurfaceNode &node : wall.node) {
    foot = std::min(foot, height(node));
    head = std::max(head, height(node));
  }
  extent = scene.gel_height() + scene.gap();
  for (std::size_t a = 0; a < wall.node.size(); ++a) {
    const SurfaceNode &node = wall.node[a];
    if (node.local < 0 || !node.multiplier || taken[a]) continue;
    // A gel between both plates may meet either, the nearer one; with two gels each has one plate of its own.
    const bool above = body == top_body || (spans_both && height(node) > 0.5 * (foot + head));
    nodes.push_back(
        {node.local, weights[a].D, weights[a].c_N, above, above ? head - height(node) : height(node) - foot});
  }
}

PlateNodeBlock WallOnPlate::Block(const WallNode &wall_node, const PlateFrames &frames, const double *U) const
{
  const Node &node = mesh->nodes[wall_node.node];
  const Vector3<double> outward = wall_node.above ? up : Vector3<double>(-up);
  const double driven = spans_both && wall_node.above ? frames.top_travel : 0;
  return plate_node(wall_node.gap + driven - outward.dot(Vector3<double>(&U[node.displacement])), outward,
                    Vector3<double>(&U[node.traction]), wall_node.D, wall_node.c_N);
}

void WallOnPlate::AddResidual(const PlateFrames &frames, const double *U, double *F, double *magnitude) const
{
  for (const WallNode &wall_node : nodes) {
    const Node &node = mesh->nodes[wall_node.node];
    const PlateNodeBlock block = Block(wall_node, frames, U);
    const double *traction = U + node.traction;
    const double in_plane = wall_node.D * std::hypot(traction[0], traction[2]);
    const double size[3] = {in_plane, wall_node.D * std::abs(traction[1]), in_plane};
    for (int i = 0; i < 3; ++i) {
      F[node.displacement + i] += block.force[i];
      magnitude[node.displacement + i] += std::abs(block.force[i]);
      F[node.traction + i] += block.condition[i];
      magnitude[node.traction + i] += size[i];
    }
  }
}

namespace
{

/// Displacements, then multipliers.
std::array<PetscInt, 6> unknowns_of(const Node &node)
{
  std::array<PetscInt, 6> place{};
  for (int i = 0; i < 3; ++i) {
    place[i] = node.displacement + i;
    place[3 + i] = node.traction + i;
  }
  return place;
}

} // namespace

PetscErrorCode WallOnPlate::AddJacobian(const PlateFrames &frames, const double *U, Mat A) const
{
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> values;
  PetscFunctionBeginUser;
  for (const WallNode &wall_node : nodes) {
    const auto place = unknowns_of(mesh->nodes[wall_node.node]);
    const PlateNodeBlock block = Block(wall_node, frames, U);
    values << Matrix3<double>::Zero(), block.d_force, block.d_gap, block.d_traction;
    PetscCall(MatSetValuesLocal(A, 6, place.data(), 6, place.data(), values.data(), ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode WallOnPlate::AddPattern(Mat A) const
{
  const double zeros[36] = {};
  PetscFunctionBeginUser;
  for (const WallNode &wall_node : nodes) {
    const auto place = unknowns_of(mesh->nodes[wall_node.node]);
    PetscCall(MatSetValuesLocal(A, 6, place.data(), 6, place.data(), zeros, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

void WallOnPlate::AddTravelSlope(const PlateFrames &frames, const double *U, double *by_travel) const
{
  for (const WallNode &wall_node : nodes) {
    if (!spans_both || !wall_node.above) continue;
    const Vector3<double> slope = -Block(wall_node, frames, U).d_gap * up; // the gap grows by the travel
    for (int i = 0; i < 3; ++i) by_travel[mesh->nodes[wall_node.node].traction + i] += slope[i];
  }
}

void WallOnPlate::AddRoundOff(double *magnitude) const
{
  for (const WallNode &wall_node : nodes)
    for (int i = 0; i < 3; ++i)
      magnitude[mesh->nodes[wall_node.node].traction + i] +=
          std::numeric_limits<double>::epsilon() * wall_node.D * wall_node.c_N * extent;
}

Wrench WallOnPlate::ReactionOfTopPlate(const double *U) const
{
  Wrench wrench;
  for (const WallNode &wall_node : nodes) {
    if (!wall_node.above) continue;
    const Node &node = mesh->nodes[wall_node.node];
    const Vector3<double> f = wall_node.D * up.dot(Vector3<double>(&U[node.traction])) * up;
    if (mesh->dim == 2)
      wrench.force += f;
    else
      wrench.add(f, place_of(node.X, 3) + Vector3<double>(&U[node.displacement]));
  }
  return wrench;
}

} // namespace tribogel
