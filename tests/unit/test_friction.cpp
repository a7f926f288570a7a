/// Friction laws and the rheometer's closed forms.
#include "tribogel/friction/law.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/rheometer.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace tribogel
{
namespace
{

static_assert(FrictionLaw<PolynomialFriction<double>, double>);
static_assert(FrictionLaw<PolynomialFriction<double>, Dual<2>>);
static_assert(FrictionLaw<PolynomialFriction<Dual<2>>, Dual<2>>);

const PolynomialFriction<double> mixed{{0.31, 0.047, -0.0021, 0.013}, {0, 1, 2.5, 1.3}};

double mu(double v)
{
  return 0.31 + 0.047 * v - 0.0021 * std::pow(v, 2.5) + 0.013 * std::pow(v, 1.3);
}

TEST(PolynomialFriction, StaticAndSlidingPartAddUpToTheLaw)
{
  for (double v : {1e-9, 0.02, 0.7, 3.1})
    for (double p : {0.004, 0.6, 17.0}) {
      const double tau = mixed.static_strength(p).value + mixed.sliding(v, p).over_v * v;
      EXPECT_NEAR(tau, mu(v) * p, 4e-16 * p);
      EXPECT_NEAR(mixed.coefficient(v, p), mu(v), 4e-16);
    }
}

TEST(PolynomialFriction, DerivativesAgreeWithDualNumbersAndDifferences)
{
  const double v = 0.83, p = 1.9, h = 1e-5;
  const auto sliding = mixed.sliding(v, p);
  const auto dual_v = Dual<2>::seed(v, 0), dual_p = Dual<2>::seed(p, 1);
  const Dual<2> tau_1 = mixed.sliding(dual_v, dual_p).over_v * dual_v;
  EXPECT_NEAR(sliding.d_v, tau_1.d[0], 1e-15);
  EXPECT_NEAR(sliding.d_p, tau_1.d[1], 1e-15);
  EXPECT_NEAR(sliding.d_v, p * (mu(v + h) - mu(v - h)) / (2 * h), 1e-10);
  EXPECT_NEAR(mixed.static_strength(dual_p).value.d[1], mixed.static_strength(p).d_p, 1e-16);
}

TEST(PolynomialFriction, IsFiniteAtRest)
{
  const double p = 1.9;
  const auto rest = mixed.sliding(0.0, p);
  EXPECT_DOUBLE_EQ(rest.over_v, 0.047 * p);
  EXPECT_DOUBLE_EQ(rest.d_v, 0.047 * p);
  EXPECT_EQ(rest.d_p, 0);
  EXPECT_DOUBLE_EQ(mixed.coefficient(0.0, p), 0.31);
  const auto dual = mixed.sliding(Dual<2>::seed(0, 0), Dual<2>::seed(p, 1));
  EXPECT_TRUE(isfinite(dual.over_v)) << dual.over_v; // 0.3 v^(-0.7) must not come through
}

TEST(PolynomialFriction, WithoutTermsIsFrictionless)
{
  const PolynomialFriction<double> none{};
  EXPECT_EQ(none.static_strength(2.7).value, 0);
  EXPECT_EQ(none.sliding(1.3, 2.7).over_v, 0);
  EXPECT_EQ(none.coefficient(1.3, 2.7), 0);
}

TEST(PolynomialFriction, GivesDerivativesWithRespectToItsCoefficients)
{
  auto law = mixed.cast<Dual<2>>();
  law.coefficients[0].d[0] = 1;
  law.coefficients[2].d[1] = 1;
  const double v = 0.83, p = 1.9;
  const Dual<2> tau = law.static_strength(p).value + law.sliding(v, p).over_v * v;
  EXPECT_NEAR(tau.d[0], p, 1e-15);
  EXPECT_NEAR(tau.d[1], p * std::pow(v, 2.5), 1e-15);
}

/// Torque under uniform pressure p = N / (pi R^2) and v = omega r, over N R.
double uniform_pressure_torque(const PolynomialFriction<double> &law, double rim_speed)
{
  double torque = 0;
  for (std::size_t i = 0; i < law.exponents.size(); ++i)
    torque += law.coefficients[i] * std::pow(rim_speed, law.exponents[i]) * 2 / (law.exponents[i] + 3);
  return torque;
}

TEST(Rheometer, GongIsLowOnAConstantAndHighOnAQuadraticLaw)
{
  const double R = 9.3, N = 4.7, rim_speed = 1.7;
  const auto gong_over_mean = [&](double exponent) {
    const PolynomialFriction<double> law{{0.23}, {exponent}};
    const double area_mean = 0.23 * std::pow(rim_speed, exponent) * 2 / (exponent + 2);
    return gong_coefficient(uniform_pressure_torque(law, rim_speed) * N * R, N, R) / area_mean;
  };
  EXPECT_NEAR(gong_over_mean(0), 8.0 / 9, 1e-15);   // 11.1 % low
  EXPECT_NEAR(gong_over_mean(1), 1, 1e-15);         // what (2.1) assumes
  EXPECT_NEAR(gong_over_mean(2), 16.0 / 15, 1e-15); // 6.7 % high
}

TEST(Rheometer, ApparentCoefficientIsTheAreaMeanUnderUniformPressure)
{
  const double R = 9.3, N = 4.7, omega = 0.21;
  const PolynomialFriction<double> law{{0.31, 0.047, 0.0021}, {0, 1, 2.5}};
  double area_mean = 0;
  for (int i = 0; i < 3; ++i)
    area_mean += law.coefficients[i] * std::pow(omega * R, law.exponents[i]) * 2 / (law.exponents[i] + 2);
  const double torque = uniform_pressure_torque(law, omega * R) * N * R;
  EXPECT_NEAR(apparent_coefficient(law, torque, N, R, omega), area_mean, 1e-15);
  EXPECT_NEAR(apparent_coefficient(law, -torque, N, R, -omega), area_mean, 1e-15); // the other sense of rotation
}

TEST(Rheometer, ApparentCoefficientIsEquation311WithItsFactorRestored)
{
  const double b0 = 0.31, b1 = 0.047, b2 = 0.0021, R = 9.3, N = 4.7, w = 0.21, T = 3.3;
  const double corrected = (b0 / 2 + b1 * R * w / 3 + b2 * R * R * w * w / 4) /
                           (b0 * R / 3 + b1 * R * R * w / 4 + b2 * R * R * R * w * w / 5) * T / N;
  EXPECT_NEAR(apparent_coefficient({{b0, b1, b2}, {0, 1, 2}}, T, N, R, w), corrected, 1e-15);
}

TEST(Rheometer, PaperTable2TorquesGiveBackTheirMeanCoefficients)
{
  // T / (N R) of the three laws of Table 2 at 0.01, 0.1 and 1 rad/s, R = 10 mm, four digits
  const PolynomialFriction<double> cases[] = {{{2e-4}, {1}}, {{2.6e-4, 1e-5}, {0, 2}}, {{2.2e-4, 3.26e-5}, {0, 1}}};
  const double torque[3][3] = {
      {1.00e-5, 1.00e-4, 1.00e-3}, {1.734e-4, 1.773e-4, 5.733e-4}, {1.483e-4, 1.630e-4, 3.097e-4}};
  for (int law = 0; law < 3; ++law)
    for (int phase = 0; phase < 3; ++phase) {
      const double rate = std::pow(10.0, phase - 2), N = 2.3;
      double area_mean = 0;
      for (std::size_t i = 0; i < cases[law].exponents.size(); ++i) {
        const double m = cases[law].exponents[i];
        area_mean += cases[law].coefficients[i] * std::pow(10 * rate, m) * 2 / (m + 2);
      }
      EXPECT_NEAR(apparent_coefficient(cases[law], torque[law][phase] * N * 10, N, 10, rate) / area_mean, 1, 4e-4);
    }
}

TEST(Rheometer, UndefinedValuesAreNaN)
{
  const PolynomialFriction<double> viscous{{0.2}, {1}}, coulomb{{0.2}, {0}};
  EXPECT_TRUE(std::isnan(gong_coefficient(1.3, 0, 9.3)));
  EXPECT_TRUE(std::isnan(apparent_coefficient(viscous, 1.3, 0, 9.3, 0.7)));
  EXPECT_TRUE(std::isnan(apparent_coefficient(viscous, 0, 2.1, 9.3, 0))); // at rest a viscous law says nothing
  EXPECT_TRUE(std::isnan(apparent_coefficient({}, 1.3, 2.1, 9.3, 0.7)));
  EXPECT_NEAR(apparent_coefficient(coulomb, 1.3, 2.1, 9.3, 0), 1.5 * 1.3 / (2.1 * 9.3), 1e-16);
}

} // namespace
} // namespace tribogel
