#include "mesh/face.hpp"

#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"

#include <cmath>

namespace tribogel
{

namespace
{

using Place = std::array<double, 3>;

template <int order>
void add(const std::array<Place, tensor_nodes<2, order>> &X, std::vector<FaceSample> &samples)
{
  constexpr int points = 4;
  static const auto gauss = gauss_rule<points>();
  for (int q = 0; q < points * points; ++q) {
    const auto shape = tensor_shape<2, order>({gauss.point[q % points], gauss.point[q / points]});
    double slope[2][3] = {};
    FaceSample sample{};
    for (int a = 0; a < tensor_nodes<2, order>; ++a)
      for (int i = 0; i < 3; ++i) {
        sample.X[i] += shape.N[a] * X[a][i];
        for (int j = 0; j < 2; ++j) slope[j][i] += shape.dN[a][j] * X[a][i];
      }
    const double n[3] = {slope[0][1] * slope[1][2] - slope[0][2] * slope[1][1],
                         slope[0][2] * slope[1][0] - slope[0][0] * slope[1][2],
                         slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0]};
    sample.area = gauss.weight[q % points] * gauss.weight[q / points] * std::hypot(n[0], n[1], n[2]);
    samples.push_back(sample);
  }
}

template <int order>
void add(const Surface &surface, const std::array<int, 9> &facet, std::vector<FaceSample> &samples)
{
  std::array<Place, tensor_nodes<2, order>> nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    nodes[a] = surface.node[static_cast<std::size_t>(facet[a])].X;
  add<order>(nodes, samples);
}

} // namespace

void add_samples(const std::array<Place, 9> &nodes, std::vector<FaceSample> &samples)
{
  add<2>(nodes, samples);
}

ContactFace contact_face(const Mesh &mesh, const Surface &surface)
{
  std::vector<FaceSample> samples;
  for (const auto &facet : surface.facet)
    mesh.order == 1 ? add<1>(surface, facet, samples) : add<2>(surface, facet, samples);
  std::vector<ContactFace::Part> parts;
  for (const FaceSample &sample : samples)
    parts.push_back({std::hypot(sample.X[0], sample.X[1]), sample.area});
  return ContactFace(std::move(parts));
}

} // namespace tribogel
