/// The multiplier's dual basis: biorthogonal, adds up to one, and the vanishing axis weight of quadratic
/// facets.
#include "tribogel/contact/curve/facet.hpp"

#include <gtest/gtest.h>

namespace tribogel
{
namespace
{

/// int psi_a N_b w by a rule much finer than the one that built the basis.
template <int nodes> Eigen::Matrix<double, nodes, nodes> coupling(const FacetMeasure<nodes> &facet)
{
  static const auto rule = gauss_rule<12>();
  Eigen::Matrix<double, nodes, nodes> integral = Eigen::Matrix<double, nodes, nodes>::Zero();
  for (int q = 0; q < 12; ++q) {
    const auto N = facet_shape<nodes>(rule.point[q]).N;
    const auto psi = facet.basis(N);
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b)
        integral(a, b) += rule.weight[q] * psi[a] * N[b] * facet.weight(N, rule.point[q]);
  }
  return integral;
}

template <int nodes> void expect_biorthogonal(const FacetPoints<nodes, double> &X)
{
  const auto facet = facet_measure<nodes>(X);
  double area = 0;
  for (double D : facet.basis.D) area += D;
  const auto integral = coupling(facet);
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b) EXPECT_NEAR(integral(a, b), a == b ? facet.basis.D[a] : 0, 1e-13 * area);
  for (double xi : {-1.0, -0.37, 0.11, 0.83}) {
    double sum = 0;
    for (double psi : facet.basis(facet_shape<nodes>(xi).N)) sum += psi;
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

TEST(DualBasis, IsBiorthogonalAndAddsUpToOne)
{
  expect_biorthogonal<2>({{{1.3, 0.2}, {2.1, 0.4}}});
  expect_biorthogonal<2>({{{0, 0.2}, {0.7, 0.2}}});                 // touches the axis
  expect_biorthogonal<3>({{{1.3, 0.2}, {2.1, 0.4}, {1.75, 0.37}}}); // curved, midside node off the middle
  expect_biorthogonal<3>({{{1.3, 0.2}, {2.1, 0.2}, {1.7, 0.2}}});
  expect_biorthogonal<3>({{{0, 0.2}, {0.7, 0.2}, {0.35, 0.2}}}); // touches the axis: its psi is zero
}

TEST(DualBasis, QuadraticAxisNodeHasExactlyNoWeight)
{
  for (double h : {0.7, 0.1, 3.3e-5}) {
    const auto facet = facet_measure<3>({{{0, -0.3}, {h, -0.3}, {0.5 * h, -0.3}}});
    EXPECT_EQ(facet.basis.D[0], 0);
    for (int b = 0; b < 3; ++b) EXPECT_EQ(facet.basis.A(0, b), 0);
    EXPECT_NEAR(facet.basis.D[1], std::numbers::pi / 3 * h * h,
                1e-15 * h * h); // 2 pi h R / 6 at the outer end
    EXPECT_NEAR(facet.basis.D[2], 2 * std::numbers::pi / 3 * h * h,
                1e-15 * h * h); // 2 pi h (0 + h) / 3 at midside
    EXPECT_GT(facet.extent[0], 0);
  }
}

TEST(DualBasis, WeightsAwayFromTheAxisArePositiveAndExact)
{
  const double R0 = 1.3, R1 = 2.1, h = R1 - R0, pi = std::numbers::pi;
  const auto linear = facet_measure<2>({{{R0, 0}, {R1, 0}}});
  EXPECT_NEAR(linear.basis.D[0], 2 * pi * h * (2 * R0 + R1) / 6, 1e-14);
  EXPECT_NEAR(linear.basis.D[1], 2 * pi * h * (R0 + 2 * R1) / 6, 1e-14);
  const auto quadratic = facet_measure<3>({{{R0, 0}, {R1, 0}, {0.5 * (R0 + R1), 0}}});
  EXPECT_NEAR(quadratic.basis.D[0], 2 * pi * h * R0 / 6, 1e-14);
  EXPECT_NEAR(quadratic.basis.D[1], 2 * pi * h * R1 / 6, 1e-14);
  EXPECT_NEAR(quadratic.basis.D[2], 2 * pi * h * (R0 + R1) / 3, 1e-14);
}

TEST(DualBasis, OfAnyDimensionNeedsOnlyTheTwoIntegrals)
{
  // a bilinear facet of a 3-D surface, unit weight on [-1, 1]^2: the tensor product of the 1-D masses
  const Eigen::Matrix2d line{{2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}};
  Eigen::Matrix4d mass;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) mass(a, b) = line(a % 2, b % 2) * line(a / 2, b / 2);
  const auto basis = dual_basis<4>({1, 1, 1, 1}, mass);
  EXPECT_LT((basis.A * mass - Eigen::Matrix4d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(basis.A(0, 0), 4, 1e-13); // the textbook 4, -2, -2, 1
  EXPECT_NEAR(basis.A(0, 3), 1, 1e-13);
}

TEST(FacetMeasure, LengthAndAreaOfACurvedFacetConverge)
{
  // arc of a sphere of radius 2: area 2 pi 4 (cos t0 - cos t1)
  const double t0 = 0.3;
  double last = 0;
  for (double dt : {0.4, 0.2}) {
    const auto at = [](double t) { return PlanePoint<double>{2 * std::sin(t), -2 * std::cos(t)}; };
    const auto facet = facet_measure<3>({{at(t0), at(t0 + dt), at(t0 + dt / 2)}});
    const double area = 2 * std::numbers::pi * 4 * (std::cos(t0) - std::cos(t0 + dt));
    double D = 0;
    for (double d : facet.basis.D) D += d;
    const double error = std::abs(D / area - 1);
    EXPECT_LT(error, 1e-4);
    EXPECT_NEAR(facet.length, 2 * dt, 1e-4 * dt);
    EXPECT_TRUE(last == 0 || last / error > 12) << last / error; // fourth order
    last = error;
  }
}

} // namespace
} // namespace tribogel
