/// What a node of the interface gives to the condensed system (THEORY 3.8), on a system of that node alone,
///
///     K u + D l = f,    H u + Z l = c,
///
/// where nothing is left out: the condensed solution is that of the whole.
#include "linear/interface_node.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <string>

namespace tribogel::test
{

namespace
{

using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

/// Blocks of a node that touches with weight d in some state. Its normal is the last axis before all turns.
struct TouchingNode {
  Matrix D, H, Z;
};

TouchingNode touching(const char *state, double d)
{
  const Matrix one = Matrix::Identity(), normal = Vector(0, 0, 1).asDiagonal(), tangential = one - normal;
  const std::string name = state;
  if (name == "open") return {d * one, Matrix::Zero(), one};
  if (name == "sticking") return {d * one, d * one, Matrix::Zero()};
  if (name == "frictionless") return {d * one, d * normal, tangential};
  if (name == "at a plate") return {d * normal, d * normal, tangential};
  Matrix Z = tangential,
         H = d * normal; // Coulomb's: along the slip the pressure's part, across it the slip's direction
  Z(0, 2) = -0.3;
  H(1, 1) = 2 / std::abs(d); // beside a stiffness of about 4 neither held nor free
  return {d * one, H, Z};
}

/// The largest error of the condensed solution, relative to the solution.
double error_of(const TouchingNode &touch, std::mt19937 &random)
{
  std::uniform_real_distribution<double> number(-1, 1);
  const auto any = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(random); }));
  };
  const auto turn = [&] { return Matrix(Eigen::HouseholderQR<Matrix>(any(3, 3)).householderQ()); };
  const Matrix Q = turn(), mix = turn(), part = any(3, 3);
  InterfaceNode node;
  node.slave = 0;
  node.multiplier = 3;
  node.K = part * part.transpose() + 3 * Matrix::Identity();
  node.D = Q * touch.D * Q.transpose();
  node.H = mix * touch.H * Q.transpose();
  node.Z = mix * touch.Z * Q.transpose();
  node.Classify();

  const Vector f = any(3, 1), c = any(3, 1);
  Eigen::Matrix<double, 6, 6> whole;
  whole << node.K, node.D, node.H, node.Z;
  Eigen::Matrix<double, 6, 1> given, found;
  given << f, c;
  const Eigen::Matrix<double, 6, 1> exact = whole.fullPivLu().solve(given);

  const Matrix equation = node.force * node.K + node.condition * node.H;
  const Matrix S = equation * node.keeps + node.idle;
  const Vector right = node.force * f + node.condition * c - equation * node.holds * c;
  const Vector u = node.keeps * S.fullPivLu().solve(right) + node.holds * c;
  Vector l = node.D_inverse * (f - node.K * u);
  l += node.alone * (c - node.H * u - node.Z * l);
  found << u, l;
  return (found - exact).norm() / exact.norm();
}

} // namespace

/// Weights of any size: products like D^-1 D are one to round-off only, and which do depends on the last
/// digits.
TEST(interface_node, LosesNothingOfItsOwn)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-3, 3);
  for (const char *state : {"open", "sticking", "frictionless", "Coulomb", "at a plate"})
    for (int k = 0; k < 500; ++k) {
      const double d = -std::pow(10, exponent(random));
      ASSERT_LE(error_of(touching(state, d), random), 1e-9) << state << ", D = " << d << ", number " << k;
    }
}

/// A multiplier that acts has no part of its own, not even one of round-off's making.
TEST(interface_node, ARegularWeightLeavesNoMultiplierAlone)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(1, 2);
  for (int k = 0; k < 1000; ++k) {
    InterfaceNode node;
    const TouchingNode touch = touching("Coulomb", -number(random));
    node.K = 40 * Matrix::Identity();
    node.D = touch.D;
    node.H = touch.H;
    node.Z = touch.Z;
    node.Classify();
    ASSERT_TRUE(node.alone.isZero(0)) << "D = " << touch.D(0, 0);
  }
}

} // namespace tribogel::test
