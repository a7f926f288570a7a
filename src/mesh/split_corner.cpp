#include "mesh/split_corner.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

BlockGrid::BlockGrid(const MeridianBlock &block)
    : R(block.R), Z(block.Z), split(block.split), first(static_cast<int>(block.R.size()) - 1 - block.split)
{
}

/// A point of the corner's inner sides goes along its row or column to the diagonal.
BlockGrid::Point BlockGrid::joined(int i, int j) const
{
  if (i < first || j > split) return {i, j};
  return i == first ? Point{columns() - 1 - j, j} : Point{i, columns() - 1 - i};
}

bool BlockGrid::has_point(int i, int j) const
{
  return i < first || j > split || i + j == columns() - 1;
}

std::array<double, 2> BlockGrid::position(int i, int j) const
{
  if (split == 0) return {R[i], Z[j]};
  double r = R[i], z = Z[j];
  const int last = columns() - 1;
  if (j <= split && i > first - split && i < first) // columns before the corner, drawn towards the diagonal
    r += (R[last - j] - R[first]) * (i - (first - split)) / split;
  if (i >= first && j > split && j < 2 * split) // rows above it
    z += (Z[last - i] - Z[split]) * (2 * split - j) / split;
  return {r, z};
}

int split_of_lower_edge(const Scene &scene, const MeridianBlock &top, double zone)
{
  constexpr double holding_friction = 0.1; // over it
  constexpr double resolved = 0.125;       // of the zone of small edges: the corner's are shorter
  if (scene.model != Model::axisymmetric) return 0;
  double rate = 0;
  for (const Phase &phase : scene.schedule) rate = std::max(rate, std::abs(phase.rate));
  const double modulus = scene.softer_modulus();
  const auto mu = [&](double v) { return scene.friction.coefficient(v, modulus); };
  if (!(std::max(mu(0), mu(rate * top.R.back())) >= holding_friction)) return 0;
  const int cells = 1 << scene.mesh.refinements; // those that come of one
  const auto columns = static_cast<int>(top.R.size()), rows = static_cast<int>(top.Z.size());
  if (columns < 3 * cells + 1 || rows < 3 * cells + 1) return 0;
  const double edge = std::max(top.R.back() - top.R[columns - 1 - cells], top.Z[cells] - top.Z[0]);
  return edge < resolved * zone ? cells : 0;
}

} // namespace tribogel
