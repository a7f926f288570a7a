/// A flat punch of radius a on a half-space.
///
/// Indentation without friction by a rigid punch: F = 2 E* a delta. A finite block of width L yields
/// less, delta = F/(2 E* a) + c F/(E* L) (1 + O(a^2/L^2)), c < 0 the same for similar blocks, so that two
/// widths give the half-space: delta/F = 2 (delta/F)_2L - (delta/F)_L.
///
/// Torsion of a bonded punch: T = 16/3 G a^3 theta; a finite block errs (a/L)^3 only. Coulomb friction of
/// a coefficient that nothing overcomes is the bond.
///
/// The tractions are infinite at the edge, as the root of 1/distance. Meshes whose n-th line from the edge
/// lies at a distance proportional to n^grade restore order 2 of the energy for elements of order 1 (grade >
/// 2); with grade 3 the others have order 3. Finer edges than the indentation would fold.
#include "outlines.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 1.3, pi = std::numbers::pi;

/// The punch is this much stiffer than the block and counts as rigid: its own compliance is corrected in
/// torsion.
constexpr double stiffness_ratio = 1e4;

/// 0 to `length` in n steps, finer towards 0.
std::vector<double> towards_zero(double length, int n, double grade)
{
  std::vector<double> points;
  for (int k = 0; k <= n; ++k) points.push_back(length * std::pow(static_cast<double>(k) / n, grade));
  return points;
}

/// From the edge at a both ways: inwards to 0 and outwards to 2 a by the grade, then to L by the ratio.
std::vector<double> around_edge(int n, double grade, double L)
{
  std::vector<double> points = downwards(towards_zero(a, n, grade)); // -a to 0
  for (double &r : points) r += a;
  points.front() = 0;
  if (L <= a) return points;
  const std::vector<double> near = towards_zero(a, n, grade);
  for (std::size_t k = 1; k < near.size(); ++k) points.push_back(a + near[k]);
  const double last = a - near[near.size() - 2], ratio = std::pow(2, 2.0 / n);
  const auto far = growing_points(2 * a, L, last * ratio, ratio);
  points.insert(points.end(), far.begin() + 1, far.end());
  return points;
}

std::vector<double> below_edge(int n, double grade, double L)
{
  std::vector<double> points = towards_zero(a, n, grade);
  const double last = a - points[points.size() - 2], ratio = std::pow(2, 2.0 / n);
  const auto far = growing_points(a, L, last * ratio, ratio);
  points.insert(points.end(), far.begin() + 1, far.end());
  return points;
}

struct Punch {
  int order, elements; ///< along a, on the block; 5/4 of it on the punch
  double width = 10;   ///< L/a
  PolynomialFriction<double> friction{};
  double bulk_over_shear = 5; ///< of the block
};

PhaseEnd last_phase(const Punch &is, double twist, Problem &problem, Recorder &recorder)
{
  const double L = is.width * a, G = 0.4, grade = 3, depth = 1e-5 * a;
  Scene scene;
  scene.plate_contact = false;
  scene.top = {a, a, neo_hookean(stiffness_ratio * G, 5)};
  scene.bottom = {L, L, neo_hookean(G, is.bulk_over_shear)};
  scene.mesh.element_order = is.order;
  scene.friction = is.friction;
  scene.schedule = schedule_from_twists({1, 2}, {depth, depth}, {0, twist});
  const std::vector<MeridianBlock> blocks{
      lower_body(around_edge(is.elements, grade, L), below_edge(is.elements, grade, L)),
      upper_body(around_edge(is.elements * 5 / 4, grade, a), towards_zero(a, is.elements, grade))};
  const SolverOptions options(fixed_steps(1, 1e-10));
  run(scene, blocks, problem, recorder);
  return recorder.phases.empty() ? PhaseEnd{} : recorder.phases.back();
}

/// delta/F times 2 E* a.
double compliance(const Punch &is)
{
  Problem problem;
  Recorder recorder("");
  const PhaseEnd end = last_phase(is, 0, problem, recorder);
  const double E = Elastic(problem.system.scene.bottom.material.equilibrium).plane();
  const double own =
      1 / (pi * a * stiffness_ratio * Elastic(problem.system.scene.bottom.material.equilibrium).young());
  return (end.approach / end.measurement.normal_force - own) * 2 * E * a;
}

double indentation_error(int order, int elements, double width)
{
  const double narrow = compliance({order, elements, width}), wide = compliance({order, elements, 2 * width});
  const double error = 1 / (2 * wide - narrow) - 1;
  std::printf("order %d elements %2d L/a %2.0f: 2 E* a delta/F %.5f %.5f, error of F %.2e\n", order, elements,
              width, narrow, wide, error);
  std::fflush(stdout);
  return error;
}

double torsion_error(int order, int elements)
{
  Punch is{order, elements, 20, {{20}, {0}}, 1e3};
  Problem problem;
  Recorder recorder("");
  const double theta = 1e-5, T = last_phase(is, theta, problem, recorder).measurement.torque;
  const double G = problem.system.scene.bottom.material.equilibrium.shear_modulus();
  const double own =
      2 / (pi * stiffness_ratio * G * std::pow(a, 3)); // compliance of a cylinder as high as wide
  const double error = T / (theta - T * own) / (16.0 / 3 * G * std::pow(a, 3)) - 1;
  std::printf("order %d elements %2d: error of T %.2e\n", order, elements, error);
  std::fflush(stdout);
  return error;
}

} // namespace

TEST(punch, Indentation)
{
  const double coarse = indentation_error(1, 4, 20), fine = indentation_error(1, 8, 20);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
  EXPECT_LT(fine, 0.012);
  EXPECT_LT(std::abs(indentation_error(2, 8, 20)), 3e-4);
}

TEST(punch, Torsion)
{
  const double coarse = torsion_error(1, 4), fine = torsion_error(1, 8);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
  EXPECT_LT(fine, 0.02);
  const double coarse2 = torsion_error(2, 4), fine2 = torsion_error(2, 8);
  EXPECT_GT(std::log2(coarse2 / fine2), 2.8);
  EXPECT_LT(std::abs(fine2), 1e-3);
}

/// The tables of tests/measurements/exact-solutions.md.
TEST(punch, DISABLED_Table)
{
  for (int order : {1, 2})
    for (int elements : {4, 8, 16}) indentation_error(order, elements, 20);
  for (int order : {1, 2})
    for (int elements : {4, 8, 16}) torsion_error(order, elements);
}

} // namespace tribogel::test
