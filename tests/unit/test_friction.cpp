/// Friction laws and the rheometer's closed forms.
#include "tribogel/element/quadrature.hpp"
#include "tribogel/friction/friction.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/torque.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <numbers>

namespace tribogel
{
namespace
{

static_assert(FrictionFor<PolynomialFriction<double>, double>);
static_assert(FrictionFor<PolynomialFriction<double>, Dual<2>>);
static_assert(FrictionFor<PolynomialFriction<Dual<2>>, Dual<2>>);
static_assert(FrictionFor<PolynomialFriction<double>, Dual<11>>);
static_assert(FrictionFor<Friction, double> && FrictionFor<Friction, Dual<11>>);

const PolynomialFriction<double> mixed{{0.31, 0.047, -0.0021, 0.013}, {0, 1, 2.5, 1.3}};

double mu(double v)
{
  return 0.31 + 0.047 * v - 0.0021 * std::pow(v, 2.5) + 0.013 * std::pow(v, 1.3);
}

TEST(PolynomialFriction, StaticAndSlidingPartAddUpToTheLaw)
{
  for (double v : {1e-9, 0.02, 0.7, 3.1})
    for (double p : {0.004, 0.6, 17.0}) {
      const double tau = mixed.threshold(p) + mixed.drag(v, p) * v;
      EXPECT_NEAR(tau, mu(v) * p, 4e-16 * p);
      EXPECT_NEAR(mixed.coefficient(v, p), mu(v), 4e-16);
    }
}

TEST(PolynomialFriction, DerivativesAgreeWithDifferences)
{
  const double v = 0.83, p = 1.9, h = 1e-5;
  const Friction law = mixed;
  EXPECT_NEAR(law.slope(v, p), p * (mu(v + h) - mu(v - h)) / (2 * h), 1e-10);
  const Dual<2> tau_1 = law.drag(Dual<2>::seed(v, 0), Dual<2>::seed(p, 1)) * Dual<2>::seed(v, 0);
  EXPECT_NEAR(tau_1.d[0], p * (mu(v + h) - mu(v - h)) / (2 * h), 1e-10);
  EXPECT_NEAR(tau_1.d[1], mu(v) - mu(0), 1e-15);
  EXPECT_NEAR(law.threshold(Dual<2>::seed(p, 1)).d[1], 0.31, 1e-15);
}

TEST(PolynomialFriction, IsFiniteAtRest)
{
  const double p = 1.9;
  EXPECT_DOUBLE_EQ(mixed.drag(0.0, p), 0.047 * p);
  EXPECT_DOUBLE_EQ(Friction(mixed).slope(0, p), 0.047 * p);
  EXPECT_DOUBLE_EQ(mixed.coefficient(0.0, p), 0.31);
  const auto dual = mixed.drag(Dual<2>::seed(0, 0), Dual<2>::seed(p, 1));
  EXPECT_TRUE(isfinite(dual)) << dual; // 0.3 v^(-0.7) must not come through
}

TEST(PolynomialFriction, WithoutTermsIsFrictionless)
{
  const PolynomialFriction<double> none{};
  EXPECT_EQ(none.threshold(2.7), 0);
  EXPECT_EQ(none.drag(1.3, 2.7), 0);
  EXPECT_EQ(none.coefficient(1.3, 2.7), 0);
}

TEST(PolynomialFriction, GivesDerivativesWithRespectToItsCoefficients)
{
  auto law = mixed.cast<Dual<2>>();
  law.coefficients[0].d[0] = 1;
  law.coefficients[2].d[1] = 1;
  const double v = 0.83, p = 1.9;
  const Dual<2> tau = law.threshold(p) + law.drag(v, p) * v;
  EXPECT_NEAR(tau.d[0], p, 1e-15);
  EXPECT_NEAR(tau.d[1], p * std::pow(v, 2.5), 1e-15);
}

constexpr double eps = std::numeric_limits<double>::epsilon();
const double pressure_exponents[] = {0, 0.3, 0.7, 1};

/// All kinds of terms, sized to matter together around v = 1.
PolynomialFriction<double> every_kind(double pressure_exponent)
{
  return {{0.31, 0.47, 0.23, 0.047, 0.013, -1e-9}, {0, 0.25, 0.5, 1, 2, 3}, pressure_exponent, 2e-4};
}

double mu_of_every_kind(double v)
{
  return 0.31 + 0.47 * std::sqrt(std::sqrt(v)) + 0.23 * std::sqrt(v) + 0.047 * v + 0.013 * v * v -
         1e-9 * v * v * v;
}

template <class Check> void over_decades(const Check &check)
{
  for (int decade_v = -12; decade_v <= 3; ++decade_v)
    for (int decade_p = -12; decade_p <= 1; ++decade_p)
      check(3.7 * std::pow(10, decade_v - 1), 2.3 * std::pow(10, decade_p - 1));
}

TEST(PolynomialFriction, ThreePartsAddUpToTheLawOverDecades)
{
  for (const double a : pressure_exponents) {
    const auto law = every_kind(a);
    over_decades([&](double v, double p) {
      const double tau = law.threshold(p) + law.steep(v, p) + law.drag(v, p) * v;
      EXPECT_NEAR(tau / (mu_of_every_kind(v) * law.load(p)), 1, 8 * eps);
      EXPECT_NEAR(law.coefficient(v, p) * p / tau, 1, 8 * eps);
      if (p >= law.pressure_floor) {
        EXPECT_NEAR(law.load(p) / std::pow(p, a), 1, 2 * eps);
      }
    });
  }
}

TEST(PolynomialFriction, WithoutAnExponentBelowOneNothingIsSteep)
{
  EXPECT_FALSE(mixed.has_steep_part());
  EXPECT_EQ(mixed.steep(0.7, 1.3), 0);
  EXPECT_FALSE(
      (PolynomialFriction<double>{{0.1, 0, 0.2}, {0, 0.5, 1}}).has_steep_part()); // its coefficient is 0
  EXPECT_TRUE(every_kind(1).has_steep_part());
  EXPECT_LT(every_kind(1).drag(0.7, 1.3), 0); // what weakens stays in the smooth part
}

TEST(PolynomialFriction, SteepSpeedIsTheInverseOverDecades)
{
  const PolynomialFriction<double> laws[] = {{{0.37}, {0.1}},
                                             {{0.37}, {0.25}},
                                             {{0.37}, {0.5}},
                                             {{0.37}, {0.9}},
                                             {{0.29, 0.37, 0.11, 5.3, 0.023}, {0, 0.3, 0.7, 1, 2}}};
  for (auto law : laws)
    for (const double a : pressure_exponents)
      for (const double drag : {1e-9, 0.013, 4.1e6}) {
        law.pressure_exponent = a;
        over_decades([&](double v, double p) {
          const double stress = law.steep(v, p) + drag * v;
          // v ~ stress^(1/m) at the steepest: the round-off of the stress comes back ten times
          EXPECT_NEAR(law.steep_speed(stress, drag, p) / v, 1, 64 * eps) << v << ' ' << p;
        });
      }
}

TEST(PolynomialFriction, SquareRootLawHasAClosedInverse)
{
  const double b = 0.37, drag = 0.019;
  const PolynomialFriction<double> law{{b}, {0.5}};
  // v is exp(log v), log v up to 60
  over_decades([&](double stress, double p) {
    const double root = 2 * stress / (b * p + std::sqrt(b * p * b * p + 4 * drag * stress)); // of v
    using D = Dual<3>;
    const D v = law.steep_speed(D::seed(stress, 0), D::seed(drag, 1), D::seed(p, 2));
    const double slope = drag + b * p / (2 * root);
    EXPECT_NEAR(v.v / (root * root), 1, 64 * eps);
    EXPECT_NEAR(v.d[0] * slope, 1, 64 * eps);
    EXPECT_NEAR(v.d[1] * slope / (-root * root), 1, 64 * eps);
    EXPECT_NEAR(v.d[2] * slope / (-b * root), 1, 64 * eps);
  });
}

TEST(PolynomialFriction, SteepSpeedDerivativesAgreeWithDifferences)
{
  using D = Dual<3>;
  for (const double a : pressure_exponents) {
    const auto law = every_kind(a);
    over_decades([&](double stress, double p) {
      const double at[3] = {stress, 0.13, p};
      const D v = law.steep_speed(D::seed(at[0], 0), D::seed(at[1], 1), D::seed(at[2], 2));
      for (int i = 0; i < 3; ++i) {
        const auto moved = [&](double by) {
          double x[3] = {at[0], at[1], at[2]};
          x[i] *= 1 + by;
          return law.steep_speed(x[0], x[1], x[2]);
        };
        const double h = 1e-3,
                     slope = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
        EXPECT_NEAR(v.d[i] * at[i] / v.v, slope / v.v, 1e-9) << stress << ' ' << p << ' ' << i;
      }
    });
  }
}

TEST(PolynomialFriction, SteepSpeedGivesDerivativesWithRespectToTheCoefficients)
{
  auto law = every_kind(1).cast<Dual<1>>();
  law.coefficients[2].d[0] = 1;
  const double p = 1.9, drag = 0.13, stress = 0.7;
  const Dual<1> v = law.steep_speed(stress, drag, p);
  const double slope =
      drag + p * (0.47 * 0.25 * std::pow(v.v, -0.75) + 0.23 * 0.5 / std::sqrt(v.v) + 0.047 + 0.026 * v.v);
  EXPECT_NEAR(v.d[0] * slope / (-p * std::sqrt(v.v)), 1, 16 * eps);
}

/// At rest the inverse is flat: no stress, no speed, no slope, also where it underflows or nothing presses.
TEST(PolynomialFriction, SteepSpeedIsFiniteInTheLimits)
{
  using D = Dual<3>;
  const PolynomialFriction<double> law{{0.37}, {0.1}};
  for (const double stress : {1e-300, 1e-40, 1e-3, 1e3})
    for (const double p : {0.0, 1e-300, 1e-12, 10.0})
      for (const double drag : {1e-12, 1e9}) {
        const D v = law.steep_speed(D::seed(stress, 0), D::seed(drag, 1), D::seed(p, 2));
        EXPECT_TRUE(isfinite(v)) << stress << ' ' << p << ' ' << drag << ": " << v;
        EXPECT_GE(v.v, 0);
        EXPECT_LE(v.v, stress / drag * (1 + 64 * eps)); // 700 in log v carries 700 eps
        EXPECT_GE(v.d[0], 0);
        EXPECT_LE(v.d[0], 1 / drag * (1 + eps));
      }
  const D at_rest = law.steep_speed(D::seed(1e-40, 0), D(1), D(1));
  EXPECT_EQ(at_rest.v, 0); // 1e-396
  EXPECT_EQ(at_rest.d[0], 0);
}

TEST(PolynomialFriction, LoadIsContinuousWithItsSlopeAndRises)
{
  for (const double a : {0.0, 0.3, 0.7}) {
    const PolynomialFriction<double> law{{1}, {0}, a, 2e-4};
    const double p_0 = law.pressure_floor;
    const double below = std::nextafter(p_0, 0.0);
    EXPECT_EQ(law.load(0.0), 0);
    EXPECT_NEAR(law.load(below) / law.load(p_0), 1, 8 * eps);
    EXPECT_NEAR(law.load_slope(below) * p_0 / law.load(p_0), a, 8 * eps);
    EXPECT_NEAR(law.load_slope(p_0) * p_0 / law.load(p_0), a, 8 * eps);
    for (double p = 1e-12; p < 10; p *= 1.7) {
      const auto dual = law.load(Dual<1>::seed(p, 0));
      EXPECT_NEAR(law.load_slope(p) * p / dual.v, dual.d[0] * p / dual.v, 8 * eps);
      EXPECT_GE(law.load(1.7 * p), law.load(p));
    }
    EXPECT_NEAR(law.coefficient(0.0, 0.0) / law.coefficient(0.0, 1e-20), 1, 8 * eps); // its limit at p = 0
  }
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
  EXPECT_NEAR(apparent_coefficient(law, -torque, N, R, -omega), area_mean,
              1e-15); // the other sense of rotation
}

/// Midpoint sums over rings; what they leave out falls as the square of a ring's width.
template <class Traction> std::array<double, 2> force_and_torque(double radius, const Traction &traction)
{
  constexpr int rings = 20000;
  double force = 0, torque = 0;
  for (int k = 0; k < rings; ++k) {
    const double r = radius * (k + 0.5) / rings, area = 2 * std::numbers::pi * r * radius / rings;
    force += traction(r) * area;
    torque += traction(r) * area * r;
  }
  return {force, torque};
}

TEST(Rheometer, ViscousForceAndTorqueAreTheIntegralsOfEquations21And22)
{
  const double c = 0.037, omega = 0.21, R = 9.3;
  const auto [force, torque] = force_and_torque(R, [&](double r) { return c * omega * r; });
  EXPECT_NEAR(viscous_friction_force(c, omega, R) / force, 1, 1e-8);
  EXPECT_NEAR(viscous_torque(c, omega, R) / torque, 1, 1e-8);
  EXPECT_EQ(viscous_torque(c, -omega, R), viscous_torque(c, omega, R));
  EXPECT_NEAR(gong_friction_force(viscous_torque(c, omega, R), R) / viscous_friction_force(c, omega, R), 1,
              1e-15);
  EXPECT_NEAR(gong_coefficient(torque, 4.7, R) / (force / 4.7), 1, 1e-8);
}

/// The area mean of mu and that of r mu, by which the apparent coefficient of a law is taken, over a disc:
/// sums of 2 b omega^m R^m / (m + 2) and 2 b omega^m R^(m + 1) / (m + 3), eq. (3.13), also where a slope is
/// infinite.
TEST(Rheometer, ApparentCoefficientOfALawIsEquation313)
{
  const double R = 9.3, N = 4.7, T = 3.3;
  for (const PolynomialFriction<double> &law :
       {mixed, PolynomialFriction<double>{{0.2, 0.3}, {0.1, 0.5}}, PolynomialFriction<double>{{0.7}, {0}}})
    for (const double omega : {1e-6, 0.21, 30.0}) {
      double numerator = 0, denominator = 0;
      for (std::size_t i = 0; i < law.exponents.size(); ++i) {
        const double b = law.coefficients[i], m = law.exponents[i], rim = std::pow(omega * R, m);
        numerator += 2 * b * rim / (m + 2);
        denominator += 2 * b * rim * R / (m + 3);
      }
      EXPECT_NEAR(apparent_coefficient(law, T, N, R, omega) / (numerator / denominator * T / N), 1, 1e-11);
    }
}

TEST(Rheometer, ApparentCoefficientIsEquation311WithItsFactorRestored)
{
  const double b0 = 0.31, b1 = 0.047, b2 = 0.0021, R = 9.3, N = 4.7, w = 0.21, T = 3.3;
  const double corrected = (b0 / 2 + b1 * R * w / 3 + b2 * R * R * w * w / 4) /
                           (b0 * R / 3 + b1 * R * R * w / 4 + b2 * R * R * R * w * w / 5) * T / N;
  EXPECT_NEAR(apparent_coefficient(PolynomialFriction<double>{{b0, b1, b2}, {0, 1, 2}}, T, N, R, w),
              corrected, 1e-15);
}

TEST(Rheometer, PaperTable2TorquesGiveBackTheirMeanCoefficients)
{
  // T / (N R) of the three laws of Table 2 at 0.01, 0.1 and 1 rad/s, R = 10 mm, four digits
  const PolynomialFriction<double> cases[] = {
      {{2e-4}, {1}}, {{2.6e-4, 1e-5}, {0, 2}}, {{2.2e-4, 3.26e-5}, {0, 1}}};
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
      EXPECT_NEAR(apparent_coefficient(cases[law], torque[law][phase] * N * 10, N, 10, rate) / area_mean, 1,
                  4e-4);
    }
}

/// A ring from A to R as parts: Gauss points along the radius, exact for whole powers.
ContactFace ring(double A, double R)
{
  const auto gauss = gauss_rule<6>();
  std::vector<ContactFace::Part> parts;
  for (int q = 0; q < 6; ++q) {
    const double r = (A + R) / 2 + (R - A) / 2 * gauss.point[q];
    parts.push_back({r, 2 * std::numbers::pi * r * (R - A) / 2 * gauss.weight[q]});
  }
  return ContactFace(parts);
}

/// Integral of r^(power + 1) dr from A to R over that of r dr.
double ring_mean(double A, double R, double power)
{
  return 2 * (std::pow(R, power + 2) - std::pow(A, power + 2)) / ((power + 2) * (R * R - A * A));
}

TEST(Rheometer, MeansOfPowersOverAFace)
{
  const double R = 9.3, A = 5.1;
  EXPECT_EQ(ContactFace(R).mean_power(0), 1);
  EXPECT_NEAR(ContactFace(R).mean_power(1), 2 * R / 3, 1e-14);
  EXPECT_NEAR(ContactFace(R).mean_power(2), R * R / 2, 1e-13);
  for (const double power : {0.0, 1.0, 2.0, 3.0, 5.0}) {
    EXPECT_NEAR(ring(A, R).mean_power(power) / ring_mean(A, R, power), 1, 1e-14);
    EXPECT_NEAR(ring(0, R).mean_power(power) / ContactFace(R).mean_power(power), 1, 1e-14);
  }
}

/// Under uniform pressure the torque of a ring is T/N = sum b_m omega^m <r^(m + 1)>, and the
/// coefficient that it gives is the area mean of mu: of a constant one that constant, where the disc's
/// formula would say 0.153 for 0.1.
TEST(Rheometer, CoefficientsOfARing)
{
  const double A = 6, R = 10, N = 4.7, omega = 0.21;
  const PolynomialFriction<double> law{{0.31, 0.047, 0.0021}, {0, 1, 2}};
  double torque = 0, area_mean = 0;
  for (int m = 0; m < 3; ++m) {
    torque += N * law.coefficients[m] * std::pow(omega, m) * ring_mean(A, R, m + 1);
    area_mean += law.coefficients[m] * std::pow(omega, m) * ring_mean(A, R, m);
  }
  EXPECT_NEAR(apparent_coefficient(law, torque, N, ring(A, R), omega), area_mean, 1e-15);
  const double constant = 0.1 * N * ring_mean(A, R, 1);
  EXPECT_NEAR(apparent_coefficient(PolynomialFriction<double>{{0.1}, {0}}, constant, N, ring(A, R), omega),
              0.1, 1e-16);
  EXPECT_NEAR(apparent_coefficient(PolynomialFriction<double>{{0.1}, {0}}, constant, N,
                                   std::sqrt(R * R - A * A), omega),
              0.153, 5e-4);
  // tractions c omega r: their sum and torque by (2.1) and (2.2) of the two discs
  const double c = 0.037, force = viscous_friction_force(c, omega, R) - viscous_friction_force(c, omega, A);
  const double moment = viscous_torque(c, omega, R) - viscous_torque(c, omega, A);
  EXPECT_NEAR(gong_friction_force(moment, ring(A, R)) / force, 1, 1e-14);
  EXPECT_NEAR(gong_coefficient(moment, N, ring(A, R)) / (force / N), 1, 1e-14);
}

TEST(Rheometer, UndefinedValuesAreNaN)
{
  const PolynomialFriction<double> viscous{{0.2}, {1}}, coulomb{{0.2}, {0}};
  EXPECT_TRUE(std::isnan(gong_coefficient(1.3, 0, 9.3)));
  EXPECT_TRUE(std::isnan(apparent_coefficient(viscous, 1.3, 0, 9.3, 0.7)));
  EXPECT_TRUE(
      std::isnan(apparent_coefficient(viscous, 0, 2.1, 9.3, 0))); // at rest a viscous law says nothing
  EXPECT_TRUE(std::isnan(apparent_coefficient({}, 1.3, 2.1, 9.3, 0.7)));
  EXPECT_TRUE(std::isnan(apparent_coefficient(PolynomialFriction<double>{{0.2}, {1}, 0.7}, 1.3, 2.1, 9.3,
                                              0.7))); // (3.13) needs tau = mu p
  EXPECT_NEAR(apparent_coefficient(coulomb, 1.3, 2.1, 9.3, 0), 1.5 * 1.3 / (2.1 * 9.3), 1e-16);
}

} // namespace
} // namespace tribogel
