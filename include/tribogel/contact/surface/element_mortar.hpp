/// Mortar integrals of a slave facet at its own Gauss points, each projected to whichever master facet it
/// hits: cheap, and not exact where a facet faces several, since the integrand has kinks there.
///
///     M_ab = sum_q w_q psi_a(xi_q) N_b(eta(xi_q)) J(xi_q)
///
/// sum_b M_ab = D_a holds as for exact cells, so forces balance to round-off; uniform pressure is passed on
/// with an error (THEORY, section 3.7).
#pragma once

#include "tribogel/contact/surface/point.hpp"

#include <utility>
#include <vector>

namespace tribogel
{

/// Gauss points in each direction of a slave facet.
template <int order> inline constexpr int element_points = order + 3;

/// How far beyond a facet a point is, where 1 is the end of its extension, or half of its width; less than 0
/// inside.
inline double beyond_facet(const std::array<double, 2> &eta, const EdgeExtension &extension)
{
  double farthest = -1;
  for (int side = 0; side < 4; ++side) {
    const double past = (side % 2 == 0 ? -1 : 1) * eta[side / 2] - 1,
                 end = std::max(extension[side][0], extension[side][1]);
    farthest = std::max(farthest, past > 0 && end > 0 ? past / end : past);
  }
  return farthest;
}

/// One result for each of `pairs`, which hold the same slave data; a point that hits none makes the facet
/// uncovered (sum of `covered` < 4).
template <int order>
std::vector<QuadPairMortar<order>> quad_element_mortar(const QuadMeasure<order> &slave,
                                                       const std::vector<QuadPair<order>> &pairs,
                                                       bool derivatives)
{
  constexpr int points = element_points<order>, nodes = tensor_nodes<2, order>;
  static_assert(points * points <= quad_mortar::Samples<order>::most);
  static const auto rule = gauss_rule<points>();
  std::vector<QuadPairMortar<order>> results(pairs.size());
  std::vector<quad_mortar::Point<order>> at;
  for (const QuadPair<order> &pair : pairs) at.emplace_back(slave, pair);
  struct Hit {
    typename quad_mortar::Point<order>::Meeting meeting;
    double weight;
  };
  std::vector<std::vector<Hit>> hits(pairs.size());
  for (int q = 0; q < points * points; ++q) {
    const double weight = rule.weight[q % points] * rule.weight[q / points];
    typename quad_mortar::Point<order>::Meeting hit;
    double nearest = 1; // as beyond_facet has it
    std::size_t which = pairs.size();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto meeting = at[k].meet({rule.point[q % points], rule.point[q / points]});
      if (!meeting.found || !meeting.from_front) continue;
      const double beyond = beyond_facet(meeting.eta, pairs[k].beyond);
      if (beyond > nearest) continue;
      nearest = beyond;
      which = k;
      hit = meeting;
    }
    if (which == pairs.size()) continue;
    results[which].covered += weight;
    hits[which].push_back({hit, weight});
  }
  quad_mortar::Samples<order> samples;
  quad_mortar::SampleSlopes<order> slopes;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (hits[k].empty()) continue;
    samples.count = 0;
    for (const Hit &one : hits[k])
      results[k].overhang += at[k].sample(one.meeting, one.weight, derivatives, samples);
    results[k].M = samples.integral();
    if (!derivatives) continue;
    results[k].dM.setZero(nodes * nodes, 9 * nodes);
    slopes.clear();
    slopes.add(samples, 1);
    slopes.add_to(slave.basis.A, results[k].dM);
  }
  return results;
}

} // namespace tribogel
