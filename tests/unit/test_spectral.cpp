#include "material_samples.hpp"
#include "matrix_reference.hpp"

#include "tribogel/math/elementary.hpp"
#include "tribogel/math/spectral.hpp"

#include <gtest/gtest.h>

using namespace tribogel;

namespace
{

using D = Dual<1>;

Matrix3<D> with_derivative(const Matrix3<double> &A, const Matrix3<double> &dA)
{
  Matrix3<D> out = A.cast<D>();
  for (int i = 0; i < 9; ++i) out(i).d[0] = dA(i);
  return out;
}

TEST(Elementary, keeps_relative_accuracy_on_both_sides_of_every_case)
{
  for (double x : {1e-120, 1e-20, 1e-9, 1e-4, 0.03, 0.2, 0.4999999, 0.5000001, 0.8, 3.0, -1e-9, -0.3, -0.49,
                   -0.51, -4.0}) {
    const long double y = x, exact_sinhc = std::sinh(y) / y;
    EXPECT_NEAR(static_cast<double>(sinhc(x) / exact_sinhc), 1, 4e-16) << x;
    long double exact = 0, term = y; // exp(x) - 1 - x by its own series, which alternates for x < 0
    for (int k = 2; k < 80; ++k) exact += term *= y / k;
    EXPECT_NEAR(static_cast<double>(exp_minus_tangent(x) / exact), 1, 2e-15) << x;
    EXPECT_NEAR(x_coth(x), static_cast<double>(y / std::tanh(y)), 4e-16 * x_coth(x)) << x;
  }
  EXPECT_EQ(sinhc(0.0), 1);
  EXPECT_EQ(exp_minus_tangent(0.0), 0);
  EXPECT_EQ(x_coth(0), 1);
  for (double x : {0.3, 0.7}) {
    EXPECT_NEAR(sinhc(D::seed(x, 0)).d[0], (x * std::cosh(x) - std::sinh(x)) / (x * x), 1e-14);
    EXPECT_NEAR(exp_minus_tangent(D::seed(x, 0)).d[0], std::expm1(x), 1e-15);
  }
}

TEST(Spectral, axes_and_values_compose_the_tensor)
{
  for (const auto &[name, F] : samples::deformations()) {
    const Matrix3<double> B = F * F.transpose();
    const Spectral<double> s = spectral(B);
    EXPECT_LT((s.axes.transpose() * s.axes - Matrix3<double>::Identity()).norm(), 3e-15) << name;
    EXPECT_LT((isotropic_function<double>(s, s.values, {}) - B).norm(), 4e-15 * B.norm()) << name;
    EXPECT_EQ(s.shears.norm(), 0) << name;
  }
}

// The square has the divided difference x + y, so that both sides are known without any spectral theory.
TEST(Spectral, derivative_of_an_isotropic_function_is_exact_at_coalescing_eigenvalues)
{
  for (const auto &[name, F] : samples::deformations()) {
    const Matrix3<double> B = F * F.transpose(), dB = samples::symmetric_noise(21);
    const Spectral<D> s = spectral(with_derivative(B, dB));
    const Vector3<D> square = s.values.cwiseProduct(s.values);
    Vector3<double> divided;
    for (int k = 0; k < 3; ++k) divided[k] = s.values[pair_index[k][0]].v + s.values[pair_index[k][1]].v;
    const Matrix3<D> f = isotropic_function(s, square, divided);
    EXPECT_LT((value(f) - B * B).norm(), 4e-15 * B.squaredNorm()) << name;
    EXPECT_LT((derivative(f, 0) - (B * dB + dB * B)).norm(), 1e-14 * B.norm() * dB.norm()) << name;
  }
}

TEST(Spectral, logarithmic_strain_and_its_derivative_are_those_of_the_matrix_logarithm)
{
  for (const auto &[name, F] : samples::deformations()) {
    const Matrix3<double> B = F * F.transpose(), dB = samples::symmetric_noise(22);
    const Matrix3<D> dual = with_derivative(B, dB);
    const Spectral<D> s = log_strain(dual, D(0.5 * log(dual.determinant())));
    const Matrix3<D> strain = isotropic_function(s, s.values, Vector3<double>::Ones());
    const reference::Matrix exact =
        reference::logarithm(reference::lift(B) +
                             reference::Complex(0, reference::tiny) * reference::lift(dB)) /
        2.0L;
    EXPECT_LT((value(strain) - exact.real().cast<double>()).norm(), 5e-15) << name;
    EXPECT_LT((derivative(strain, 0) - reference::derivative(exact)).norm(), 1e-13) << name;
  }
}

TEST(Spectral, a_tensor_that_is_not_positive_definite_has_no_finite_logarithm)
{
  for (const Vector3<double> &x : {Vector3<double>(2, -0.3, 1.4), Vector3<double>(2, 0, 1.4)})
    EXPECT_FALSE(
        log_strain<double>(x.asDiagonal().toDenseMatrix(), 0.5 * std::log(x.prod())).values.allFinite());
}

TEST(Spectral, mandel_rotation_turns_tensors_and_preserves_contractions)
{
  const Matrix3<double> Q = samples::rotation(31), S = samples::symmetric_noise(32);
  const Mandel4<double> R = mandel_rotation(Q);
  EXPECT_LT((R.transpose() * R - Mandel4<double>::Identity()).norm(), 3e-15);
  EXPECT_LT((R * to_mandel(S) - to_mandel<double>(Q * S * Q.transpose())).norm(), 1e-15);
  EXPECT_LT((from_mandel<double>(to_mandel(S)) - S).norm(), 1e-16);
  EXPECT_NEAR(to_mandel(S).squaredNorm(), S.squaredNorm(), 1e-15);
}

} // namespace
