/// Ogden's hyperelastic law in principal logarithmic strains.
#pragma once

#include "tribogel/math/elementary.hpp"
#include "tribogel/math/spectral.hpp"
#include "tribogel/math/tensor.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace tribogel
{

/// The deviatoric response to the deviatoric strains e_a (sum zero). S is a scalar.
template <class S> struct DeviatoricStress {
  /// Deviatoric principal Kirchhoff stresses [MPa].
  Vector3<S> tau = Vector3<S>::Zero();
  /// D: d tau/d e = P diag(D) P with P = 1 - (1 1^T)/3 [MPa], THEORY (1.6).
  Vector3<S> stiffness = Vector3<S>::Zero();
  /// (tau_a - tau_b)/(e_a - e_b) by pair_index, also where e_a = e_b [MPa], THEORY (1.7).
  Vector3<S> secant = Vector3<S>::Zero();
};

/// The volumetric response to theta = ln J. S is a scalar.
template <class S> struct VolumetricStress {
  S mean = 0; ///< mean Kirchhoff stress [MPa]
  S bulk = 0; ///< d mean/d theta [MPa]
};

/// The volumetric energy: K/4 (J^2 - 2 ln J - 1), the paper's, or K/2 (J - 1)^2, that of many other programs.
/// The latter's mean Kirchhoff stress has a minimum at J = 1/2 and vanishes at J = 0.
enum class VolumetricLaw { logarithmic, quadratic };

/// Ogden energy with any number of terms and a volumetric part, the paper's (3.6) and (3.7). With the
/// principal logarithmic strains eps_a = ln lambda_a, theta = ln J = sum eps_a and e_a = eps_a - theta/3 it
/// is, per reference volume,
///
///   W = sum_r G_r/alpha_r sum_a (exp(alpha_r e_a) - 1) + K/4 (J^2 - 2 ln J - 1)        THEORY (1.4)
///
/// or with K/2 (J - 1)^2 as its volumetric part, THEORY (1.8a).
/// T is the scalar of the parameters, double, Dual<N> or Lanes. Exponents are not zero; a modulus may have
/// any sign.
template <class T> struct Ogden {
  std::vector<T> moduli;    ///< G_r [MPa]
  std::vector<T> exponents; ///< alpha_r, as many
  T bulk_modulus;           ///< K [MPa]
  VolumetricLaw volumetric_law = VolumetricLaw::logarithmic;

  /// At small strain [MPa].
  T shear_modulus() const
  {
    T sum = 0;
    for (std::size_t r = 0; r < moduli.size(); ++r) sum += 0.5 * moduli[r] * exponents[r];
    return sum;
  }

  template <class U> Ogden<U> cast() const
  {
    return {std::vector<U>(moduli.begin(), moduli.end()), std::vector<U>(exponents.begin(), exponents.end()),
            U(bulk_modulus), volumetric_law};
  }

  /// From the deviatoric principal strains. The stress is built from the secants, so that it keeps its
  /// relative accuracy however small the strains are.
  template <class S> DeviatoricStress<S> deviatoric(const Vector3<S> &e) const
  {
    using std::abs, std::exp;
    DeviatoricStress<S> out;
    const Vector3<S> gap = pair_differences(e);
    for (std::size_t r = 0; r < moduli.size(); ++r) {
      const S alpha = as_scalar<S>(exponents[r]), g = as_scalar<S>(moduli[r]) * alpha;
      Vector3<S> h; // exp(alpha e_a/2): one exponential serves both the powers and their divided differences
      for (int a = 0; a < 3; ++a) h[a] = exp(0.5 * alpha * e[a]);
      for (int a = 0; a < 3; ++a) out.stiffness[a] += g * h[a] * h[a];
      for (int k = 0; k < 3; ++k) {
        const S &p = h[pair_index[k][0]], &q = h[pair_index[k][1]];
        const S x = 0.5 * alpha * gap[k];
        // p q sinhc(x); beyond 1/2 the difference of the powers has nothing left to cancel
        const auto near = [&]() -> S { return p * q * sinhc_series(x); };
        const auto far = [&]() -> S { return (p * p - q * q) / (2 * x); };
        out.secant[k] += g * choose(abs(value(x)) < 0.5, near, far);
      }
    }
    const Vector3<S> jump = out.secant.cwiseProduct(gap) / 3; // (tau_a - tau_b)/3
    out.tau << jump[2] + jump[1], jump[0] - jump[2], -jump[1] - jump[0];
    return out;
  }

  /// From theta = ln J.
  template <class S> VolumetricStress<S> volumetric(const S &theta) const
  {
    using std::expm1;
    const S K = as_scalar<S>(bulk_modulus);
    if (volumetric_law == VolumetricLaw::quadratic) {
      const S growth = expm1(theta), J = 1 + growth;
      return {K * J * growth, K * J * (J + growth)};
    }
    const S excess = expm1(2 * theta); // J^2 - 1
    return {0.5 * K * excess, K * (1 + excess)};
  }

  /// W per reference volume [MPa]: both parts, from the deviatoric strains and theta. Accurate down to
  /// vanishing strains: the terms linear in the strain, which cancel, are left out.
  T energy(const Vector3<T> &e, const T &theta) const
  {
    T W = volumetric_energy(theta);
    for (std::size_t r = 0; r < moduli.size(); ++r)
      for (int a = 0; a < 3; ++a) W += moduli[r] / exponents[r] * exp_minus_tangent(T(exponents[r] * e[a]));
    return W;
  }

  /// U of theta = ln J [MPa].
  T volumetric_energy(const T &theta) const
  {
    using std::expm1;
    if (volumetric_law == VolumetricLaw::logarithmic)
      return 0.25 * bulk_modulus * exp_minus_tangent(T(2 * theta));
    const T growth = expm1(theta); // J - 1
    return 0.5 * bulk_modulus * growth * growth;
  }

  /// e_a - e_b by pair_index.
  template <class S> static Vector3<S> pair_differences(const Vector3<S> &e)
  {
    return {e[1] - e[2], e[0] - e[2], e[0] - e[1]};
  }
};

} // namespace tribogel
