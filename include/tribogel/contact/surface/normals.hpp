/// Averaged nodal normals of the slave surface: the unit normals of a node's facets, there, added and
/// normalised. At the surface's edge only its own facets count.
#pragma once

#include "tribogel/contact/surface/facet.hpp"

namespace tribogel
{

/// A nodal normal, zero where the node has no facet; if asked for, its derivatives with respect to the
/// positions of the nodes of its facets.
struct QuadNormal {
  Vector3<double> n = Vector3<double>::Zero();
  std::vector<std::pair<int, Matrix3<double>>> d; ///< (node, dn/dx) [1/mm]
};

inline Matrix3<double> cross_matrix(const Vector3<double> &a)
{
  Matrix3<double> A;
  A << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return A;
}

namespace quad_normals
{

template <int order>
void add_facet(const QuadSurface &surface, const QuadSurface::FacetNode &at,
               const std::vector<Vector3<double>> &x, bool with_derivative, QuadNormal &sum)
{
  const auto shape = tensor_shape<2, order>(quad_corner<order>(at.local));
  const QuadPoints<order> points = surface.on_facet<order>(at.facet, x);
  const Vector3<double> t1 = tangent(shape.dN, points, 0), t2 = tangent(shape.dN, points, 1),
                        c = t1.cross(t2);
  const double length = c.norm();
  const Vector3<double> unit = c / length;
  sum.n += unit;
  if (!with_derivative) return;
  const Matrix3<double> project = (Matrix3<double>::Identity() - unit * unit.transpose()) / length;
  const Matrix3<double> by_t1 = -project * cross_matrix(t2), by_t2 = project * cross_matrix(t1);
  for (std::size_t b = 0; b < points.size(); ++b) {
    if (shape.dN[b][0] == 0 && shape.dN[b][1] == 0) continue;
    const Matrix3<double> d = shape.dN[b][0] * by_t1 + shape.dN[b][1] * by_t2;
    const int node = surface.facets[at.facet][b];
    auto known = sum.d.begin();
    while (known != sum.d.end() && known->first != node) ++known;
    if (known == sum.d.end())
      sum.d.emplace_back(node, d);
    else
      known->second += d;
  }
}

} // namespace quad_normals

inline QuadNormal quad_normal(const QuadSurface &surface, int a, const std::vector<Vector3<double>> &x,
                              bool with_derivative)
{
  QuadNormal normal;
  if (surface.neighbours[a].empty()) return normal;
  for (const auto &at : surface.neighbours[a])
    if (surface.order == 1)
      quad_normals::add_facet<1>(surface, at, x, with_derivative, normal);
    else
      quad_normals::add_facet<2>(surface, at, x, with_derivative, normal);
  const double length = normal.n.norm();
  normal.n /= length;
  const Matrix3<double> project = (Matrix3<double>::Identity() - normal.n * normal.n.transpose()) / length;
  for (auto &[node, d] : normal.d) d = project * d;
  return normal;
}

} // namespace tribogel
