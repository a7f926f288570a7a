/// The bulk law once more, for the tests: tensors instead of principal values, matrix functions by series and
/// square roots instead of eigenvectors, complex long double instead of dual numbers. Nothing is shared with
/// the code under test but the parameters, so that eigenvalues may coincide without being a special case
/// anywhere.
///
/// Every function is analytic: f(x + i h y) with a tiny h has the exact directional derivative in its
/// imaginary part.
#pragma once

#include "tribogel/material/viscoelastic.hpp"

#include <complex>
#include <vector>

namespace reference
{

using Real = long double;
using Complex = std::complex<Real>;
using Matrix = Eigen::Matrix<Complex, 3, 3>;

constexpr Real tiny = 1e-40L; ///< of complex steps

Matrix logarithm(Matrix A);
Matrix exponential(Matrix A);
Matrix deviator(const Matrix &A);
Matrix unit_strain(int k); ///< both off-diagonal entries 1

struct Spring {
  std::vector<Complex> moduli, exponents;
  Complex bulk_modulus;
  bool quadratic = false; ///< volumetric energy K/2 (J - 1)^2 instead of K/4 (J^2 - 2 ln J - 1)

  /// From the logarithmic strain tensor.
  Matrix stress(const Matrix &strain) const;
  Complex energy(const Matrix &strain) const;
};

struct Branch {
  Spring spring;
  Complex deviatoric_viscosity, volumetric_viscosity;

  /// V^-1 : tau.
  Matrix flow(const Matrix &tau) const;

  /// strain + step V^-1 : tau(strain) = trial, by Newton's method on six unknowns: first the real part, then
  /// the whole with the Jacobian of the last real iterate, which is enough for the infinitesimal imaginary
  /// part.
  Matrix relax(const Matrix &trial, Real step) const;
};

/// What Viscoelastic::evaluate returns, and the new history as tensors.
struct State {
  Complex energy = 0, dissipated = 0;
  Matrix tau = Matrix::Zero();
  std::vector<Matrix> history;
};

struct Law {
  Spring equilibrium;
  std::vector<Branch> branches;

  State evaluate(const Matrix &F, const std::vector<Matrix> &history, Real step) const;
};

Spring spring(const tribogel::Ogden<double> &o);
Law law(const tribogel::Viscoelastic<double> &material);

/// The derivative carried by a complex step, as doubles.
template <class Derived> auto derivative(const Eigen::MatrixBase<Derived> &A)
{
  return (A.imag() / tiny).template cast<double>().eval();
}
inline double derivative(const Complex &x)
{
  return static_cast<double>(x.imag() / tiny);
}

Matrix lift(const tribogel::Matrix3<double> &A);

/// Levels of history, Mandel components of a tensor for each branch.
std::vector<Matrix> lift_history(const std::vector<double> &history);

} // namespace reference
