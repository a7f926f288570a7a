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
    add(0, 0, 0);
    add(reach, 0, 1);
    if (order == 2) add(0.5 * reach, 0, 2);
  } else
    for (int j = 0; j <= order; ++j)
      for (int i = 0; i <= order; ++i)
        add((2.0 * i / order - 1) * reach, (2.0 * j / order - 1) * reach, i + j * (order + 1));
  plane.facet.push_back(facet);
  return plane;
}

} // namespace tribogel
