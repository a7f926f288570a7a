#include "material_samples.hpp"

#include "tribogel/material/ogden.hpp"
#include "tribogel/material/viscoelastic.hpp"

#include <boost/math/tools/roots.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace tribogel;

namespace
{

using Real = long double;

const std::vector<Ogden<double>> laws = {samples::paper().equilibrium, samples::odd().equilibrium,
                                         samples::hyperelastic().equilibrium,
                                         samples::quadratic().equilibrium};

// tau_a = sum_r G_r (lb_a^alpha_r - 1/3 sum_b lb_b^alpha_r) + K/2 (J^2 - 1), as it is printed, from the
// stretches; or
// + K J (J - 1).
Real kirchhoff(const Ogden<double> &law, Real la, Real lb, Real lc)
{
  const Real J = la * lb * lc, s = std::cbrt(J);
  Real tau =
      law.bulk_modulus * (law.volumetric_law == VolumetricLaw::quadratic ? J * (J - 1) : (J * J - 1) / 2);
  for (std::size_t r = 0; r < law.moduli.size(); ++r) {
    const Real m = law.exponents[r], a = std::pow(la / s, m), b = std::pow(lb / s, m),
               c = std::pow(lc / s, m);
    tau += law.moduli[r] * (a - (a + b + c) / 3);
  }
  return tau;
}

template <class Function> Real root(Function f, Real low, Real high)
{
  std::uintmax_t iterations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      f, low, high, boost::math::tools::eps_tolerance<Real>(62), iterations);
  return (bracket.first + bracket.second) / 2;
}

// The law at F = diag(a, b, c) between two rotations, turned back; only what the rounding of F leaves may
// differ.
Matrix3<double> stress(const Ogden<double> &law, double a, double b, double c, int seed)
{
  const Matrix3<double> Q = samples::rotation(seed), R = samples::rotation(seed + 1);
  const Matrix3<double> F = Q * Vector3<double>(a, b, c).asDiagonal() * R;
  const auto response = Viscoelastic<double>{law, {}}.evaluate(F, {}, {0.3}, nullptr, false);
  EXPECT_EQ(response.status, PointStatus::ok);
  return Q.transpose() * from_mandel(response.tau) * Q;
}

const std::vector<double> stretches = {0.3, 0.45, 0.7, 0.95, 1.0001, 1.3, 1.8, 2.4, 3.0};

TEST(Ogden, uniaxial_tension_is_the_root_of_the_scalar_equation)
{
  for (const Ogden<double> &law : laws)
    for (double axial : stretches) {
      const auto lateral = [&](Real x) { return kirchhoff(law, x, x, axial); };
      const double side = static_cast<double>(root(lateral, 0.1L, 4.0L));
      const double expected = static_cast<double>(kirchhoff(law, axial, side, side));
      const double scale = std::abs(expected) + law.bulk_modulus;
      const Matrix3<double> tau = stress(law, side, side, axial, 11);
      const Matrix3<double> exact = Vector3<double>(0, 0, expected).asDiagonal();
      EXPECT_LT((tau - exact).norm(), 2e-14 * scale) << axial;
      const auto F = Vector3<double>(side, side, axial).asDiagonal().toDenseMatrix();
      const auto straight = Viscoelastic<double>{law, {}}.evaluate(F, {}, {0.3}, nullptr, false);
      EXPECT_LT((from_mandel(straight.tau) - exact).norm(), 3e-15 * scale) << axial;
    }
}

TEST(Ogden, equibiaxial_tension_is_the_root_of_the_scalar_equation)
{
  for (const Ogden<double> &law : laws)
    for (double plane : stretches) {
      const auto normal = [&](Real x) { return kirchhoff(law, x, plane, plane); };
      const double thickness = static_cast<double>(root(normal, 0.03L, 40.0L));
      const double expected = static_cast<double>(kirchhoff(law, plane, plane, thickness));
      const Matrix3<double> tau = stress(law, plane, thickness, plane, 13);
      EXPECT_LT((tau - Vector3<double>(expected, 0, expected).asDiagonal().toDenseMatrix()).norm(),
                3e-14 * (std::abs(expected) + law.bulk_modulus))
          << plane;
    }
}

TEST(Ogden, simple_shear_has_the_closed_form_stress)
{
  for (const Ogden<double> &law : laws)
    for (double gamma : {1e-9, 1e-3, 0.2, 0.9, 2.0, 2.6}) { // stretches up to 2.94
      const Real g = gamma, l = g / 2 + std::sqrt(1 + g * g / 4), sine = 2 / std::sqrt(4 + g * g),
                 cosine = g / std::sqrt(4 + g * g);
      const Real t1 = kirchhoff(law, l, 1 / l, 1), t2 = kirchhoff(law, 1 / l, 1, l),
                 t3 = kirchhoff(law, 1, l, 1 / l);
      Matrix3<double> F = Matrix3<double>::Identity(), expected;
      F(0, 1) = gamma;
      const double shear = static_cast<double>((t1 - t2) / 2 * sine);
      expected << static_cast<double>((t1 + t2) / 2 + (t1 - t2) / 2 * cosine), shear, 0, shear,
          static_cast<double>((t1 + t2) / 2 - (t1 - t2) / 2 * cosine), 0, 0, 0, static_cast<double>(t3);
      const auto response = Viscoelastic<double>{law, {}}.evaluate(F, {}, {0.3}, nullptr, false);
      EXPECT_LT((from_mandel(response.tau) - expected).norm(), 5e-15 * (expected.norm() + law.bulk_modulus))
          << gamma;
      EXPECT_NEAR(response.tau[5] / std::sqrt(2.0), shear, 2e-15 * (law.shear_modulus() + shear)) << gamma;
    }
}

TEST(Ogden, energy_has_the_printed_value_and_the_stress_is_its_derivative)
{
  using D = Dual<3>;
  for (const Ogden<double> &law : laws) {
    const Vector3<double> eps(0.31, -0.52, 0.13);
    const double theta = eps.sum(), J = std::exp(theta);
    const bool quadratic = law.volumetric_law == VolumetricLaw::quadratic;
    double printed = law.bulk_modulus * (quadratic ? (J - 1) * (J - 1) / 2 : (J * J - 2 * theta - 1) / 4);
    for (std::size_t r = 0; r < law.moduli.size(); ++r)
      for (int a = 0; a < 3; ++a)
        printed += law.moduli[r] / law.exponents[r] *
                   (std::pow(std::exp(eps[a]) / std::cbrt(J), law.exponents[r]) - 1);
    Vector3<D> x;
    for (int a = 0; a < 3; ++a) x[a] = D::seed(eps[a], a);
    const D t = x.sum();
    const Vector3<D> e = x.array() - t / 3;
    const D W = law.cast<D>().energy(e, t);
    EXPECT_NEAR(W.v, printed, 1e-14 * law.bulk_modulus);
    const auto deviatoric = law.deviatoric(e);
    const auto volumetric = law.volumetric(t);
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(W.d[a], deviatoric.tau[a].v + volumetric.mean.v, 1e-14 * law.bulk_modulus);

    // and so on: the stiffness is the derivative of the stress
    const Vector3<double> stiffness = value(deviatoric.stiffness);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double PDP =
            (a == b ? stiffness[a] : 0) - (stiffness[a] + stiffness[b]) / 3 + stiffness.sum() / 9;
        EXPECT_NEAR(deviatoric.tau[a].d[b], PDP, 1e-14 * stiffness.norm());
        EXPECT_NEAR(volumetric.mean.d[b], volumetric.bulk.v, 1e-14 * law.bulk_modulus);
      }
  }
}

TEST(Ogden, secants_are_divided_differences_and_derivatives_where_strains_coincide)
{
  for (const Ogden<double> &law : laws)
    for (double gap : {0.0, 1e-300, 1e-16, 1e-9, 1e-3, 0.1, 0.24, 0.26, 0.51, 1.7}) {
      const Vector3<double> e(0.2 + gap / 2, 0.2 - gap / 2, -0.4);
      Real expected = 0;
      for (std::size_t r = 0; r < law.moduli.size(); ++r) {
        const Real m = law.exponents[r], half = m * gap / 2;
        expected += law.moduli[r] * m * std::exp(m * 0.2L) * (half == 0 ? 1 : std::sinh(half) / half);
      }
      const auto stress = law.deviatoric(e);
      EXPECT_NEAR(stress.secant[2], static_cast<double>(expected), 2e-15 * static_cast<double>(expected))
          << gap;
      EXPECT_NEAR(stress.secant[1], (stress.tau[0] - stress.tau[2]) / (e[0] - e[2]),
                  1e-14 * stress.secant[1]);
      EXPECT_NEAR(stress.secant[0], (stress.tau[1] - stress.tau[2]) / (e[1] - e[2]),
                  1e-14 * stress.secant[0]);
      EXPECT_NEAR(stress.tau.sum(), 0, 1e-15 * stress.tau.norm());
    }
}

TEST(Ogden, small_strains_lose_no_digits)
{
  for (const Ogden<double> &law : laws)
    for (double strain : {1e-3, 1e-7, 1e-12, 1e-30}) {
      const Vector3<double> e = strain * Vector3<double>(0.7, -1.1, 0.4);
      const double theta = 1.3 * strain, G = law.shear_modulus(), K = law.bulk_modulus;
      const double energy = G * e.squaredNorm() + K / 2 * theta * theta;
      EXPECT_NEAR(law.energy(e, theta) / energy, 1, 6 * strain + 1e-14);
      EXPECT_LT((law.deviatoric(e).tau - 2 * G * e).norm(), 2 * G * e.norm() * (6 * strain + 1e-14));
      EXPECT_NEAR(law.volumetric(theta).mean / (K * theta), 1, 2 * strain + 1e-14);
    }
}

// A cylinder squeezed between lubricated plates: its wall is free. The lateral stretch of the neo-Hookean law
// with K/2 (J - 1)^2 is the root of G/3 J^(-2/3) (l^2 - a^2) + K J (J - 1), and the pressure follows; the two
// laws differ.
TEST(Ogden, compressed_cylinder_of_the_quadratic_law)
{
  Ogden<double> law{{0.5}, {2}, 5, VolumetricLaw::quadratic};
  const Real G = 0.5L, K = 5, axial = 0.7L;
  const auto lateral_stress = [&](Real l) {
    const Real J = l * l * axial;
    return G / 3 * (l * l - axial * axial) / std::cbrt(J * J) + K * J * (J - 1);
  };
  const Real l = root(lateral_stress, 0.9L, 1.3L), J = l * l * axial;
  const Real tau = 2 * G / 3 * (axial * axial - l * l) / std::cbrt(J * J) + K * J * (J - 1);
  const auto side = static_cast<double>(l), height = static_cast<double>(axial);
  EXPECT_LT((stress(law, side, side, height, 21) -
             Vector3<double>(0, 0, static_cast<double>(tau)).asDiagonal().toDenseMatrix())
                .norm(),
            1e-14 * law.bulk_modulus);
  law.volumetric_law = VolumetricLaw::logarithmic;
  EXPECT_GT(std::abs(stress(law, side, side, height, 21)(0, 0)), 1e-4 * law.bulk_modulus);
}

TEST(Ogden, paper_parameters_give_their_shear_modulus)
{
  EXPECT_DOUBLE_EQ(samples::paper().equilibrium.shear_modulus(), 0.5 * (0.75 * 1.3 + 0.45 * 2 + 0.18 * 5));
}

} // namespace
