#include "mesh/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

using Place = std::array<double, 3>;

struct Heights {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest; ///< [mm]
};

Heights heights_of(const SerialMesh &mesh, int body, const SerialMesh::Shape &shape)
{
  Heights z;
  for (const SerialMesh::Cell &cell : mesh.cell)
    for (int v = 0; cell.body == body && v < mesh.corners(); ++v) {
      const double height = shape(mesh.vertex[cell.vertex[v]])[2];
      z.lowest = std::min(z.lowest, height);
      z.highest = std::max(z.highest, height);
    }
  return z;
}

} // namespace

void tilt_top(SerialMesh &mesh, double angle)
{
  SerialMesh::Shape upright = mesh.shape[top_body];
  if (!upright) upright = [](const Place &X) { return X; };
  const Heights before = heights_of(mesh, top_body, upright);
  const double c = std::cos(angle), s = std::sin(angle);
  const auto inclined = [=](double rise) {
    return [=](const Place &X) -> Place {
      const Place x = upright(X);
      const double z = x[2] - before.highest;
      return {c * x[0] + s * z, x[1], before.highest + rise - s * x[0] + c * z};
    };
  };
  const double lowest = heights_of(mesh, top_body, inclined(0)).lowest;
  mesh.shape[top_body] = inclined(before.lowest - lowest);
}

} // namespace tribogel
