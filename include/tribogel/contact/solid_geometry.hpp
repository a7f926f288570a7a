/// What of the contact of two bodies in space does not change during a run: reference surfaces, weights, scales of the
/// slave nodes.
#pragma once

#include "tribogel/contact/quad_facet.hpp"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace tribogel
{

struct SolidParameters {
  int order = 1;                             ///< of the facets of both surfaces, 1 or 2
  double softer_modulus = 1;                 ///< shear modulus of the softer body, for the scale c_N [MPa]
  std::vector<bool> carries_multiplier = {}; ///< of each slave node, false where u is prescribed; empty: all true
  bool exact_cells = true;                   ///< false: mortar integrals at the slave facets' own Gauss points
};

struct SolidGeometry {
  struct Node {
    bool carries = false; ///< has a multiplier
    double D = 0;         ///< constant diagonal of the mortar matrix, int psi_a dS [mm^2]
    double extent = 0;    ///< int |N_a| dS: row scale of a node without multiplier [mm^2]
    double c_N = 0;       ///< softer modulus over the mean size of the node's facets [MPa/mm]

    double weight() const { return D; }
  };
  using Measures = std::variant<std::vector<QuadMeasure<1>>, std::vector<QuadMeasure<2>>>;

  QuadReference slave, master;
  QuadSurface slave_surface, master_surface;
  Measures measures; ///< of the slave facets
  std::vector<Node> nodes;
  double slave_area = 0;   ///< [mm^2]
  bool exact_cells = true; ///< as in SolidParameters

  SolidGeometry() = default;
  SolidGeometry(QuadReference slave_face, QuadReference master_face, const SolidParameters &parameters)
      : slave(std::move(slave_face)), master(std::move(master_face)),
        slave_surface(slave.facets, parameters.order, static_cast<int>(slave.X.size())),
        master_surface(master.facets, parameters.order, static_cast<int>(master.X.size())), nodes(slave.X.size()),
        exact_cells(parameters.exact_cells)
  {
    if (parameters.order == 1)
      measure_facets<1>(parameters);
    else
      measure_facets<2>(parameters);
  }

private:
  template <int order> void measure_facets(const SolidParameters &parameters)
  {
    std::vector<QuadMeasure<order>> all;
    std::vector<double> size(nodes.size());
    for (int f = 0; f < slave_surface.facet_count(); ++f) {
      all.push_back(quad_measure<order>(slave_surface.on_facet<order>(f, slave.X)));
      for (int b = 0; b < slave_surface.facet_nodes(); ++b) {
        const int a = slave.facets[f][b];
        nodes[a].D += all.back().basis.D[b];
        nodes[a].extent += all.back().extent[b];
        size[a] += std::sqrt(all.back().area) / static_cast<double>(slave_surface.neighbours[a].size());
      }
      slave_area += all.back().area;
    }
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      nodes[a].carries = parameters.carries_multiplier.empty() || parameters.carries_multiplier[a];
      nodes[a].c_N = parameters.softer_modulus / size[a];
    }
    measures = std::move(all);
  }
};

} // namespace tribogel
