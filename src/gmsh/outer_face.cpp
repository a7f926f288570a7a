#include "gmsh/outer_face.hpp"

#include <cmath>

namespace tribogel
{

Place plus(const Place &a, double by, const Place &b)
{
  return {a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]};
}

Place area_vector(const SerialMesh &mesh, const OuterFace &face)
{
  const auto [a, b, c, d] = face.around;
  const Place p = plus(mesh.vertex[c], -1, mesh.vertex[a]), q = plus(mesh.vertex[d], -1, mesh.vertex[b]);
  return {(p[1] * q[2] - p[2] * q[1]) / 2, (p[2] * q[0] - p[0] * q[2]) / 2, (p[0] * q[1] - p[1] * q[0]) / 2};
}

double length(const Place &a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

Place on_face(const SerialMesh &mesh, const OuterFace &face, double xi, double eta)
{
  const double weight[4] = {(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta};
  Place X{};
  for (int v = 0; v < 4; ++v) X = plus(X, weight[v], mesh.vertex[face.around[v]]);
  return X;
}

std::string example(const GmshBodies &bodies, const OuterFace &face)
{
  return "that of element " + std::to_string(bodies.element[face.cell]) + " at " +
         in_words(on_face(bodies.mesh, face, 0.5, 0.5));
}

} // namespace tribogel
