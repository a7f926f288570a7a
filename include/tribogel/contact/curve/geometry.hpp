/// What of the axisymmetric contact does not change during a run: reference curves, weights, scales of the
/// slave nodes.
#pragma once

#include "tribogel/contact/curve/state.hpp"
#include "tribogel/contact/node/slave_node.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace tribogel
{

struct CurveParameters {
  int order = 1;             ///< of the facets of both curves, 1 or 2
  double twist_length = 1;   ///< L in w = L x twist [mm]
  double softer_modulus = 1; ///< shear modulus of the softer body, for the scale c_N [MPa]
  std::vector<bool> carries_multiplier =
      {};                     ///< of each slave node, false where u is prescribed; empty: all true
  int facets_in_contact = -1; ///< only the first so many slave facets can touch; -1: all
  /// The curve begins at an edge whose node belongs to another slave curve: it has no multiplier here, and
  /// its neighbour's basis function is extended to it.
  bool starts_at_crease = false;
};

struct CurveGeometry {
  /// With the weight w = 2 pi R. In order 2 the axis node, whose D vanishes, never carries a multiplier.
  struct Node : SlaveNode {
    bool on_axis = false;
  };
  using Measures = std::variant<std::vector<FacetMeasure<2>>, std::vector<FacetMeasure<3>>>;

  SurfaceReference slave, master;
  LineChain slave_chain, master_chain; ///< of the slave: the facets that can touch
  Measures measures;                   ///< of the slave facets
  std::vector<Node> nodes;             ///< of the slave
  double twist_length = 1;             ///< [mm]
  double slave_length = 0;             ///< of the slave curve [mm]

  CurveGeometry() = default;
  CurveGeometry(SurfaceReference slave_curve, SurfaceReference master_curve,
                const CurveParameters &parameters)
      : slave(std::move(slave_curve)), master(std::move(master_curve)),
        slave_chain(touching(slave.facets, parameters.facets_in_contact), parameters.order + 1,
                    static_cast<int>(slave.X.size())),
        master_chain(master.facets, parameters.order + 1, static_cast<int>(master.X.size())),
        nodes(slave.X.size()), twist_length(parameters.twist_length)
  {
    if (parameters.order == 1)
      measure_facets<2>(parameters);
    else
      measure_facets<3>(parameters);
  }

private:
  static std::vector<std::array<int, 3>> touching(const std::vector<std::array<int, 3>> &facets, int count)
  {
    return {facets.begin(), count < 0 ? facets.end() : facets.begin() + count};
  }

  /// The crease node's share of its facet goes to the next node along the curve.
  template <int facet_nodes> void extend_to_crease(FacetMeasure<facet_nodes> &facet)
  {
    constexpr int next = facet_nodes - 1; // the midside node, or the other end
    auto &basis = facet.basis;
    basis.A.row(next) += basis.A.row(0);
    basis.A.row(0).setZero();
    Node &neighbour = nodes[slave.facets[0][next]];
    neighbour.tied = slave.facets[0][0];
    neighbour.tied_D = basis.D[0];
    basis.D[0] = 0;
  }

  template <int facet_nodes> void measure_facets(const CurveParameters &parameters)
  {
    constexpr double round_off = 1e-12;
    double outermost = 0;
    for (const auto &X : slave.X) outermost = std::max(outermost, X.r);
    std::vector<FacetMeasure<facet_nodes>> facets;
    std::vector<double> length(nodes.size()); // mean over the node's facets
    const LineChain whole(slave.facets, facet_nodes, static_cast<int>(slave.X.size()));
    for (int f = 0; f < whole.facet_count(); ++f) {
      auto facet = facet_measure<facet_nodes>(whole.on_facet<facet_nodes>(f, slave.X));
      const bool touches = f < slave_chain.facet_count();
      if (f == 0 && touches && parameters.starts_at_crease) extend_to_crease(facet);
      for (int b = 0; b < facet_nodes; ++b) {
        const int a = whole.facets[f][b];
        if (touches) nodes[a].D += facet.basis.D[b];
        nodes[a].extent += facet.extent[b];
        length[a] += facet.length / whole.neighbours[a].count;
      }
      slave_length += facet.length;
      if (touches) facets.push_back(facet);
    }
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      Node &node = nodes[a];
      node.on_axis = slave.X[a].r <= round_off * outermost;
      node.carries = parameters.carries_multiplier.empty() || parameters.carries_multiplier[a];
      if (parameters.order == 2 && node.on_axis) node.carries = false;
      if (slave_chain.neighbours[a].count == 0) node.carries = false;
      if (parameters.starts_at_crease && !slave.facets.empty() && static_cast<int>(a) == slave.facets[0][0])
        node.carries = false;
      node.c_N = parameters.softer_modulus / length[a];
    }
    measures = std::move(facets);
  }
};

} // namespace tribogel
