#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

Surface rigid_plane(int dim, int order, const Surface &pressed)
{
  constexpr double beyond = 16; // times the gel's largest distance from the axis: no gel spreads so far
  double farthest = 0;
  for (const SurfaceNode &node : pressed.node)
    farthest = std::max(farthest, dim == 2 ? node.X[0] : std::hypot(node.X[0], node.X[1]));
  const double reach = beyond * farthest;
  Surface plane;
  std::array<int, 9> facet;
  facet.fill(-1);
  const auto add = [&](double x, double y, int place) {
    facet[place] = static_cast<int>(plane.node.size());
    plane.node.push_back({{x, y, 0}, {-1, -1, -1}, {-1, -1, -1}, false, -1});
  };
  if (dim == 2) {
    constexpr double along[] = {0, 1, 0.5};
    for (int k = 0; k <= order; ++k) add(along[k] * reach, 0, k);
  } else
    for (int k = 0; k < (order + 1) * (order + 1); ++k)
      add((2.0 * (k % (order + 1)) / order - 1) * reach, (2.0 * (k / (order + 1)) / order - 1) * reach, k);
  plane.facet.push_back(facet);
  return plane;
}

} // namespace tribogel
