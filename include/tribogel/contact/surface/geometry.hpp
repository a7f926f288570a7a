/// What of the contact of two bodies in space does not change during a run: reference surfaces, weights,
/// scales of the slave nodes.
#pragma once

#include "tribogel/contact/node/slave_node.hpp"
#include "tribogel/contact/surface/facet.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace tribogel
{

struct SurfaceParameters {
  int order = 1;             ///< of the facets of both surfaces, 1 or 2
  double softer_modulus = 1; ///< shear modulus of the softer body, for the scale c_N [MPa]
  std::vector<bool> carries_multiplier =
      {};                          ///< of each slave node, false where u is prescribed; empty: all true
  bool exact_cells = true;         ///< false: mortar integrals at the slave facets' own Gauss points
  std::vector<bool> left_out = {}; ///< of each slave facet: it cannot touch; empty: all can
  /// Slave nodes at an edge that belong to another slave surface: they have no multiplier here, and their
  /// neighbours' basis functions are extended to them. Empty: none.
  std::vector<bool> on_crease = {};
  std::vector<double> neighbourhood = {}; ///< of each slave facet, as in QuadPair; empty: 1
};

/// A surface goes on beyond its edge, at each node there by half the longest of its sides that meet in that
/// node: however narrow the edge's facets are, and by the same length for both facets that share the side
/// which leads to it.
inline std::vector<EdgeExtension> edge_extensions(const QuadSurface &surface,
                                                  const std::vector<Vector3<double>> &X)
{
  const auto length = [&](int f, int side) {
    const auto [a, b] = surface.ends(f, side);
    return (X[a] - X[b]).norm();
  };
  std::vector<double> longest(X.size(), 0); // side of the edge at each node
  for (int f = 0; f < surface.facet_count(); ++f)
    for (int side = 0; side < 4; ++side)
      if (surface.on_edge[f][side])
        for (const int node : surface.ends(f, side)) longest[node] = std::max(longest[node], length(f, side));
  std::vector<EdgeExtension> beyond(surface.facets.size(), EdgeExtension{});
  for (int f = 0; f < surface.facet_count(); ++f)
    for (int side = 0; side < 4; ++side) {
      if (!surface.on_edge[f][side]) continue;
      const std::vector<int> along = surface.nodes_along(side);
      for (const int end : {0, 1}) { // 1 is half a facet
        const int node = surface.facets[f][end == 0 ? along.front() : along.back()],
                  leads_here = (side < 2 ? 2 : 0) + end;
        const double own = length(f, leads_here);
        beyond[f][side][end] = std::max(own, longest[node]) / own;
      }
    }
  return beyond;
}

struct SurfaceGeometry {
  using Measures = std::variant<std::vector<QuadMeasure<1>>, std::vector<QuadMeasure<2>>>;

  QuadReference slave, master;
  QuadSurface slave_surface, master_surface;
  Measures measures;            ///< of the slave facets
  std::vector<SlaveNode> nodes; ///< with w = 1
  double slave_area = 0;        ///< [mm^2]
  bool exact_cells = true;      ///< as in SurfaceParameters

  std::vector<double> neighbourhood; ///< as in SurfaceParameters
  std::vector<EdgeExtension> beyond; ///< of the master facets

  SurfaceGeometry() = default;
  SurfaceGeometry(QuadReference slave_face, QuadReference master_face, const SurfaceParameters &parameters)
      : slave(std::move(slave_face)), master(std::move(master_face)),
        slave_surface(slave.facets, parameters.order, static_cast<int>(slave.X.size()), parameters.left_out),
        master_surface(master.facets, parameters.order, static_cast<int>(master.X.size())),
        nodes(slave.X.size()), exact_cells(parameters.exact_cells), neighbourhood(parameters.neighbourhood),
        beyond(edge_extensions(master_surface, master.X))
  {
    if (parameters.order == 1)
      measure_facets<1>(parameters);
    else
      measure_facets<2>(parameters);
  }

private:
  /// The shares of the crease's nodes go to the next row of nodes (THEORY, section 3.6).
  template <int order>
  void extend_to_crease(int f, const std::vector<bool> &on_crease, QuadMeasure<order> &facet)
  {
    const auto &node = slave.facets[f];
    for (int side = 0; side < 4; ++side) {
      const std::vector<int> edge = slave_surface.nodes_along(side),
                             next = slave_surface.nodes_along(side, 1);
      if (!std::all_of(edge.begin(), edge.end(), [&](int b) { return on_crease[node[b]]; })) continue;
      for (std::size_t k = 0; k < edge.size(); ++k) {
        SlaveNode &neighbour = nodes[node[next[k]]];
        if (neighbour.tied >= 0 && neighbour.tied != node[edge[k]]) continue; // at a corner of the crease
        facet.basis.A.row(next[k]) += facet.basis.A.row(edge[k]);
        facet.basis.A.row(edge[k]).setZero();
        neighbour.tied = node[edge[k]];
        neighbour.tied_D += facet.basis.D[edge[k]];
        facet.basis.D[edge[k]] = 0;
      }
      return;
    }
  }

  template <int order> void measure_facets(const SurfaceParameters &parameters)
  {
    std::vector<QuadMeasure<order>> all;
    std::vector<double> size(nodes.size()), facets(nodes.size()); // mean over the node's facets
    for (int f = 0; f < slave_surface.facet_count(); ++f) {
      auto facet = quad_measure<order>(slave_surface.on_facet<order>(f, slave.X));
      const bool touches = slave_surface.takes_part(f);
      if (touches && !parameters.on_crease.empty()) extend_to_crease<order>(f, parameters.on_crease, facet);
      for (int b = 0; b < slave_surface.facet_nodes(); ++b) {
        const int a = slave.facets[f][b];
        if (touches) nodes[a].D += facet.basis.D[b];
        nodes[a].extent += facet.extent[b];
        size[a] += std::sqrt(facet.area);
        facets[a] += 1;
      }
      slave_area += facet.area;
      all.push_back(std::move(facet));
    }
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      nodes[a].carries = parameters.carries_multiplier.empty() || parameters.carries_multiplier[a];
      if (!parameters.on_crease.empty() && parameters.on_crease[a]) nodes[a].carries = false;
      if (slave_surface.neighbours[a].empty()) nodes[a].carries = false;
      nodes[a].c_N = parameters.softer_modulus * facets[a] / size[a];
    }
    measures = std::move(all);
  }
};

} // namespace tribogel
