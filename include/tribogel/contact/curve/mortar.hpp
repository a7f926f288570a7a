/// Mortar integrals of whole slave facets: the facet pairs summed over the master, with or without
/// derivatives.
#pragma once

#include "tribogel/contact/curve/geometry.hpp"
#include "tribogel/contact/curve/mortar_kernel.hpp"
#include "tribogel/contact/curve/normals.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <span>

namespace tribogel
{

/// Index of `node` in a short list, to which it is appended if it is not there.
inline int index_in(std::vector<int> &list, int node)
{
  const auto at = std::find(list.begin(), list.end(), node);
  if (at != list.end()) return static_cast<int>(at - list.begin());
  list.push_back(node);
  return static_cast<int>(list.size()) - 1;
}

/// M of one slave facet.
template <class T> struct FacetMortar {
  MortarStatus status = MortarStatus::ok;
  double overhang = 0;             ///< reference length beyond the master's edge [mm]
  std::vector<int> masters;        ///< nodes k of the master
  std::vector<std::array<T, 3>> M; ///< [k][a], a the slave node's number in the facet [mm^2]

  /// dM[k][a] in row 3 k + a; columns: (r, z) of the facet's 3 slave positions, of its 3 nodal normals, of
  /// each master k. Only filled when derivatives were asked for.
  Eigen::MatrixXd derivative;
};

/// Pairs (slave facet, master facet), sorted.
using FacetPairs = std::span<const std::pair<int, int>>;

/// Those of one slave facet.
inline FacetPairs pairs_of(FacetPairs pairs, int slave_facet)
{
  const auto run = std::equal_range(pairs.begin(), pairs.end(), std::pair(slave_facet, 0),
                                    [](const auto &l, const auto &r) { return l.first < r.first; });
  return {run.first, run.second};
}

namespace axisymmetric_mortar
{

template <int nodes, class T>
LinePair<nodes, T> pair_of(const CurveGeometry &geometry, std::pair<int, int> facets,
                           const std::vector<PlanePoint<T>> &x, const std::vector<PlanePoint<T>> &n,
                           const std::vector<PlanePoint<T>> &y)
{
  const auto [f, m] = facets;
  return {geometry.slave_chain.on_facet<nodes>(f, x), geometry.slave_chain.on_facet<nodes>(f, n),
          geometry.master_chain.on_facet<nodes>(m, y), m == 0, m + 1 == geometry.master_chain.facet_count()};
}

/// The pair as independent variables: slave positions, normals, master positions in this order.
template <int nodes> LinePair<nodes, Dual<6 * nodes>> seeded(const LinePair<nodes, double> &pair)
{
  using D = Dual<6 * nodes>;
  LinePair<nodes, D> dual{{}, {}, {}, pair.inner_edge, pair.outer_edge};
  const auto seed = [](const FacetPoints<nodes, double> &from, FacetPoints<nodes, D> &to, int first) {
    for (int a = 0; a < nodes; ++a)
      to[a] = {D::seed(from[a].r, first + 2 * a), D::seed(from[a].z, first + 2 * a + 1)};
  };
  seed(pair.x, dual.x, 0);
  seed(pair.n, dual.n, 2 * nodes);
  seed(pair.y, dual.y, 4 * nodes);
  return dual;
}

/// Sum the pairs' integrals by master node. Empty pairs leave no trace.
template <int nodes, class S, class T, class Pairs>
FacetMortar<T> gather(const CurveGeometry &geometry, FacetPairs candidates, const Pairs &integral_of_pair)
{
  constexpr double coverage_tolerance = 1e-9;
  FacetMortar<T> sum;
  std::vector<std::pair<int, LinePairMortar<nodes, S>>> cells;
  double covered = 0;
  for (const auto &pair : candidates) {
    LinePairMortar<nodes, S> cell = integral_of_pair(pair);
    if (cell.status != MortarStatus::ok && sum.status == MortarStatus::ok) sum.status = cell.status;
    if (cell.covered == 0) continue;
    covered += cell.covered;
    sum.overhang += cell.overhang;
    for (int b = 0; b < nodes; ++b) index_in(sum.masters, geometry.master_chain.facets[pair.second][b]);
    cells.emplace_back(pair.second, cell);
  }
  if (sum.status == MortarStatus::ok && !(std::abs(covered - 2) <= coverage_tolerance))
    sum.status = MortarStatus::uncovered;
  sum.M.resize(sum.masters.size(), {});
  constexpr bool with_derivative = !std::is_same_v<S, T>;
  if constexpr (with_derivative) sum.derivative.setZero(3 * sum.masters.size(), 12 + 2 * sum.masters.size());
  for (const auto &[m, cell] : cells) {
    std::array<int, nodes> k;
    for (int b = 0; b < nodes; ++b) k[b] = index_in(sum.masters, geometry.master_chain.facets[m][b]);
    for (int b = 0; b < nodes; ++b)
      for (int a = 0; a < nodes; ++a) {
        if constexpr (with_derivative) {
          const auto &d = cell.M[a][b].d;
          auto row = sum.derivative.row(3 * k[b] + a);
          sum.M[k[b]][a] += cell.M[a][b].v;
          for (int j = 0; j < 2 * nodes; ++j) row[j] += d[j], row[6 + j] += d[2 * nodes + j];
          for (int j = 0; j < 2 * nodes; ++j) row[12 + 2 * k[j / 2] + j % 2] += d[4 * nodes + j];
        } else
          sum.M[k[b]][a] += cell.M[a][b];
      }
  }
  return sum;
}

} // namespace axisymmetric_mortar

/// Integrals of slave facet f in the arithmetic of T, from the positions x, y and the slave normals n of all
/// nodes.
template <class T>
FacetMortar<T> facet_mortar(const CurveGeometry &geometry, int f, FacetPairs candidates,
                            const std::vector<PlanePoint<T>> &x, const std::vector<PlanePoint<T>> &n,
                            const std::vector<PlanePoint<T>> &y)
{
  using namespace axisymmetric_mortar;
  const auto integrate = [&]<int nodes>(const std::vector<FacetMeasure<nodes>> &measures) {
    return gather<nodes, T, T>(geometry, candidates, [&](std::pair<int, int> facets) {
      return line_pair_mortar<nodes, T>(measures[f], pair_of<nodes, T>(geometry, facets, x, n, y));
    });
  };
  return std::visit(integrate, geometry.measures);
}

/// The same with the derivatives with respect to the facet's own data.
inline FacetMortar<double> facet_mortar_derivative(const CurveGeometry &geometry, int f,
                                                   FacetPairs candidates,
                                                   const std::vector<PlanePoint<double>> &x,
                                                   const std::vector<PlanePoint<double>> &n,
                                                   const std::vector<PlanePoint<double>> &y)
{
  using namespace axisymmetric_mortar;
  const auto integrate = [&]<int nodes>(const std::vector<FacetMeasure<nodes>> &measures) {
    return gather<nodes, Dual<6 * nodes>, double>(geometry, candidates, [&](std::pair<int, int> facets) {
      return line_pair_mortar<nodes>(measures[f],
                                     seeded<nodes>(pair_of<nodes, double>(geometry, facets, x, n, y)));
    });
  };
  return std::visit(integrate, geometry.measures);
}

} // namespace tribogel
