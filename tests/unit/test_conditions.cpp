/// Contact and friction conditions at one node: zeros, derivatives, ties.
#include "tribogel/contact/node/condition.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tribogel
{
namespace
{

using Law = PolynomialFriction<double>;
using Vector10 = Eigen::Matrix<double, 10, 1>;

const ContactScale scale{2.3, 0.71};
const Law viscous{{0.37}, {1}}, coulomb{{0.29}, {0}}, mixed{{0.29, 0.37, 0.11}, {0, 1, 2.5}}, frictionless{},
    weakening{{0.29, -0.037}, {0, 1}};
const Vector3<double> normal = Vector3<double>(0.21, 0, -1.3).normalized();

template <class T> ContactPoint<T> unpack(const Eigen::Matrix<T, 10, 1> &x)
{
  return {x.template head<3>(), x.template tail<3>(), x[3], x.template segment<3>(4)};
}

Vector10 pack(const Vector3<double> &multiplier, double gap, const Vector3<double> &velocity,
              const Vector3<double> &n = normal)
{
  Vector10 x;
  x << multiplier, gap, velocity, n;
  return x;
}

/// Unit tangent in the meridian plane, and a general tangential direction.
const Vector3<double> meridian(-normal[2], 0, normal[0]);
Vector3<double> tangential(double along, double around)
{
  return along * meridian + Vector3<double>(0, around, 0);
}

Eigen::Matrix<double, 3, 10> jacobian(const Vector10 &x, const Law &law, bool on_axis = false)
{
  Eigen::Matrix<Dual<10>, 10, 1> dual;
  for (int i = 0; i < 10; ++i) dual[i] = Dual<10>::seed(x[i], i);
  const auto C = contact_condition<Dual<10>>(unpack<Dual<10>>(dual), scale, law, on_axis).residual;
  Eigen::Matrix<double, 3, 10> J;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 10; ++j) J(i, j) = C[i].d[j];
  return J;
}

void expect_derivative(const Vector10 &x, const Law &law, ContactStatus status, bool on_axis = false)
{
  const auto condition = [&](const Vector10 &at) {
    return contact_condition<double>(unpack<double>(at), scale, law, on_axis);
  };
  ASSERT_EQ(condition(x).status, status);
  const auto J = jacobian(x, law, on_axis);
  const double h = 1e-5;
  for (int j = 0; j < 10; ++j) {
    const Vector10 step = h * Vector10::Unit(j);
    ASSERT_EQ(condition(x + step).status, status);
    ASSERT_EQ(condition(x - step).status, status);
    const Vector3<double> difference =
        (condition(x + step).residual - condition(x - step).residual) / (2 * h);
    EXPECT_LT((J.col(j) - difference).norm(), 1e-8 * (1 + J.norm())) << "column " << j;
  }
}

TEST(ContactCondition, DerivativeInEveryStatusForEveryLaw)
{
  const Vector3<double> pressure = -1.7 * normal;
  for (const Law &law : {viscous, coulomb, mixed, weakening, frictionless}) {
    expect_derivative(pack(pressure + tangential(0.3, -0.2), 2.1, tangential(0.4, 0.7)), law,
                      ContactStatus::open);
    expect_derivative(pack(pressure + tangential(0.9, -1.2), 0.03, tangential(-0.8, 1.7)), law,
                      ContactStatus::slip);
    expect_derivative(pack(pressure + tangential(0.9, -1.2), -0.3, tangential(-0.8, 1.7)), law,
                      ContactStatus::slip);
    expect_derivative(pack(pressure + tangential(0.3, -0.2), -0.1, tangential(0.4, 0.7)), law,
                      ContactStatus::stick, true);
  }
  for (const Law &law : {coulomb, mixed, weakening})
    expect_derivative(pack(pressure + tangential(0.11, -0.2), -0.03, tangential(0.04, 0.07)), law,
                      ContactStatus::stick);
}

TEST(ContactCondition, IsZeroAtAnalyticSolutions)
{
  const auto norm_of_C = [](const Vector10 &x, const Law &law, ContactStatus status) {
    const auto C = contact_condition<double>(unpack<double>(x), scale, law);
    EXPECT_EQ(C.status, status);
    return C.residual.norm();
  };
  const Vector3<double> none = Vector3<double>::Zero(), v = tangential(0.4, 1.1);
  const double p = 1.7, speed = v.norm();
  EXPECT_EQ(norm_of_C(pack(none, 0.8, v), mixed, ContactStatus::open), 0);
  EXPECT_LT(norm_of_C(pack(-p * normal + tangential(0.1, 0.3), 0, none), mixed, ContactStatus::stick), 1e-16);
  for (const Law &law : {viscous, coulomb, mixed, weakening}) {
    const double tau = law.coefficient(speed, p) * p;
    EXPECT_LT(norm_of_C(pack(-p * normal - tau / speed * v, 0, v), law, ContactStatus::slip), 1e-15);
    const Vector10 pushing = pack(-p * normal + tau / speed * v, 0, v);
    EXPECT_GT(contact_condition<double>(unpack<double>(pushing), scale, law).residual.norm(), tau);
  }
  // weakening faster than c_T: the slip solution must still be one
  const Law steep{{0.29, -0.11}, {0, 1}};
  ASSERT_GT(0.11 * 20 * p, scale.tangential);
  const double tau = steep.coefficient(speed, 20 * p) * 20 * p;
  EXPECT_LT(norm_of_C(pack(-20 * p * normal - tau / speed * v, 0, v), steep, ContactStatus::slip), 1e-14);
  const Vector3<double> down(0, 0, -1);
  EXPECT_EQ(norm_of_C(pack(-p * down, 0, none, down), frictionless, ContactStatus::stick), 0);
}

TEST(ContactCondition, NormalVelocityDoesNotRub)
{
  const Vector3<double> multiplier = -1.7 * normal + tangential(0.2, -0.3), v = tangential(0.4, 1.1);
  const auto C = [&](const Vector3<double> &velocity) {
    return contact_condition<double>(unpack<double>(pack(multiplier, -0.1, velocity)), scale, mixed).residual;
  };
  EXPECT_LT((C(v) - C(v + 3.3 * normal)).norm(), 1e-15);
}

TEST(ContactCondition, FirstTouchFeelsFrictionThroughThePenetration)
{
  // just penetrated, no multiplier yet: a small slip increment sticks, a large one slips with strength mu c_N
  // |g|
  const Vector3<double> none = Vector3<double>::Zero();
  const double g = -0.02, b = 0.29 * scale.normal * 0.02;
  const auto small =
      contact_condition<double>(unpack<double>(pack(none, g, tangential(0, 0.001))), scale, coulomb);
  EXPECT_EQ(small.status, ContactStatus::stick);
  EXPECT_NEAR(small.residual[1], scale.tangential * 0.001, 1e-17);
  const auto large =
      contact_condition<double>(unpack<double>(pack(none, g, tangential(0, 5))), scale, coulomb);
  EXPECT_EQ(large.status, ContactStatus::slip);
  EXPECT_NEAR(large.residual[1], b, 1e-16);
}

TEST(ContactCondition, TiesHaveFiniteDerivativesAndNoEmptyRow)
{
  const Vector3<double> none = Vector3<double>::Zero();
  for (const Law &law : {viscous, coulomb, mixed, frictionless, Law{{0.4}, {1.3}}})
    for (const Vector10 &x : {pack(none, 0, none), pack(none, -0.1, none), pack(-1.7 * normal, 0, none),
                              pack(none, 0, tangential(0.2, 0.1)), pack(none, 0, tangential(1e-200, 0))}) {
      const auto C = contact_condition<double>(unpack<double>(x), scale, law);
      EXPECT_NE(C.status, ContactStatus::open); // lambda_N = c_N g counts as closed
      const auto J = jacobian(x, law);
      EXPECT_TRUE(J.allFinite()) << J;
      Eigen::Matrix<double, 3, 7> columns; // multiplier, gap, velocity: one of them must answer to every row
      columns << J.leftCols<7>();
      EXPECT_EQ(columns.fullPivLu().rank(), 3);
    }
}

TEST(ContactCondition, AtRestWithoutLoadTheTangentialRowIsTheMultiplier)
{
  const Vector3<double> none = Vector3<double>::Zero();
  const auto J = jacobian(pack(none, 0, none), coulomb);
  EXPECT_EQ(J(1, 1), 1); // d C_theta / d lambda_theta
  EXPECT_EQ(J(1, 5), 0); // not yet a stick row
}

TEST(ContactCondition, SlipLimitIsContinuous)
{
  // |s| = b exactly, and from both sides
  const Vector3<double> down(0, 0, -1);
  const double p = 1.7, b = coulomb.threshold(p);
  for (double factor : {1 - 1e-9, 1.0, 1 + 1e-9}) {
    const Vector10 x = pack({0, factor * b, p}, 0, Vector3<double>::Zero(), down);
    const auto C = contact_condition<double>(unpack<double>(x), scale, coulomb);
    EXPECT_LT(C.residual.norm(), 1e-9);
    EXPECT_EQ(C.status, factor > 1 ? ContactStatus::slip : ContactStatus::stick);
  }
}

/// One node on springs: lambda_T = k u, v = u shift + V, prescribed pressure; Newton from rest.
int newton_iterations(const Law &law, double k, double shift, const Vector3<double> &V, double p, double c_T)
{
  const Vector3<double> down(0, 0, -1);
  Vector3<double> u = Vector3<double>::Zero();
  Vector3<double> lambda(0, 0, p);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vector3<double> v = shift * u + V;
    ContactPoint<Dual<4>> at{lambda.cast<Dual<4>>(), down.cast<Dual<4>>(), 0, v.cast<Dual<4>>()};
    for (int i = 0; i < 2; ++i) {
      at.multiplier[i] = Dual<4>::seed(lambda[i], i);
      at.velocity[i] = Dual<4>::seed(v[i], 2 + i);
    }
    const auto C = contact_condition<Dual<4>>(at, {scale.normal, c_T}, law).residual;
    Eigen::Vector2d residual;
    Eigen::Matrix2d J; // with respect to u, lambda = k u eliminated
    for (int i = 0; i < 2; ++i) {
      residual[i] = C[i].v;
      for (int j = 0; j < 2; ++j) J(i, j) = k * C[i].d[j] + shift * C[i].d[2 + j];
    }
    if (residual.norm() <= 1e-11 * (p + k * V.norm() / shift)) return iteration;
    u.head<2>() -= J.inverse() * residual;
    lambda.head<2>() = k * u.head<2>();
  }
  return 60;
}

TEST(ContactCondition, NewtonFindsStickAndSlipFromRest)
{
  std::mt19937 random(7);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
  };
  int worst = 0;
  for (double exponent : {1.0, 2.0, 2.5})
    for (int trial = 0; trial < 1000; ++trial) {
      const double k = decades(-1, 1), shift = decades(-2, 2), b0 = decades(-3, 0), c_T = 2 * k / shift;
      const Vector3<double> V(decades(-2, 1), -decades(-2, 1), 0);
      const double b1 =
          decades(-4, 4) * c_T / std::pow(V.norm(), exponent - 1); // drag over c_T from 1e-4 to 1e4
      worst = std::max(worst, newton_iterations({{b0, b1}, {0, exponent}}, k, shift, V, 1.3, c_T));
    }
  EXPECT_LT(worst, 30);
  RecordProperty("most_iterations", worst);
}

TEST(ContactCondition, OnTheAxisTangentialTractionVanishes)
{
  const Vector3<double> down(0, 0, -1), multiplier(0.3, -0.4, 1.7);
  const auto C = contact_condition<double>(unpack<double>(pack(multiplier, -0.2, {0.1, 0.2, 0.3}, down)),
                                           scale, mixed, true);
  EXPECT_EQ(C.residual[0], 0.3);
  EXPECT_EQ(C.residual[1], -0.4);
  EXPECT_DOUBLE_EQ(C.residual[2], scale.normal * -0.2);
}

TEST(ContactCondition, NotANumberIsNotSilentlyOpen)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto C = contact_condition<double>(
      unpack<double>(pack(Vector3<double>::Zero(), nan, Vector3<double>::Zero())), scale, mixed);
  EXPECT_TRUE(C.residual.hasNaN());
}

TEST(RobustNorm, NeitherOverflowsNorUnderflows)
{
  EXPECT_DOUBLE_EQ(robust_norm(Vector3<double>(3e-200, 4e-200, 0)), 5e-200);
  EXPECT_DOUBLE_EQ(robust_norm(Vector3<double>(3e200, 0, 4e200)), 5e200);
  EXPECT_EQ(robust_norm(Vector3<double>(0, 0, 0)), 0);
}

} // namespace
} // namespace tribogel
