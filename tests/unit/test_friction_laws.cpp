/// The catalogue of friction laws: each against its formula as the literature writes it, with long double
/// arithmetic; slopes by v, p and by each parameter against differences of that; the split into three parts;
/// the inverse of steep parts; over twelve decades of speed and six of pressure, and at rest.
#include "tribogel/friction/laws.hpp"
#include "tribogel/friction/torque.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace tribogel
{
namespace
{

using Real = long double;
using Numbers = std::vector<Real>;

/// A law with numbers, and tau(v, p) of its formula, written independently.
struct Example {
  const char *name;
  std::vector<double> numbers;
  std::function<Real(const Numbers &b, Real v, Real p)> tau;
  bool falls = false;
};

/// p^a with the parabola below the floor.
Real load(Real p, Real a, Real floor)
{
  const Real x = p / floor;
  return p >= floor ? std::pow(p, a) : std::pow(floor, a) * x * (2 - a - (1 - a) * x);
}

const std::vector<Example> examples{
    {"coulomb", {0.31}, [](const Numbers &b, Real, Real p) { return b[0] * p; }},
    {"power",
     {0.23, 0.4, 0, 0.7, 2e-4},
     [](const Numbers &b, Real v, Real p) { return b[0] * load(p, b[3], b[4]) * std::pow(v, b[1]); }},
    {"power",
     {0.23, 1.7, 0, 1, 2e-4},
     [](const Numbers &b, Real v, Real p) { return b[0] * load(p, b[3], b[4]) * std::pow(v, b[1]); }},
    {"power",
     {0.23, 0.4, 0.03, 0.7, 2e-4},
     [](const Numbers &b, Real v, Real p) { return b[0] * load(p, b[3], b[4]) * std::pow(v + b[2], b[1]); }},
    {"plateau",
     {0.05, 0.7, 0.5},
     [](const Numbers &b, Real v, Real p) { return b[0] * (1 + std::pow(v / b[1], b[2])) * p; }},
    {"plateau",
     {0.05, 0.7, 1.5},
     [](const Numbers &b, Real v, Real p) { return b[0] * (1 + std::pow(v / b[1], b[2])) * p; }},
    {"exponential_decay",
     {0.4, 0.15, 0.3},
     [](const Numbers &b, Real v, Real p) { return (b[1] + (b[0] - b[1]) * std::exp(-v / b[2])) * p; },
     true},
    {"exponential_decay",
     {0.1, 0.15, 0.3},
     [](const Numbers &b, Real v, Real p) { return (b[1] + (b[0] - b[1]) * std::exp(-v / b[2])) * p; }},
    {"stribeck",
     {0.4, 0.15, 0.3, 1, 0.02},
     [](const Numbers &b, Real v, Real p) {
       return (b[1] + (b[0] - b[1]) * std::exp(-std::pow(v / b[2], b[3])) + b[4] * v) * p;
     },
     true},
    {"stribeck",
     {0.4, 0.15, 0.3, 2.3, 0.02},
     [](const Numbers &b, Real v, Real p) {
       return (b[1] + (b[0] - b[1]) * std::exp(-std::pow(v / b[2], b[3])) + b[4] * v) * p;
     },
     true},
    {"adsorption_viscous",
     {0.002, 0.4, 0.0003, 2e-4},
     [](const Numbers &b, Real v, Real p) {
       return load(p, 0, b[3]) * (b[0] * 2 * (v / b[1]) / (1 + v * v / (b[1] * b[1])) + b[2] * v);
     },
     true},
    {"asinh",
     {0.02, 0.05, 0.6, 2e-4},
     [](const Numbers &b, Real v, Real p) {
       return b[0] * load(p, b[2], b[3]) * std::asinh(v / (2 * b[1]));
     }},
    {"bounded",
     {0.3, 0.004, 0.02, 2e-4},
     [](const Numbers &b, Real, Real p) {
       const Real q = load(p, 0, b[3]);
       return std::min(b[0] * p + b[1] * q, b[2] * q);
     }},
};

const KnownLaw &known(const std::string &name)
{
  for (const KnownLaw &law : known_laws())
    if (law.declaration->name == name) return law;
  throw std::invalid_argument(name);
}

Friction friction_of(const Example &example)
{
  LawValues values;
  for (const double x : example.numbers) values.push_back({x});
  return known(example.name).make(values);
}

double stress(const FrictionLaw &law, double v, double p)
{
  return law.threshold(p).value + (law.has_steep_part() ? law.steep(v, p).value : 0) +
         v * law.drag(v, p).value;
}

/// Twelve decades of speed around 1 mm/s and six of pressure below 1 MPa.
template <class Check> void over_decades(const Check &check)
{
  for (int decade_v = -8; decade_v < 4; ++decade_v)
    for (int decade_p = -6; decade_p < 0; ++decade_p)
      check(3.7 * std::pow(10, decade_v), 2.3 * std::pow(10, decade_p));
}

Real tau_of(const Example &example, double v, double p)
{
  return example.tau(Numbers(example.numbers.begin(), example.numbers.end()), v, p);
}

/// Fourth-order central difference of f at x, step h relative.
Real difference(const std::function<Real(Real)> &f, Real x)
{
  const Real h = x * 1e-4L;
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

TEST(FrictionLaws, AreTheirFormulas)
{
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    over_decades([&](double v, double p) {
      const Real tau = tau_of(example, v, p);
      EXPECT_NEAR(stress(*friction.law(), v, p) / tau, 1, 3e-15) << example.name << ' ' << v << ' ' << p;
      EXPECT_NEAR(friction.coefficient(v, p) * p / tau, 1, 3e-15) << example.name << ' ' << v << ' ' << p;
    });
  }
}

/// What rises or falls by less than a digit of tau is compared with tau itself.
TEST(FrictionLaws, SlopesBySpeedAndPressureAreThoseOfTheFormula)
{
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    const FrictionLaw &law = *friction.law();
    const Numbers b(example.numbers.begin(), example.numbers.end());
    over_decades([&](double v, double p) {
      if (std::string(example.name) == "bounded" && std::abs(p - 0.016 / 0.3) < 0.01) return; // its kink
      const Real tau = tau_of(example, v, p);
      const Real by_v = difference([&](Real x) { return example.tau(b, x, p); }, v) * v / tau;
      const Real by_p = difference([&](Real x) { return example.tau(b, v, x); }, p) * p / tau;
      EXPECT_NEAR(friction.slope(v, p) * v / tau, by_v, 1e-11) << example.name << ' ' << v << ' ' << p;
      const double slope =
          law.threshold(p).d_p + (law.has_steep_part() ? law.steep(v, p).d_p : 0) + v * law.drag(v, p).d_p;
      EXPECT_NEAR(slope * p / tau, by_p, 1e-11) << example.name << ' ' << v << ' ' << p;
    });
  }
}

/// The smooth part for itself, whose slope a threshold would hide: drag is [tau - tau(0)] / v, from long
/// double arithmetic where that keeps enough digits.
TEST(FrictionLaws, SmoothPartsAndTheirSlopesKeepTheirDigits)
{
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    if (friction.has_steep_part()) continue;
    const Numbers b(example.numbers.begin(), example.numbers.end());
    over_decades([&](double v, double p) {
      if (v < 1e-3) return;
      const auto drag = [&](Real x) { return (example.tau(b, x, p) - example.tau(b, 0, p)) / x; };
      const LawValue at = friction.law()->drag(v, p);
      const Real expected = drag(v), scale = std::max(std::abs(expected), Real(1e-300));
      EXPECT_NEAR(at.value / scale, expected / scale, 1e-12) << example.name << ' ' << v << ' ' << p;
      EXPECT_NEAR(at.d_v * v / scale, difference(drag, v) * v / scale, 1e-8)
          << example.name << ' ' << v << ' ' << p;
    });
    // Towards rest value and slope go to their limits.
    const LawValue rest = friction.law()->drag(0, 0.1), near = friction.law()->drag(1e-9, 0.1);
    EXPECT_TRUE(std::isfinite(rest.value) && std::isfinite(rest.d_v) && std::isfinite(rest.d_p))
        << example.name;
    EXPECT_NEAR(near.value, rest.value, 1e-5 * std::abs(rest.value) + 1e-6) << example.name;
  }
}

TEST(FrictionLaws, SlopesByParametersAreThoseOfTheFormula)
{
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    for (std::size_t k = 0; k < example.numbers.size(); ++k) {
      if (std::string(known(example.name).declaration->parameters[k].name) == "pressure_floor") continue;
      if (example.numbers[k] == 0 ||
          (std::string(example.name) == "power" && k == 3 && example.numbers[k] == 1))
        continue; // at the end of its range
      over_decades([&](double v, double p) {
        if (std::string(example.name) == "bounded" && std::abs(p - 0.016 / 0.3) < 0.01) return;
        Numbers b(example.numbers.begin(), example.numbers.end());
        const auto tau = [&](Real x) {
          b[k] = x;
          return example.tau(b, v, p);
        };
        const Real expected =
            difference(tau, example.numbers[k]) * example.numbers[k] / tau_of(example, v, p);
        const LawParameterSlope slope = friction.law()->parameter_slope(k, 0, v, p);
        const double found = (slope.threshold + slope.steep + v * slope.drag) * example.numbers[k];
        EXPECT_NEAR(found / tau_of(example, v, p), expected, 1e-9 * std::max(Real(1), std::abs(expected)))
            << example.name << ' ' << k << ' ' << v << ' ' << p;
      });
    }
  }
}

TEST(FrictionLaws, SteepSpeedIsTheInverse)
{
  int steep = 0;
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    if (!friction.has_steep_part()) continue;
    ++steep;
    over_decades([&](double v, double p) {
      for (const double share : {1e-6, 0.3, 1e6}) {
        const double of_law = friction.law()->steep(v, p).value, drag = share * of_law / v;
        const double found = friction.law()->steep_speed(of_law * (1 + share), drag, p);
        EXPECT_NEAR(found / v, 1, 1e-13) << example.name << ' ' << v << ' ' << p << ' ' << share;
      }
    });
    const Dual<3> v =
        friction.steep_speed(Dual<3>::seed(0.02, 0), Dual<3>::seed(0.03, 1), Dual<3>::seed(0.1, 2));
    const auto at = [&](double s, double d, double p) { return friction.law()->steep_speed(s, d, p); };
    const double h = 1e-5;
    EXPECT_NEAR(v.d[0], (at(0.02 + h, 0.03, 0.1) - at(0.02 - h, 0.03, 0.1)) / (2 * h), 1e-4 * v.d[0]);
    EXPECT_NEAR(v.d[1], (at(0.02, 0.03 + h, 0.1) - at(0.02, 0.03 - h, 0.1)) / (2 * h), -1e-4 * v.d[1]);
    EXPECT_NEAR(v.d[2], (at(0.02, 0.03, 0.1 + h) - at(0.02, 0.03, 0.1 - h)) / (2 * h), -1e-4 * v.d[2]);
  }
  EXPECT_EQ(steep, 3);
}

TEST(FrictionLaws, SayWhetherTheyFall)
{
  for (const Example &example : examples) {
    const Friction friction = friction_of(example);
    EXPECT_EQ(friction.law()->may_fall(), example.falls) << example.name;
    bool falls = false;
    for (double v = 1e-6; v < 1e5; v *= 1.1) falls = falls || friction.slope(v, 0.1) < 0;
    EXPECT_EQ(falls, example.falls) << example.name;
  }
}

/// The closed forms of a power and of Coulomb's law: T/N = mu_0 <r v^n> = 2 mu_0 omega^n R^(n + 1) / (n + 3).
TEST(FrictionLaws, ApparentCoefficientHoldsForAnyLaw)
{
  const double R = 9.3, omega = 0.7, n = 0.5, N = 3.1, T = 2.7;
  const Friction power = known("power").make({{0.2}, {n}, {0}, {1}, {1e-5}});
  const double mean = 2 * 0.2 * std::pow(omega * R, n) / (n + 2);
  const double per_force = 2 * 0.2 * std::pow(omega * R, n) * R / (n + 3);
  EXPECT_NEAR(apparent_coefficient(power, T, N, R, omega), mean / per_force * T / N, 1e-12);
  const Friction coulomb = known("coulomb").make({{0.2}});
  EXPECT_NEAR(apparent_coefficient(coulomb, T, N, R, omega), 1.5 / R * T / N, 1e-12);
  EXPECT_TRUE(
      std::isnan(apparent_coefficient(known("asinh").make({{0.2}, {1}, {0.5}, {1e-5}}), T, N, R, omega)));
}

/// The curve meets its points, with slopes by their coefficients that add up to 1,
/// since mu + c shifts the curve by c.
TEST(FrictionTable, MeetsItsPointsWithoutOvershoot)
{
  const std::vector<double> v{0, 0.1, 0.5, 2, 7}, mu{0.3, 0.31, 0.5, 0.55, 0.42};
  const Friction table = known("table").make({v, mu, {0}});
  const double p = 0.7;
  for (std::size_t k = 0; k < v.size(); ++k) EXPECT_NEAR(table.coefficient(v[k], p), mu[k], 1e-15);
  const Friction level = known("table").make({v, {0.3, 0.31, 0.5, 0.5, 0.42}, {0}});
  for (double x = 0.5; x <= 2; x += 0.01) EXPECT_NEAR(level.coefficient(x, p), 0.5, 1e-15);
  for (const double x : {0.01, 0.07, 0.3, 4.0}) {
    const double h = 1e-5 * x;
    EXPECT_NEAR(table.slope(x, p), p * (table.coefficient(x + h, p) - table.coefficient(x - h, p)) / (2 * h),
                1e-8);
    double sum = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const LawParameterSlope slope = table.law()->parameter_slope(1, k, x, p);
      sum += slope.threshold + x * slope.drag;
      std::vector<double> more = mu, less = mu;
      more[k] += 1e-6, less[k] -= 1e-6;
      const double difference = (known("table").make({v, more, {0}}).coefficient(x, p) -
                                 known("table").make({v, less, {0}}).coefficient(x, p)) /
                                2e-6;
      EXPECT_NEAR(slope.threshold + x * slope.drag, p * difference, 1e-7) << x << ' ' << k;
    }
    EXPECT_NEAR(sum, p, 1e-13);
  }
  EXPECT_TRUE(table.law()->may_fall());
  EXPECT_EQ(table.law()->highest_speed(), 7);
}

TEST(FrictionTable, HoldsItsEndsIfAsked)
{
  const Friction table = known("table").make({{0.1, 0.5, 2, 7}, {0.3, 0.31, 0.5, 0.52}, {1}});
  EXPECT_EQ(table.coefficient(0.01, 1), 0.3);
  EXPECT_NEAR(table.coefficient(1e3, 1), 0.52, 1e-15);
  EXPECT_TRUE(std::isinf(table.law()->highest_speed()));
  const auto objection = known("table").declaration->objection;
  EXPECT_EQ(objection({{0.1, 0.5, 2, 7}, {0.3, 0.31, 0.5, 0.52}, {0}}).parameter, 0u);
  EXPECT_NE(objection({{0.1, 0.5, 2, 7}, {0.3, 0.31, 0.5, 0.52}, {0}}).text, "");
  EXPECT_NE(objection({{0, 0.5, 0.5, 7}, {0.3, 0.31, 0.5, 0.52}, {0}}).text, "");
  EXPECT_NE(objection({{0, 0.5, 7}, {0.3, 0.31, 0.5}, {0}}).text, "");
  EXPECT_EQ(objection({{0, 0.5, 2, 7}, {0.3, 0.31, 0.5, 0.52}, {0}}).text, "");
}

TEST(FrictionLaws, HaveNamesOfTheirOwn)
{
  std::vector<std::string> names;
  for (const KnownLaw &law : known_laws()) {
    names.emplace_back(law.declaration->name);
    for (const LawParameter &parameter : law.declaration->parameters)
      names.push_back(law.declaration->option(parameter));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

} // namespace
} // namespace tribogel
