#include "matrix_reference.hpp"

#include <stdexcept>

namespace reference
{

namespace
{

Real largest(const Matrix &A)
{
  return A.cwiseAbs().maxCoeff();
}

/// Denman and Beavers.
Matrix square_root(const Matrix &A)
{
  Matrix Y = A, Z = Matrix::Identity();
  for (int i = 0; i < 40; ++i) {
    const Matrix next = (Y + Z.inverse()) / Real(2);
    Z = ((Z + Y.inverse()) / Real(2)).eval();
    const Real change = largest(next - Y);
    Y = next;
    if (change < 1e-17L && i > 2) break;
  }
  return Y;
}

Matrix real_part(const Matrix &A)
{
  return A.real().cast<Complex>();
}

} // namespace

/// Inverse scaling and squaring, log A = 2 artanh((A - 1)(A + 1)^-1).
Matrix logarithm(Matrix A)
{
  const Matrix one = Matrix::Identity();
  Real factor = 2;
  for (; largest(A - one) > 0.05L; factor *= 2) A = square_root(A);
  const Matrix Y = (A - one) * (A + one).inverse(), Y2 = Y * Y;
  Matrix power = Y, sum = Y;
  for (int k = 3; k < 30; k += 2) {
    power = (power * Y2).eval();
    sum += power / Real(k);
  }
  return factor * sum;
}

/// Scaling and squaring.
Matrix exponential(Matrix A)
{
  int squarings = 0;
  for (; largest(A) > 0.1L; ++squarings) A /= Real(2);
  Matrix term = Matrix::Identity(), sum = term;
  for (int k = 1; k < 25; ++k) {
    term = (term * A).eval() / Real(k);
    sum += term;
  }
  for (; squarings > 0; --squarings) sum = (sum * sum).eval();
  return sum;
}

Matrix unit_strain(int k)
{
  const int i = tribogel::mandel_index[k][0], j = tribogel::mandel_index[k][1];
  Matrix E = Matrix::Zero();
  E(i, j) = E(j, i) = 1;
  return E;
}

Matrix deviator(const Matrix &A)
{
  return A - A.trace() / Real(3) * Matrix::Identity();
}

Matrix Spring::stress(const Matrix &strain) const
{
  const Complex J = std::exp(strain.trace());
  const Complex mean = quadratic ? (J - Real(1)) * J : Real(0.5) * (J * J - Real(1));
  Matrix tau = bulk_modulus * mean * Matrix::Identity();
  for (std::size_t r = 0; r < moduli.size(); ++r)
    tau += moduli[r] * deviator(exponential(exponents[r] * deviator(strain)));
  return tau;
}

Complex Spring::energy(const Matrix &strain) const
{
  const Complex theta = strain.trace();
  const Complex J = std::exp(theta);
  Complex W = bulk_modulus * (quadratic ? Real(0.5) * (J - Real(1)) * (J - Real(1))
                                        : Real(0.25) * (J * J - Real(2) * theta - Real(1)));
  for (std::size_t r = 0; r < moduli.size(); ++r)
    W += moduli[r] / exponents[r] * (exponential(exponents[r] * deviator(strain)).trace() - Real(3));
  return W;
}

Matrix Branch::flow(const Matrix &tau) const
{
  return deviator(tau) / (Real(2) * deviatoric_viscosity) +
         tau.trace() / (Real(9) * volumetric_viscosity) * Matrix::Identity();
}

Matrix Branch::relax(const Matrix &trial, Real step) const
{
  using Vector6 = Eigen::Matrix<Complex, 6, 1>;
  const auto residual = [&](const Matrix &x, const Matrix &target) {
    const Matrix r = x + step * flow(spring.stress(x)) - target;
    Vector6 v;
    for (int k = 0; k < 6; ++k) v[k] = r(tribogel::mandel_index[k][0], tribogel::mandel_index[k][1]);
    return v;
  };
  Matrix x = real_part(trial);
  Real change = 1;
  for (int i = 0; i < 200; ++i) {
    const bool real = change > 1e-14L;
    Eigen::Matrix<Real, 6, 6> jacobian;
    const Vector6 base = residual(real_part(x), trial); // its imaginary part is that of trial and parameters
    for (int k = 0; k < 6; ++k)
      jacobian.col(k) =
          (residual(real_part(x) + Complex(0, tiny) * unit_strain(k), trial) - base).imag() / tiny;
    const auto solver = jacobian.partialPivLu();
    for (int repeat = 0; repeat < (real ? 1 : 4); ++repeat) {
      const Vector6 r = residual(x, trial);
      Vector6 dx;
      dx.real() = solver.solve(r.real());
      dx.imag() = real ? Eigen::Matrix<Real, 6, 1>::Zero().eval() : solver.solve(r.imag()).eval();
      Matrix next = x;
      for (Real scale = 1; scale > 1e-6L; scale /= 2) {
        next = x;
        for (int k = 0; k < 6; ++k) next -= scale * dx[k] * unit_strain(k);
        if (!real || change < 1e-6L || residual(next, trial).real().norm() < r.real().norm()) break;
      }
      change = (next - x).real().cwiseAbs().maxCoeff();
      x = next;
    }
    if (!real) return x;
  }
  throw std::runtime_error("the reference's local problem did not converge");
}

State Law::evaluate(const Matrix &F, const std::vector<Matrix> &history, Real step) const
{
  State out;
  const Matrix strain = logarithm(F * F.transpose()) / Real(2), inverse = F.inverse();
  out.energy = equilibrium.energy(strain);
  out.tau = equilibrium.stress(strain);
  for (std::size_t m = 0; m < branches.size(); ++m) {
    const Matrix trial = logarithm(F * history[m] * F.transpose()) / Real(2);
    const Matrix elastic = branches[m].relax(trial, step), tau = branches[m].spring.stress(elastic);
    out.energy += branches[m].spring.energy(elastic);
    out.dissipated += step * tau.cwiseProduct(branches[m].flow(tau)).sum();
    out.tau += tau;
    out.history.push_back(inverse * exponential(Real(2) * elastic) * inverse.transpose());
  }
  return out;
}

Spring spring(const tribogel::Ogden<double> &o)
{
  return {{o.moduli.begin(), o.moduli.end()},
          {o.exponents.begin(), o.exponents.end()},
          o.bulk_modulus,
          o.volumetric_law == tribogel::VolumetricLaw::quadratic};
}

Law law(const tribogel::Viscoelastic<double> &material)
{
  Law out{spring(material.equilibrium), {}};
  for (const auto &b : material.branches)
    out.branches.push_back({spring(b.spring), b.deviatoric_viscosity, b.volumetric_viscosity});
  return out;
}

Matrix lift(const tribogel::Matrix3<double> &A)
{
  return A.cast<Complex>();
}

std::vector<Matrix> lift_history(const std::vector<double> &history)
{
  std::vector<Matrix> out;
  for (std::size_t i = 0; i < history.size(); i += 6)
    out.push_back(
        lift(tribogel::from_mandel<double>(Eigen::Map<const tribogel::Mandel<double>>(&history[i]))));
  return out;
}

} // namespace reference
