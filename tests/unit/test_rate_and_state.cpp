/// Rate-and-state friction: the formula in long double arithmetic, what it remembers against the ageing law's
/// differential equation integrated by Boost, its exact steady state, its inverse, the contact condition.
#include "node_on_springs.hpp"
#include "tribogel/contact/node/condition_slope.hpp"
#include "tribogel/friction/laws.hpp"
#include "tribogel/friction/torque.hpp"

#include <boost/numeric/odeint.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace tribogel
{
namespace
{

using Real = long double;
using Numbers = std::array<Real, 6>; ///< mu_0, a, b, L, v_0, theta_0

constexpr double infinity = std::numeric_limits<double>::infinity();
const Numbers weakening{0.3L, 0.011L, 0.016L, 0.07L, 0.02L, 3.5L},
    strengthening{0.05L, 0.02L, 0.007L, 0.4L, 3, 1e-3L};

Friction friction_of(const Numbers &b)
{
  for (const KnownLaw &law : known_laws())
    if (law.declaration->name == std::string("rate_and_state")) {
      LawValues values;
      for (const Real x : b) values.push_back({static_cast<double>(x)});
      return law.make(values);
    }
  throw std::invalid_argument("rate_and_state");
}

/// theta after sliding at v for h.
Real age(const Numbers &b, Real v, Real start, Real h)
{
  if (std::isinf(h)) return b[3] / v;
  const Real s = v * h / b[3];
  return start * std::exp(-s) - (s == 0 ? -h : h * std::expm1(-s) / s);
}

/// mu at v and theta; asinh(x) = ln(x + (1 + x^2)^(1/2)).
Real coefficient(const Numbers &b, Real v, Real theta)
{
  const Real x = v / (2 * b[4]) * std::exp((b[0] + b[2] * std::log(b[4] * theta / b[3])) / b[1]);
  return b[1] * std::asinh(x);
}

/// Fourth-order central difference of f at x, step h relative.
Real difference(const std::function<Real(Real)> &f, Real x)
{
  const Real h = x * 1e-4L;
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

/// Twelve decades of speed, six of pressure, and what a solve can start from and be: frozen, short, long, for
/// ever.
template <class Check> void over_decades(const Check &check)
{
  for (const Numbers *b : {&weakening, &strengthening})
    for (const double step : {0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6, infinity})
      for (const double start : {1e-6, 1e-2, 30.0, 1e7})
        for (int decade_v = -8; decade_v < 4; ++decade_v)
          for (int decade_p = -6; decade_p < 0; ++decade_p)
            check(*b, 3.7 * std::pow(10, decade_v), 2.3 * std::pow(10, decade_p), LawMemory{start, {step}});
}

TEST(RateAndState, IsItsFormulaWithItsSlopes)
{
  over_decades([](const Numbers &b, double v, double p, const LawMemory &memory) {
    const Friction friction = friction_of(b);
    const auto tau = [&](Real x) {
      return coefficient(b, x, age(b, x, memory.start, memory.weights.step)) * p;
    };
    const LawValue at = friction.law()->steep(v, p, memory);
    const Real expected = tau(v);
    EXPECT_NEAR(at.value / expected, 1, 2e-14) << v << ' ' << memory.start << ' ' << memory.weights.step;
    EXPECT_NEAR(at.d_v * v / expected, difference(tau, v) * v / expected, 1e-11)
        << v << ' ' << memory.start << ' ' << memory.weights.step;
    EXPECT_NEAR(at.d_p * p / expected, 1, 2e-14);
    EXPECT_EQ(friction.law()->threshold(p, memory).value, 0);
    EXPECT_EQ(friction.law()->drag(v, p, memory).value, 0);
  });
}

TEST(RateAndState, SlopesByParametersAreThoseOfTheFormula)
{
  over_decades([](const Numbers &b, double v, double p, const LawMemory &memory) {
    if (p > 1e-5) return; // proportional to p
    const Friction friction = friction_of(b);
    for (std::size_t k = 0; k < b.size(); ++k) {
      Numbers varied = b;
      const auto tau = [&](Real x) {
        varied[k] = x;
        return coefficient(varied, v, age(varied, v, memory.start, memory.weights.step)) * p;
      };
      const Real scale = tau(b[k]), expected = difference(tau, b[k]) * b[k] / scale;
      const double found =
          friction.law()->parameter_slope(k, 0, v, p, memory).steep * static_cast<double>(b[k]);
      EXPECT_NEAR(found / scale, expected, 1e-9 * std::max(Real(1), std::abs(expected))) << k << ' ' << v;
    }
  });
}

/// d theta / dt = 1 - v theta / L by Dormand and Prince's method; at rest theta is the time, exactly; a solve
/// that reaches further goes on at the same speed.
TEST(RateAndState, RemembersWhatTheAgeingLawSays)
{
  namespace odeint = boost::numeric::odeint;
  const Numbers &b = weakening;
  const FrictionLaw &law = *friction_of(b).law();
  for (const double slips : {1e-6, 0.02, 0.7, 5.0, 40.0}) // v h / L
    for (const double start : {0.01, 2.0, 300.0}) {
      const double h = 1.7, L = static_cast<double>(b[3]), v = slips * L / h;
      double theta = start;
      odeint::integrate_adaptive(
          odeint::make_controlled<odeint::runge_kutta_dopri5<double>>(1e-14, 1e-13),
          [&](const double &x, double &rate, double) { rate = 1 - v * x / L; }, theta, 0.0, h, 1e-4 * h);
      EXPECT_NEAR(law.memory_after(v, {start, {h}}) / theta, 1, 1e-11) << slips << ' ' << start;
      EXPECT_NEAR(law.memory_after(v, {start, {h / 2.4, 2.4}}) / theta, 1, 1e-11);
    }
  EXPECT_EQ(law.memory_after(0, {0.3, {1e4}}), 0.3 + 1e4);
  EXPECT_EQ(law.memory_after(5, {0.3, {0}}), 0.3);
  EXPECT_EQ(law.initial_memory(), static_cast<double>(b[5]));
}

/// Where theta = L / v nothing changes, and mu = mu_0 + (a - b) ln(v / v_0) as long as exp(mu / a) >> 1; a
/// law that is told of no memory is this one.
TEST(RateAndState, HasItsExactSteadyState)
{
  for (const Numbers &b : {weakening, strengthening}) {
    const Friction friction = friction_of(b);
    for (double v = 1e-8; v < 2e4; v *= 10) {
      const double theta = static_cast<double>(b[3]) / v;
      for (const double step : {0.0, 1e-3, 1.0, 1e5, infinity}) {
        const Friction there = friction.remembering(theta, {step});
        EXPECT_NEAR(there.memory_after(v) / theta, 1, 4e-15) << v << ' ' << step;
        EXPECT_NEAR(there.coefficient(v, 0.1) / friction.coefficient(v, 0.1), 1, 4e-15);
      }
      const Real logarithm = b[0] + (b[1] - b[2]) * std::log(v / b[4]);
      EXPECT_NEAR(friction.coefficient(v, 0.1), b[1] * std::asinh(std::exp(logarithm / b[1]) / 2), 1e-15);
      if (logarithm > 18 * b[1]) {
        EXPECT_NEAR(friction.coefficient(v, 0.1), logarithm, 1e-15);
      }
      if (logarithm > 18 * b[1]) {
        EXPECT_NEAR(friction.slope(v, 0.1) * v, 0.1L * (b[1] - b[2]), 1e-15);
      }
      EXPECT_NEAR(friction.law()->memory_rate(v) * theta, 1, 1e-15);
    }
    EXPECT_EQ(friction.law()->may_fall(), b[2] > b[1]);
    EXPECT_EQ(friction.law()->holds_at_rest(), b[2] > b[1]);
  }
}

/// The apparent coefficient of a disc is that of steady sliding: with c = a - b it is (3.13) of mu = mu_0 + c
/// ln(v / v_0), whose means are <ln x> = -1/2 and <x ln x> = -2/9 for x = r / R.
TEST(RateAndState, ApparentCoefficientIsThatOfSteadySliding)
{
  const Numbers &b = weakening;
  const double R = 9.3, omega = 0.7, N = 3.1, T = 2.7;
  const double c = static_cast<double>(b[1] - b[2]),
               rim = static_cast<double>(b[0]) + c * std::log(omega * R / static_cast<double>(b[4]));
  const double mean = rim - c / 2, moment = R * (rim * 2 / 3 - c * 2 / 9);
  EXPECT_NEAR(apparent_coefficient(friction_of(b), T, N, R, omega), mean / moment * T / N, 1e-10);
}

/// What is added to c_T makes the sum rise, whatever the solve, and its inverse is found.
TEST(RateAndState, FallsNoFasterThanItSaysAndHasAnInverse)
{
  over_decades([](const Numbers &b, double v, double p, const LawMemory &memory) {
    if (p > 1e-5) return;
    const FrictionLaw &law = *friction_of(b).law();
    if (std::isinf(memory.weights.step) && law.holds_at_rest()) return; // steady friction that does not rise
    const LawValue at = law.steep(v, p, memory), fall = law.steepest_fall(p, memory);
    EXPECT_GE(at.d_v, -fall.value * (1 + 1e-12));
    EXPECT_NEAR(fall.d_p * p, fall.value, 1e-15 * fall.value);
    for (const double share : {1e-6, 0.3, 1e6}) {
      const double drag = 2 * fall.value + share * at.value / v;
      EXPECT_NEAR(law.steep_speed(at.value + drag * v, drag, p, memory) / v, 1, 1e-12)
          << v << ' ' << memory.start << ' ' << memory.weights.step << ' ' << share;
    }
  });
  // Where the speed is less than the smallest number the gels rest.
  const Friction stiff = friction_of({0.8L, 1e-4L, 1e-4L, 0.1L, 0.1L, 1});
  EXPECT_EQ(stiff.remembering(1, {1}).steep_speed(1e-3, 1.0, 0.1), 0);
}

using Vector10 = Eigen::Matrix<double, 10, 1>;

ContactPoint<double> point_at(const Vector10 &x)
{
  return {x.head<3>(), x.segment<3>(7), x[3], x.segment<3>(4), 1};
}

/// The condition is zero where the law holds and only there; its derivatives are those of its values.
TEST(RateAndState, ConditionHoldsTheLaw)
{
  const ContactScale scale{2.3, 0.71};
  const Vector3<double> normal(0, 0, -1), along(0.6, 0.8, 0);
  const double p = 0.13;
  for (const Numbers &b : {weakening, strengthening})
    for (const double step : {1e-3, 0.3, 20.0})
      for (const double start : {1e-3, 1.0, 1e3})
        for (const double v : {1e-9, 1e-4, 0.05, 7.0}) {
          const Friction law = friction_of(b).remembering(start, {step});
          const double tau = law.coefficient(v, p) * p;
          const auto at = [&](const Vector10 &x) {
            return contact_condition<double>(point_at(x), scale, law);
          };
          Vector10 x;
          x.head<3>() = -p * normal - tau * along;
          x[3] = 0;
          x.segment<3>(4) = v * along;
          x.segment<3>(7) = normal;
          EXPECT_EQ(at(x).status, ContactStatus::slip);
          EXPECT_LT(at(x).residual.norm(), 1e-13 * p);
          Vector10 off = x;
          off.head<3>() -= 0.03 * tau * along;
          EXPECT_GT(at(off).residual.norm(), 1e-4 * std::min(tau, scale.tangential * v));
          off.head<3>() += Vector3<double>(0.002, -0.001, 0.01);
          const auto J = condition_slope<10>(point_at(off), scale, law);
          for (int j = 0; j < 10; ++j) {
            const double h = j >= 4 && j < 7 ? 1e-3 * std::max(v, 1e-4) : 1e-5;
            const auto moved = [&](double by) { return at(off + by * Vector10::Unit(j)).residual; };
            const Vector3<double> difference =
                (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
            EXPECT_LT((J.col(j) - difference).norm(), 1e-7 * J.norm())
                << "column " << j << ' ' << v << ' ' << step;
          }
        }
}

/// The traction at which law and spring meet, by bisection in log v: tau(v) = K (V - v).
double meeting_traction(const Friction &law, double K, double V, double p)
{
  double low = -740, high = std::log(V);
  const auto excess = [&](double x) { return law.coefficient(std::exp(x), p) * p + K * std::exp(x) - K * V; };
  if (excess(low) > 0) return K * V; // it sticks
  for (int i = 0; i < 200; ++i) (excess((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return std::min(K * V, law.coefficient(std::exp(low), p) * p);
}

TEST(RateAndState, NewtonConvergesFromRestOverDecades)
{
  std::mt19937 random(7);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
  };
  int most = 0, sum = 0;
  constexpr int trials = 1000;
  for (int trial = 0; trial < trials; ++trial) {
    const double speed = decades(-6, 2), p = decades(-6, 0), shift = decades(-3, 3), angle = decades(-2, 0.1);
    const double K = p * decades(-2, 2) / speed; // of the spring, per velocity
    const double k = K * shift, k_n = k * decades(-0.5, 0.5), ratio = decades(-1, std::log10(2.0));
    const Real a = decades(-3, -1), b = a * decades(-1, 1), L = p * b / k * decades(0, 3);
    const Friction law = friction_of({decades(-1, 0), a, b, L, speed * decades(-2, 2), 1})
                             .remembering(static_cast<double>(L) / speed * decades(-3, 3), {1 / shift});
    const Vector3<double> V(speed * std::cos(angle), -speed * std::sin(angle), 0);
    const testing::NodeOnSprings node{k,         k_n, shift, ratio * k_n,
                                      ratio * K, p,   V,     meeting_traction(law, K, speed, p)};
    for (const bool first_touch : {false, true}) {
      const int iterations = node.newton_iterations(law, first_touch);
      most = std::max(most, iterations);
      sum += iterations;
    }
  }
  EXPECT_LE(most, 8);
  EXPECT_LE(sum, 3 * 2 * trials);
}

} // namespace
} // namespace tribogel
