/// Torsion of an incompressible neo-Hookean cylinder: universal solution r = R/sqrt(lambda), phi = psi Z,
/// z = lambda Z (Rivlin 1949; psi is the twist per reference length):
///
///   T = (pi/2) G psi a^4/lambda,   N = (pi/4) G psi^2 a^4/lambda^2 - pi a^2 G (lambda - lambda^-2)
///   (compression > 0).
///
/// At lambda = 1 no point moves radially: exact with bonded ends. With lambda != 1 the plates must let the
/// gel slide. A finite bulk modulus errs O(G/K). The mesh does not err at all: u_R = 0 (or linear), phi and
/// u_Z linear lie in the element space, T and N are the work of the exact deviatoric stress (polynomials that
/// the Gauss rules do exactly) and of a pressure that is in equilibrium with it. So on any mesh the error is
/// c G/K, and falls tenfold when K rises tenfold.
#include "bulk_scenes.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 4.5, height = 3, G = 0.7, psi = 0.13, pi = std::numbers::pi;

struct Reaction {
  double T, N;
};

Reaction exact(double lambda)
{
  return {pi / 2 * G * psi * std::pow(a, 4) / lambda,
          pi / 4 * G * psi * psi * std::pow(a, 4) / (lambda * lambda) -
              pi * a * a * G * (lambda - 1 / (lambda * lambda))};
}

/// Relative errors of T and N after stretching by lambda (if not 1) and turning by psi times the height.
Reaction errors(int order, int elements, double bulk_over_shear, double lambda)
{
  Scene scene = cylinder(a, height, neo_hookean(G, bulk_over_shear), order, elements);
  scene.schedule = schedule_from_twists({2}, {0}, {psi * height});
  if (lambda != 1) {
    scene.plate_bond = PlateBond::lubricated;
    const double approach = (1 - lambda) * height;
    scene.schedule = schedule_from_twists({2, 4}, {approach, approach}, {0, psi * height});
  }
  const SolverOptions options(fixed_steps(0.25, 1e-13));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  const Measurement &m = recorder.rows.back().measurement;
  const Reaction reference = exact(lambda),
                 error{m.torque / reference.T - 1, m.normal_force / reference.N - 1};
  std::printf("order %d elements %2d K/G %.0e lambda %.2f: errors of T %.3e, N %.3e\n", order, elements,
              bulk_over_shear, lambda, error.T, error.N);
  return error;
}

void expect_error_of_shear_over_bulk_modulus(int order, int elements, double lambda)
{
  const Reaction e3 = errors(order, elements, 1e3, lambda), e4 = errors(order, elements, 1e4, lambda);
  EXPECT_LT(std::abs(e4.T), 2e-5); // both a few G/K
  EXPECT_LT(std::abs(e4.N), 5e-4);
  EXPECT_NEAR(e3.T / e4.T, 10, 0.1);
  EXPECT_NEAR(e3.N / e4.N, 10, 0.1);
}

} // namespace

TEST(torsion, OfABondedCylinder)
{
  for (int order : {1, 2})
    for (int elements : {3, 6}) expect_error_of_shear_over_bulk_modulus(order, elements, 1);
}

TEST(torsion, OfAStretchedCylinderBetweenLubricatedPlates)
{
  for (int order : {1, 2})
    for (double lambda : {0.9, 1.12}) expect_error_of_shear_over_bulk_modulus(order, 3, lambda);
}

} // namespace tribogel::test
