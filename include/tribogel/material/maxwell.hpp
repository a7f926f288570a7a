/// Maxwell branch of finite viscoelasticity (Reese and Govindjee 1998; the paper's section 3.2), in principal
/// axes.
#pragma once

#include "tribogel/material/ogden.hpp"
#include "tribogel/material/status.hpp"

#include <cmath>

namespace tribogel
{

/// Outcome of one step of a branch, in the principal axes of the trial strain.
template <class T> struct BranchStep {
  PointStatus status = PointStatus::ok;
  /// Elastic principal logarithmic strains eps_a at the new time.
  Vector3<T> strain = Vector3<T>::Zero();
  /// (eps_a - eps_b)/(trial_a - trial_b) by pair_index, 0 (relaxed) ... 1 (frozen).
  Vector3<Value<T>> strain_ratio = Vector3<Value<T>>::Zero();
  DeviatoricStress<T>
      deviatoric; ///< at the new time; stiffness and secant with respect to the *trial* strains
  VolumetricStress<T> volumetric; ///< the same
  T energy = 0;                   ///< stored, per reference volume [MPa]
  T dissipated = 0;               ///< in this step, per reference volume [MPa], >= 0
};

/// An Ogden spring in series with a dashpot: -1/2 (L_v b_e) b_e^-1 = dev tau/(2 eta_D) + tr tau/(9 eta_V) 1.
/// T is the scalar of the parameters, double, Dual<N> or Lanes.
template <class T> struct MaxwellBranch {
  Ogden<T> spring;
  T deviatoric_viscosity; ///< eta_D [MPa s], > 0
  T volumetric_viscosity; ///< eta_V [MPa s], > 0

  template <class U> MaxwellBranch<U> cast() const
  {
    return {spring.template cast<U>(), U(deviatoric_viscosity), U(volumetric_viscosity)};
  }

  /// One step of the flow rule with the exponential map, THEORY (1.12): the elastic strains eps with
  ///
  ///   eps_a + step [dev tau_a(eps)/(2 eta_D) + tr tau(eps)/(9 eta_V)] = trial_a.
  ///
  /// It falls apart into the deviatoric strains and the volumetric one, because the energy does.
  BranchStep<T> advance(const Vector3<T> &trial, double step) const;

private:
  /// Absolute value.
  template <class V> static V largest(const Vector3<V> &x)
  {
    using std::abs;
    V most = abs(x[0]);
    for (int a = 1; a < 3; ++a) most = where(abs(x[a]) > most, V(abs(x[a])), most);
    return most;
  }

  static constexpr int max_iterations = 60;
  static constexpr double quadratic =
      1e-9; ///< a smaller correction, once applied, leaves nothing but round-off

  bool solve_volumetric(const T &trial, const T &rate, T &theta) const;
  bool solve_deviatoric(const Vector3<T> &trial, const T &rate, Vector3<T> &e) const;

  /// (1 + rate P diag(D) P)^-1 r for a trace-free r, THEORY (1.15).
  template <class S>
  static Vector3<S> correction(const Vector3<Value<T>> &D, const Value<T> &rate, const Vector3<S> &r)
  {
    const Vector3<S> Dr = D.cwiseProduct(r), flow = Dr.array() - Dr.sum() / 3;
    return ((1 + rate * 2 / 3 * D.sum()) * r - rate * flow) / determinant(D, rate);
  }

  /// Second invariant of P diag(D) P.
  template <class S> static S second_invariant(const Vector3<S> &D)
  {
    return (D[0] * D[1] + D[1] * D[2] + D[2] * D[0]) / 3;
  }

  /// Of 1 + rate P diag(D) P.
  template <class S> static S determinant(const Vector3<S> &D, const S &rate)
  {
    return 1 + rate * (2.0 / 3 * D.sum() + rate * second_invariant(D));
  }
};

template <class T> BranchStep<T> MaxwellBranch<T>::advance(const Vector3<T> &trial, double step) const
{
  BranchStep<T> out;
  const T trial_theta = trial.sum();
  using std::isfinite;
  if (!all(isfinite(value(trial_theta)))) return out.status = PointStatus::local_newton_failed, out;
  if (std::isinf(step)) return out; // fully relaxed: all is zero
  const T rate = 0.5 * step / deviatoric_viscosity, volumetric_rate = step / volumetric_viscosity;
  const Vector3<T> trial_e = trial.array() - trial_theta / 3;
  T theta;
  Vector3<T> e;
  if (!solve_volumetric(trial_theta, volumetric_rate, theta) || !solve_deviatoric(trial_e, rate, e)) {
    out.status = PointStatus::local_newton_failed;
    return out;
  }
  out.strain = e.array() + theta / 3;
  out.deviatoric = spring.deviatoric(e);
  out.volumetric = spring.volumetric(theta);
  out.energy = spring.energy(e, theta);
  const Vector3<T> &tau = out.deviatoric.tau;
  const T &mean = out.volumetric.mean;
  out.dissipated = rate * tau.dot(tau) + volumetric_rate * mean * mean;

  // From derivatives with respect to eps to those with respect to the trial strains, THEORY (1.13), (1.14),
  // (1.16).
  VolumetricStress<T> &v = out.volumetric;
  v.bulk /= 1 + volumetric_rate * v.bulk;
  Vector3<T> &D = out.deviatoric.stiffness;
  const T second = second_invariant(D), det = determinant(D, rate);
  for (int a = 0; a < 3; ++a) {
    D[a] = (D[a] + rate * second) / det;
    T &secant = out.deviatoric.secant[a];
    const T ratio = 1 / (1 + rate * secant);
    secant *= ratio;
    out.strain_ratio[a] = value(ratio);
  }
  return out;
}

/// theta + rate mean(theta) = trial. The start solves it with the stiffness at theta = 0; as the mean stress
/// is convex in theta, it lies beyond the root and Newton's method comes down monotonically. The quadratic
/// law is convex for J > 1/4 only and falls below J = 1/2: where the left side does not grow, there is no
/// root to be trusted.
template <class T> bool MaxwellBranch<T>::solve_volumetric(const T &trial, const T &rate, T &theta) const
{
  using std::abs;
  using V = Value<T>;
  V t = value(trial) / (1 + value(rate) * value(spring.bulk_modulus)), size = 1;
  for (int i = 0; i < max_iterations && any(size > quadratic); ++i) {
    const auto open = size > quadratic;
    const VolumetricStress<V> stress = spring.volumetric(t);
    const V slope = 1 + value(rate) * stress.bulk;
    if (!all(slope > 0)) return false;
    const V change = (t - value(trial) + value(rate) * stress.mean) / slope;
    t = where(open, V(t - change), t);
    size = where(open, V(abs(change) / (1 + abs(t))), size);
  }
  theta = t;
  if constexpr (is_dual<T>) { // one more step carries the derivatives, whatever they are with respect to
    const VolumetricStress<T> stress = spring.volumetric(theta);
    theta -= (theta - trial + rate * stress.mean) / (1 + rate.v * stress.bulk.v);
  }
  return all(size <= quadratic);
}

/// e + rate tau(e) = trial, the gradient of a convex function where all G_r alpha_r > 0. The start solves it
/// with the stiffness at e = 0. Full steps converge for stretches up to 30 and exponents up to 14 but for a
/// few in 100,000 cases, and halving those that enlarge the residual does not save more.
template <class T>
bool MaxwellBranch<T>::solve_deviatoric(const Vector3<T> &trial, const T &rate, Vector3<T> &e) const
{
  using V = Value<T>;
  const Vector3<V> target = value(trial);
  const V s = value(rate);
  Vector3<V> x = target / V(1 + 2 * s * value(spring.shear_modulus()));
  V size = 1;
  for (int i = 0; i < max_iterations && any(size > quadratic); ++i) {
    const auto open = size > quadratic;
    const DeviatoricStress<V> stress = spring.deviatoric(x);
    const Vector3<V> residual = x - target + s * stress.tau,
                     change = correction(stress.stiffness, s, residual);
    for (int a = 0; a < 3; ++a) x[a] = where(open, V(x[a] - change[a]), x[a]);
    size = where(open, V(largest(change) / (1 + largest(x))), size);
  }
  e = x.template cast<T>();
  if constexpr (is_dual<T>) {
    const DeviatoricStress<T> stress = spring.deviatoric(e);
    const Vector3<T> residual = e - trial + rate * stress.tau;
    e -= correction(value(stress.stiffness), s, residual);
  }
  return all(size <= quadratic);
}

} // namespace tribogel
