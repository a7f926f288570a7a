/// The contact pressure over the patch on matching and non-matching meshes: smooth, and right against a fine run. Two
/// bonded gels of the paper's shape are pressed; the nodal pressures are compared with those of a fine matching mesh of
/// order 2, interpolated at the same reference radius, within 0.85 of the top's radius (the rim is singular).
///
///     error = (p - p_fine) / p_fine(inmost)           of each node with a multiplier
///     zigzag = the largest amplitude with which the error, taken off the line through a node's neighbours, changes
///     sign
///              at three nodes in a row
///
/// A zigzag is what an unstable multiplier, or a quadrature that misses the kinks of the other mesh, leaves behind; a
/// smooth error has none, however large.
#include "scenes.hpp"
#include "solver_options.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

struct NodalPressure {
  double R, p; ///< reference radius [mm], Cauchy pressure [MPa]
};

constexpr double part = 0.85; // of the top's radius

/// Nodes of the pressed top's lower face, from the axis outwards.
std::vector<NodalPressure> pressed(int order, int top, int bottom)
{
  const double end = 27;
  const SolverOptions options(fixed_steps(end / 6, 1e-9));
  Scene scene = paper_scene(top, order);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.mesh.bottom_elements_radial = bottom;
  scene.schedule = schedule_from_rates({end}, {0.79}, {0});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  std::vector<NodalPressure> nodes;
  for (const ProfileRow &row : recorder.last_profile)
    if (row.surface == std::string("top") && row.reference_z == 0 && !std::isnan(row.pressure))
      nodes.push_back({row.reference_r, row.pressure});
  std::sort(nodes.begin(), nodes.end(), [](const auto &a, const auto &b) { return a.R < b.R; });
  return nodes;
}

/// On the line through neighbouring nodes.
double between(const NodalPressure &a, const NodalPressure &b, double R)
{
  return a.p + (R - a.R) / (b.R - a.R) * (b.p - a.p);
}

double at(const std::vector<NodalPressure> &fine, double R)
{
  std::size_t k = 1;
  while (k + 1 < fine.size() && fine[k].R < R) ++k;
  return between(fine[k - 1], fine[k], R);
}

struct Deviation {
  double root_mean_square = 0, largest = 0, at_inmost = 0, zigzag = 0;
};

Deviation deviation(const std::vector<NodalPressure> &nodes, const std::vector<NodalPressure> &fine)
{
  std::vector<NodalPressure> error;
  for (const NodalPressure &node : nodes)
    if (node.R <= part * 10) error.push_back({node.R, (node.p - at(fine, node.R)) / fine.front().p});
  Deviation d;
  double weights = 0;
  for (const NodalPressure &e : error) {
    d.root_mean_square += e.R * e.p * e.p; // by area
    weights += e.R;
    d.largest = std::max(d.largest, std::abs(e.p));
  }
  d.root_mean_square = std::sqrt(d.root_mean_square / weights);
  d.at_inmost = error.front().p;
  std::vector<double> bend;
  for (std::size_t k = 1; k + 1 < error.size(); ++k)
    bend.push_back(error[k].p - between(error[k - 1], error[k + 1], error[k].R));
  for (std::size_t k = 1; k + 1 < bend.size(); ++k)
    if (bend[k] * bend[k - 1] < 0 && bend[k] * bend[k + 1] < 0)
      d.zigzag = std::max(d.zigzag, std::min({std::abs(bend[k - 1]), std::abs(bend[k]), std::abs(bend[k + 1])}));
  return d;
}

Deviation report(int order, int top, int bottom, const std::vector<NodalPressure> &fine)
{
  const std::vector<NodalPressure> nodes = pressed(order, top, bottom);
  const Deviation d = deviation(nodes, fine);
  std::printf("| %d | %d | %d | %.1e | %.1e | %.1e | %.1e |\n", order, top, bottom, d.root_mean_square, d.largest,
              d.at_inmost, d.zigzag);
  for (const auto &x : nodes)
    std::printf("NODE %d %d %d %.9g %.9g %.9g\n", order, top, bottom, x.R, x.p, at(fine, x.R));
  return d;
}

} // namespace

TEST(pressure_profile, DISABLED_Table)
{
  const std::vector<NodalPressure> fine = pressed(2, 32, 32);
  std::printf("| order | top | bottom | rms | largest | inmost | zigzag |\n|---|---|---|---|---|---|---|\n");
  for (int order : {1, 2})
    for (int n : {4, 8, 16})
      for (int bottom : {n, (4 * n) / 3}) report(order, n, bottom, fine);
  for (int order : {1, 2})
    for (int n : {2, 4}) {
      report(order, n, 10 * n, fine);
      report(order, 10 * n, n, fine);
    }
}

} // namespace tribogel::test
