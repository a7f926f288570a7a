#include "mesh/meridian.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

struct Spacing {
  double smallest, ratio, largest;
};

Spacing spacing_of(double radius, int elements, double grading)
{
  const double ratio = elements > 1 ? std::pow(grading, 1.0 / (elements - 1)) : 1.0;
  double sum = 0;
  for (int k = 0; k < elements; ++k) sum += std::pow(ratio, k);
  const double smallest = radius / sum;
  return {smallest, ratio, smallest * (elements > 1 ? grading : 1.0)};
}

/// Sizes that grow from `smallest` until they cover `length`, then scaled to it; the smallest comes first.
std::vector<double> growing_sizes(double length, const Spacing &s)
{
  std::vector<double> sizes;
  double sum = 0;
  // A last size that would be covered to less than half is not added: scaling up is closer than scaling down.
  for (double h = s.smallest; sizes.empty() || sum + 0.5 * h < length; h = std::min(h * s.ratio, s.largest)) {
    sizes.push_back(h);
    sum += h;
  }
  for (double &h : sizes) h *= length / sum;
  return sizes;
}

std::vector<double> points_between(double a, double b, bool fine_at_a, bool fine_at_b, const Spacing &s)
{
  return graded_points(a, b, fine_at_a, fine_at_b, s.smallest, s.ratio, s.largest);
}

} // namespace

std::vector<double> graded_points(double a, double b, bool fine_at_a, bool fine_at_b, double smallest, double ratio,
                                  double largest)
{
  const double length = b - a;
  std::vector<double> sizes;
  if (fine_at_a && fine_at_b) {
    sizes = growing_sizes(length / 2, {smallest, ratio, largest});
    sizes.insert(sizes.end(), sizes.rbegin(), sizes.rend());
  } else if (fine_at_a || fine_at_b) {
    sizes = growing_sizes(length, {smallest, ratio, largest});
    if (fine_at_b) std::reverse(sizes.begin(), sizes.end());
  } else {
    const auto count = static_cast<std::size_t>(std::ceil(length / largest - 1e-9));
    sizes.assign(std::max<std::size_t>(count, 1), length / static_cast<double>(std::max<std::size_t>(count, 1)));
  }
  std::vector<double> points{a};
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) points.push_back(points.back() + sizes[k]);
  points.push_back(b);
  return points;
}

std::vector<MeridianBlock> meridian_blocks(const Scene &scene)
{
  const MeshParameters &mesh = scene.mesh;
  const Specimen &leading = scene.has_top ? scene.top : scene.bottom;
  const Spacing s = spacing_of(leading.radius, mesh.elements_radial, mesh.grading);
  const Specimen &bottom = scene.bottom;
  std::vector<MeridianBlock> blocks;

  Spacing bottom_spacing = s;
  if (mesh.bottom_elements_radial > 0)
    bottom_spacing = spacing_of(leading.radius, mesh.bottom_elements_radial, mesh.grading);
  const double rim = std::min(leading.radius, bottom.radius);
  MeridianBlock lower{bottom_body,
                      points_between(0, rim, false, true, bottom_spacing),
                      points_between(-bottom.height, 0, true, true, bottom_spacing),
                      Side::axis,
                      Side::wall,
                      Side::bottom_plate,
                      scene.has_top ? Side::master : Side::top_plate};
  if (bottom.radius > rim) {
    const std::vector<double> overhang = points_between(rim, bottom.radius, true, true, bottom_spacing);
    lower.R.insert(lower.R.end(), overhang.begin() + 1, overhang.end());
  }
  blocks.push_back(lower);

  if (scene.has_top)
    blocks.push_back({top_body, points_between(0, scene.top.radius, false, true, s),
                      points_between(scene.initial_gap, scene.initial_gap + scene.top.height, true, true, s),
                      Side::axis, Side::wall, Side::slave, Side::top_plate});
  return blocks;
}

} // namespace tribogel
