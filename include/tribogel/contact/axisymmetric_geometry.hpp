/// What of the axisymmetric contact does not change during a run: reference curves, weights, scales of the slave nodes.
#pragma once

#include "tribogel/contact/axisymmetric_state.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace tribogel
{

struct ContactParameters {
  int order = 1;                             ///< of the facets of both curves, 1 or 2
  double twist_length = 1;                   ///< L in w = L x twist [mm]
  double softer_modulus = 1;                 ///< shear modulus of the softer body, for the scale c_N [MPa]
  std::vector<bool> carries_multiplier = {}; ///< of each slave node, false where u is prescribed; empty: all true
};

struct ContactGeometry {
  struct Node {
    bool on_axis = false;
    bool carries = false; ///< has a multiplier; never the axis node in order 2, whose weight D vanishes
    double D = 0;         ///< constant diagonal of the mortar matrix, int psi_a 2 pi R dS [mm^2]
    double extent = 0;    ///< int |N_a| 2 pi R dS > 0: row scale of a node without multiplier [mm^2]
    double c_N = 0;       ///< softer modulus over the mean length of the node's facets [MPa/mm]
  };
  using Measures = std::variant<std::vector<FacetMeasure<2>>, std::vector<FacetMeasure<3>>>;

  SurfaceReference slave, master;
  LineChain slave_chain, master_chain;
  Measures measures;       ///< of the slave facets
  std::vector<Node> nodes; ///< of the slave
  double twist_length = 1; ///< [mm]
  double slave_length = 0; ///< of the slave curve [mm]

  ContactGeometry() = default;
  ContactGeometry(SurfaceReference slave_curve, SurfaceReference master_curve, const ContactParameters &parameters)
      : slave(std::move(slave_curve)), master(std::move(master_curve)),
        slave_chain(slave.facets, parameters.order + 1, static_cast<int>(slave.X.size())),
        master_chain(master.facets, parameters.order + 1, static_cast<int>(master.X.size())), nodes(slave.X.size()),
        twist_length(parameters.twist_length)
  {
    if (parameters.order == 1)
      measure_facets<2>(parameters);
    else
      measure_facets<3>(parameters);
  }

private:
  template <int facet_nodes> void measure_facets(const ContactParameters &parameters)
  {
    constexpr double round_off = 1e-12;
    double outermost = 0;
    for (const auto &X : slave.X) outermost = std::max(outermost, X.r);
    std::vector<FacetMeasure<facet_nodes>> facets;
    std::vector<double> length(nodes.size()); // mean over the node's facets
    for (int f = 0; f < slave_chain.facet_count(); ++f) {
      const auto facet = facet_measure<facet_nodes>(slave_chain.on_facet<facet_nodes>(f, slave.X));
      for (int b = 0; b < facet_nodes; ++b) {
        Node &node = nodes[slave_chain.facets[f][b]];
        node.D += facet.basis.D[b];
        node.extent += facet.extent[b];
        length[slave_chain.facets[f][b]] += facet.length / slave_chain.neighbours[slave_chain.facets[f][b]].count;
      }
      slave_length += facet.length;
      facets.push_back(facet);
    }
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      Node &node = nodes[a];
      node.on_axis = slave.X[a].r <= round_off * outermost;
      node.carries = parameters.carries_multiplier.empty() || parameters.carries_multiplier[a];
      if (parameters.order == 2 && node.on_axis) node.carries = false;
      node.c_N = parameters.softer_modulus / length[a];
    }
    measures = std::move(facets);
  }
};

} // namespace tribogel
