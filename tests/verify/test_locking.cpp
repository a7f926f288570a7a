/// Locking: a bonded disc of shape factor S = a/(2 h) = 5, slightly compressed. The theory of thin discs
/// (Gent and Lindley 1959 with a finite bulk modulus: parabolic u_R across the height, the pressure uniform
/// across it, p'' + p'/R - 12 G p/(K h^2) = -12 G e/h^2) gives the apparent modulus
///
///   E_c = N/(pi a^2 e) = K (1 - 2 I_1(q)/(q I_0(q))),   q^2 = 48 S^2 G/K,
///
/// and is about 2 % low at S = 5 (it leaves out 3 G of the uniaxial state). A locking element is far above
/// it, the more so the larger K/G and the coarser the mesh.
#include "bulk_scenes.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 7, height = 0.7, G = 0.6, strain = 1e-4;

double apparent_over_shear(int order, int elements, double bulk_over_shear)
{
  Scene scene = cylinder(a, height, neo_hookean(G, bulk_over_shear), order, elements);
  scene.schedule = schedule_from_twists({2}, {strain * height}, {0});
  const SolverOptions options(fixed_steps(2, 1e-13));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows.back().measurement.normal_force / (std::numbers::pi * a * a * strain * G);
}

double thin_disc(double bulk_over_shear)
{
  const double q = std::sqrt(48 * 25 / bulk_over_shear);
  return bulk_over_shear * (1 - 2 * std::cyl_bessel_i(1, q) / (q * std::cyl_bessel_i(0, q)));
}

} // namespace

TEST(locking, ApparentModulusIsThatOfThinDiscs)
{
  for (double bulk_over_shear : {1e2, 1e3, 1e4}) {
    const double E = apparent_over_shear(2, 40, bulk_over_shear);
    std::printf("K/G %.0e: E_c/G %.3f, thin disc %.2f\n", bulk_over_shear, E, thin_disc(bulk_over_shear));
    EXPECT_GT(E / thin_disc(bulk_over_shear), 1.00);
    EXPECT_LT(E / thin_disc(bulk_over_shear), 1.05);
  }
}

/// The disc itself stiffens with K/G until it is incompressible, and with it the error; locking would go on.
TEST(locking, ErrorSaturatesAndFallsUnderRefinement)
{
  double last[3] = {};
  for (double bulk_over_shear : {1e2, 1e4, 1e5, 1e6}) {
    const double fine = apparent_over_shear(2, 40, bulk_over_shear);
    constexpr int runs[3][2] = {{1, 20}, {1, 40}, {2, 20}};
    double error[3];
    for (int k = 0; k < 3; ++k)
      error[k] = apparent_over_shear(runs[k][0], runs[k][1], bulk_over_shear) / fine - 1;
    std::printf("K/G %.0e: errors at order 1 %.3e %.3e, order 2 %.3e\n", bulk_over_shear, error[0], error[1],
                error[2]);
    EXPECT_GT(error[0] / error[1], 3.5);
    EXPECT_LT(std::abs(error[2]), 0.003);
    if (bulk_over_shear > 1e4) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(error[k] / last[k], 1, 0.04);
    }
    std::copy(error, error + 3, last);
  }
}

/// The table of tests/measurements/exact-solutions.md.
TEST(locking, DISABLED_Table)
{
  for (double bulk_over_shear : {1e2, 1e3, 1e4, 1e5}) {
    const double fine = apparent_over_shear(2, 160, bulk_over_shear);
    std::printf("K/G %.0e: thin disc %.2f, finest %.3f, errors", bulk_over_shear, thin_disc(bulk_over_shear),
                fine);
    for (int order : {1, 2})
      for (int elements : {20, 40, 80})
        std::printf(" %.2e", apparent_over_shear(order, elements, bulk_over_shear) / fine - 1);
    std::printf("\n");
  }
}

} // namespace tribogel::test
