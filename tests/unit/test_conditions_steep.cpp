/// Contact conditions of laws that are not smooth at v = 0 or p = 0: exact zeros, derivatives, rest, Newton's
/// method over decades.
#include "node_on_springs.hpp"
#include "tribogel/contact/node/condition_slope.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace tribogel
{
namespace
{

using Law = PolynomialFriction<double>;
using testing::NodeOnSprings;
using Vector11 = Eigen::Matrix<double, 11, 1>;

constexpr double eps = std::numeric_limits<double>::epsilon();
const ContactScale scale{2.3, 0.71};
const Vector3<double> normal = Vector3<double>(0.21, 0, -1.3).normalized();
const std::vector<std::vector<double>> exponent_lists{{0.1},    {0.25},   {0.5},      {0.9},         {0, 0.5},
                                                      {0.5, 1}, {0.5, 2}, {0.3, 0.7}, {0, 0.5, 1, 2}};
const double pressure_exponents[] = {0, 0.3, 0.7, 1};

Vector3<double> tangential(double along, double around)
{
  return along * Vector3<double>(-normal[2], 0, normal[0]) + Vector3<double>(0, around, 0);
}

template <class T> ContactPoint<T> unpack(const Eigen::Matrix<T, 11, 1> &x)
{
  return {x.template head<3>(), x.template segment<3>(7), x[3], x.template segment<3>(4), x[10]};
}

Vector11 pack(const Vector3<double> &multiplier, double gap, const Vector3<double> &velocity,
              double area_ratio)
{
  Vector11 x;
  x.head<3>() = multiplier; // the comma initialiser makes g++ 12 warn of array bounds with AVX-512
  x[3] = gap;
  x.segment<3>(4) = velocity;
  x.segment<3>(7) = normal;
  x[10] = area_ratio;
  return x;
}

ContactCondition<double> condition(const Vector11 &x, const Law &law)
{
  return contact_condition<double>(unpack<double>(x), scale, law);
}

Eigen::Matrix<double, 3, 11> jacobian(const Vector11 &x, const Law &law)
{
  Eigen::Matrix<Dual<11>, 11, 1> dual;
  for (int i = 0; i < 11; ++i) dual[i] = Dual<11>::seed(x[i], i);
  const auto C = contact_condition<Dual<11>>(unpack<Dual<11>>(dual), scale, law).residual;
  Eigen::Matrix<double, 3, 11> J;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 11; ++j) J(i, j) = C[i].d[j];
  return J;
}

/// Coefficients that make each term as large as `stress` at the speed v under the pressure p.
Law law_of(const std::vector<double> &exponents, double pressure_exponent, double v, double p, double stress)
{
  Law law{{}, exponents, pressure_exponent, 1e-5};
  for (const double m : exponents) law.coefficients.push_back(stress / (law.load(p) * std::pow(v, m)));
  return law;
}

TEST(SteepCondition, IsZeroWhereTheLawHoldsAndOnlyThere)
{
  const double J = 1.37;
  for (const auto &exponents : exponent_lists)
    for (const double a : pressure_exponents)
      for (double v = 1e-12; v < 2e3; v *= 100)
        for (double p = 1e-12; p < 20; p *= 100)
          for (const double strength : {1e-4, 1.0, 1e4}) { // of the law over c_T v
            const Law law = law_of(exponents, a, v, p, strength * scale.tangential * v);
            const double ratio = a == 1 ? 1 : J; // a law linear in p does not see the area
            const double tau = law.coefficient(v, p / ratio) * p;
            if (tau > 1e3 * p)
              continue; // p, a difference of components of the multiplier, would be lost in round-off
            const Vector3<double> direction = tangential(0.6, 0.8);
            const auto C = condition(pack(-p * normal - tau * direction, 0, v * direction, J), law);
            EXPECT_EQ(C.status, ContactStatus::slip);
            EXPECT_LT(C.residual.norm(), 64 * eps * (tau + p) * std::max(1.0, tau / p));
            for (const double factor : {0.97, 1.03}) {
              const Vector11 off = pack(-p * normal - factor * tau * direction, 0, v * direction, J);
              EXPECT_GT(condition(off, law).residual.norm(), 1e-3 * std::min(tau, scale.tangential * v));
            }
          }
}

TEST(SteepCondition, DerivativesAgreeWithDifferences)
{
  for (const auto &exponents : exponent_lists)
    for (const double a : pressure_exponents)
      for (const double strength : {0.03, 1.0, 30.0}) {
        Law law = law_of(exponents, a, 1.1, 1.7, strength * scale.tangential * 1.1);
        law.coefficients.push_back(-0.01); // weakening in the smooth part
        law.exponents.push_back(1.4);
        for (const double gap : {0.03, 0.0, -0.3}) {
          const Vector11 x = pack(-1.7 * normal + tangential(0.9, -1.2), gap, tangential(-0.8, 1.7), 1.37);
          const auto J = jacobian(x, law);
          for (int j = 0; j < 11; ++j) {
            const auto moved = [&](double by) { return condition(x + by * Vector11::Unit(j), law).residual; };
            const double h = 1e-3;
            const Vector3<double> difference =
                (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
            EXPECT_LT((J.col(j) - difference).norm(), 1e-8 * J.norm()) << "column " << j << ", a " << a;
          }
          if (strength <= 1) { // more holds the node, where the area does not matter
            EXPECT_EQ(J.col(10).norm() > 1e-9, a != 1);
          }
        }
      }
}

/// The area ratio of a law linear in p cancels, bit for bit.
TEST(SteepCondition, LinearLawsDoNotSeeTheArea)
{
  const Law law{{0.29, 0.37, 0.11}, {0, 1, 2.5}};
  const Vector11 x = pack(-1.7 * normal + tangential(0.9, -1.2), -0.1, tangential(-0.8, 1.7), 1);
  Vector11 y = x;
  y[10] = 1.37;
  EXPECT_EQ(condition(x, law).residual, condition(y, law).residual);
}

/// At rest the rows are regular, and the derivative is that of the states nearby: nothing is smoothed,
/// nothing jumps.
TEST(SteepCondition, IsContinuouslyDifferentiableAtRest)
{
  for (const auto &exponents : exponent_lists)
    for (const double a : pressure_exponents) {
      const Law law = law_of(exponents, a, 1.1, 1.7, 0.31);
      const double b = law.threshold(1.7 / 1.37) * 1.37;
      const Vector3<double> limit = a == 1 ? tangential(0, law.threshold(1.7)) : tangential(0, b);
      const auto at_rest = jacobian(pack(-1.7 * normal + limit, 0, Vector3<double>::Zero(), 1.37), law);
      EXPECT_TRUE(at_rest.allFinite());
      EXPECT_EQ((at_rest.leftCols<7>().fullPivLu().rank()), 3);
      for (const double side : {-1.0, 1.0}) {
        const double traction = side * std::pow(1e-12, 0.9); // slope of the inverse below 1e-12^(1/0.9 - 1)
        const Vector3<double> near = limit + tangential(0, traction);
        const auto beside = jacobian(pack(-1.7 * normal + near, 0, Vector3<double>::Zero(), 1.37), law);
        const double tolerance = exponents[0] == 0.9 ? 0.3 : exponents == std::vector{0.3, 0.7} ? 1e-3 : 1e-8;
        EXPECT_LT((beside - at_rest).norm(), tolerance * at_rest.norm());
      }
    }
  // nothing at all but pressure: the row is the velocity
  Vector11 pressed = pack({0, 0, 1.7}, 0, Vector3<double>::Zero(), 1);
  pressed.segment<3>(7) = Vector3<double>(0, 0, -1);
  const auto loaded = jacobian(pressed, {{0.4}, {0.5}});
  EXPECT_EQ(loaded(1, 1), 0);
  EXPECT_EQ(loaded(1, 5), scale.tangential);
  // no pressure yet: the row is the multiplier
  const auto unloaded = jacobian(pack({0, 0, 0}, 0, Vector3<double>::Zero(), 1), {{0.4}, {0.5}});
  EXPECT_TRUE(unloaded.allFinite());
  EXPECT_EQ(unloaded(1, 1), 1);
}

/// In a steady state the velocity is the plates' (c_T infinite): the rows hold the law, they are linear in
/// the multiplier, and at rest, where nothing drags, they say that there is no traction.
TEST(SteepCondition, AtAGivenVelocityIsTheLaw)
{
  const ContactScale given{scale.normal, std::numeric_limits<double>::infinity()};
  const double J = 1.37, p = 1.7;
  for (const auto &exponents : exponent_lists)
    for (const double a : pressure_exponents) {
      const Law law = law_of(exponents, a, 1.1, p, 0.31);
      const auto at = [&](const Vector11 &x) {
        return contact_condition<double>(unpack<double>(x), given, law);
      };
      const auto slope = [&](const Vector11 &x) {
        return condition_slope<11>(unpack<double>(x), given, law);
      };
      for (const double v : {1e-12, 0.02, 30.0}) {
        const Vector3<double> direction = tangential(0.6, 0.8);
        const double tau = law.coefficient(v, p / (a == 1 ? 1 : J)) * p;
        const Vector11 x = pack(-p * normal - tau * direction, 0, v * direction, J);
        EXPECT_EQ(at(x).status, ContactStatus::slip);
        EXPECT_LT(at(x).residual.norm(), 64 * eps * (tau + p));
        const Vector3<double> more = tangential(0.4, -0.3);
        EXPECT_LT(
            (at(pack(-p * normal - tau * direction + more, 0, v * direction, J)).residual - more).norm(),
            64 * eps * (tau + p));
        const auto derivative = slope(x);
        for (int j = 0; j < 11; ++j) {
          const double h = j >= 4 && j < 7 ? 1e-3 * v : 1e-5;
          const auto moved = [&](double by) { return at(x + by * Vector11::Unit(j)).residual; };
          const Vector3<double> difference =
              (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
          EXPECT_LT((derivative.col(j) - difference).norm(), 1e-7 * derivative.col(j).norm() + 1e-9)
              << "column " << j;
        }
      }
      const Vector3<double> traction = tangential(0.2, -0.5);
      const Vector11 resting = pack(-p * normal + traction, 0, Vector3<double>::Zero(), J);
      EXPECT_LT((at(resting).residual - traction).norm(), 8 * eps);
      EXPECT_EQ(at(resting).status, ContactStatus::stick);
      EXPECT_TRUE(slope(resting).allFinite());
      const Matrix3<double> by_multiplier_and_gap =
          slope(resting).leftCols<3>() + slope(resting).col(3) * normal.transpose();
      EXPECT_EQ(by_multiplier_and_gap.fullPivLu().rank(), 3);
    }
}

/// The traction at which law and spring meet, by bisection in log v: tau(v) = K (V - v).
double meeting_traction(const Law &law, double K, double V, double p)
{
  double low = -800, high = std::log(V);
  const auto excess = [&](double x) { return law.coefficient(std::exp(x), p) * p + K * std::exp(x) - K * V; };
  if (excess(low) > 0) return K * V; // it sticks
  for (int i = 0; i < 200; ++i) (excess((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return std::min(K * V, law.coefficient(std::exp(low), p) * p);
}

TEST(SteepCondition, NewtonConvergesFromRestOverDecades)
{
  for (const auto &exponents : exponent_lists)
    for (const double a : pressure_exponents) {
      std::mt19937 random(7);
      const auto decades = [&](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
      };
      int most = 0, sum = 0;
      constexpr int trials = 100;
      for (int trial = 0; trial < trials; ++trial) {
        const double speed = decades(-12, 3), p = decades(-12, 1), shift = decades(-3, 3),
                     angle = decades(-2, 0.1);
        const double K = p * decades(-5, 5) / speed; // of the spring, per velocity
        const double k = K * shift, k_n = k * decades(-0.5, 0.5), ratio = decades(-1, std::log10(2.0));
        Law law{{}, exponents, a, 1e-5};
        for (const double m : exponents)
          law.coefficients.push_back(decades(-5, 5) * K * speed / (law.load(p) * std::pow(speed, m)));
        const Vector3<double> V(speed * std::cos(angle), -speed * std::sin(angle), 0);
        const NodeOnSprings node{k,         k_n, shift, ratio * k_n,
                                 ratio * K, p,   V,     meeting_traction(law, K, speed, p)};
        for (const bool first_touch : {false, true}) {
          const int iterations = node.newton_iterations(law, first_touch);
          most = std::max(most, iterations);
          sum += iterations;
        }
      }
      EXPECT_LE(most, 12) << "exponents from " << exponents[0] << ", " << exponents.size() << " of them, a "
                          << a;
      EXPECT_LE(sum, 5 * 2 * trials);
    }
}

} // namespace
} // namespace tribogel
