/// Finite viscoelasticity at a point: an Ogden spring in parallel with any number of Maxwell branches.
#pragma once

#include "tribogel/material/maxwell.hpp"
#include "tribogel/material/ogden.hpp"
#include "tribogel/material/status.hpp"
#include "tribogel/math/spectral.hpp"
#include "tribogel/math/tensor.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace tribogel
{

/// What the law returns at a point, per reference volume. Nothing but `status` means anything unless that is
/// ok.
template <class T> struct Response {
  PointStatus status = PointStatus::ok;
  T energy = 0;                      ///< stored, in all springs [MPa]
  T dissipated = 0;                  ///< in this step, >= 0 [MPa]
  Mandel<T> tau = Mandel<T>::Zero(); ///< Kirchhoff stress, J times Cauchy's [MPa]
  /// If asked for: the Lie derivative tau_dot - l tau - tau l^T = tangent : d, consistent with the step
  /// taken; symmetric [MPa]. The values only: it is the derivative, and dual numbers do not carry second
  /// ones.
  Mandel4<Value<T>> tangent = Mandel4<Value<T>>::Zero();
};

/// The bulk law: a value that holds its parameters and nothing else. It may be called twice, in any order, on
/// steps that are later rejected; the caller owns the history. T is the scalar of parameters, F and history,
/// double, Dual<N> or Lanes. Without branches the law is hyperelastic, has no history and ignores the step.
template <class T> struct Viscoelastic {
  using Scalar = T;

  Ogden<T> equilibrium;
  std::vector<MaxwellBranch<T>> branches;

  static constexpr int history_per_branch = 6; ///< C_i^-1 in Mandel components

  /// Numbers of history at a point.
  int history_size() const { return history_per_branch * static_cast<int>(branches.size()); }

  /// The state without any past: C_i^-1 = 1.
  void initial_history(T *history) const;

  template <class U> Viscoelastic<U> cast() const;

  /// Stress at the new time from the deformation gradient F there (any 3x3 matrix of physical components with
  /// a positive determinant) and the history. `history_new` [history_size()] may be null, may not be one of
  /// the levels, and is complete only if the status is ok.
  Response<T> evaluate(const Matrix3<T> &F, const HistoryLevels<T> &history, const StepWeights &weights,
                       T *history_new, bool with_tangent) const;

private:
  /// Adds one spring's stress and tangent, given in the axes of `strain`.
  static void add_stress(const Spectral<T> &strain, const DeviatoricStress<T> &deviatoric,
                         const VolumetricStress<T> &volumetric, bool with_tangent, Response<T> &out);
  static void add_tangent(const Spectral<T> &strain, const DeviatoricStress<T> &deviatoric,
                          const VolumetricStress<T> &volumetric, Mandel4<Value<T>> &tangent);
  static Matrix3<T> elastic_strain(const Spectral<T> &trial, const BranchStep<T> &step, double reach);
};

template <class T> void Viscoelastic<T>::initial_history(T *history) const
{
  for (int i = 0; i < history_size(); ++i) history[i] = i % history_per_branch < 3 ? 1 : 0;
}

template <class T> template <class U> Viscoelastic<U> Viscoelastic<T>::cast() const
{
  Viscoelastic<U> out{equilibrium.template cast<U>(), {}};
  for (const MaxwellBranch<T> &branch : branches) out.branches.push_back(branch.template cast<U>());
  return out;
}

template <class T>
Response<T> Viscoelastic<T>::evaluate(const Matrix3<T> &F, const HistoryLevels<T> &history,
                                      const StepWeights &weights, T *history_new, bool with_tangent) const
{
  using std::isfinite, std::log;
  Response<T> out;
  const T J = F.determinant();
  if (!all(J > 0) || !all(isfinite(value(J)))) return out.status = PointStatus::inverted, out;

  const T theta = log(J);
  const Spectral<T> strain = log_strain<T>(F * F.transpose(), theta);
  if (!all(isfinite(strain.values.sum()))) return out.status = PointStatus::inverted, out;
  const Vector3<T> e = strain.values.array() - theta / 3;
  out.energy = equilibrium.energy(e, theta);
  add_stress(strain, equilibrium.deviatoric(e), equilibrium.volumetric(theta), with_tangent, out);

  const Matrix3<T> inverse = history_new ? Matrix3<T>(F.inverse()) : Matrix3<T>::Zero();
  for (std::size_t m = 0; m < branches.size(); ++m) {
    const Mandel<T> mandel = Eigen::Map<const Mandel<T>>(history.at_n + history_per_branch * m);
    const Matrix3<T> old = from_mandel(mandel);
    const Spectral<T> trial = log_strain<T>(F * old * F.transpose(), theta + 0.5 * log(old.determinant()));
    const BranchStep<T> step = branches[m].advance(trial.values, weights.step);
    if (step.status != PointStatus::ok) return out.status = step.status, out;
    out.energy += step.energy;
    out.dissipated += step.dissipated;
    add_stress(trial, step.deviatoric, step.volumetric, with_tangent, out);
    if (history_new) {
      const Matrix3<T> updated = inverse * elastic_strain(trial, step, weights.reach) * inverse.transpose();
      Eigen::Map<Mandel<T>>(history_new + history_per_branch * m) = to_mandel(updated);
    }
  }
  return out;
}

template <class T>
void Viscoelastic<T>::add_stress(const Spectral<T> &strain, const DeviatoricStress<T> &deviatoric,
                                 const VolumetricStress<T> &volumetric, bool with_tangent, Response<T> &out)
{
  const Vector3<T> principal = deviatoric.tau.array() + volumetric.mean;
  out.tau += to_mandel(isotropic_function(strain, principal, value(deviatoric.secant)));
  if (with_tangent) add_tangent(strain, deviatoric, volumetric, out.tangent);
}

/// THEORY (1.11): in the principal axes c_aabb = d tau_a/d eps_b - 2 tau_a delta_ab, and the Mandel component
/// of a shear is s_ab delta coth(delta) - tau_a - tau_b, with s_ab the secant and delta = eps_a - eps_b.
template <class T>
void Viscoelastic<T>::add_tangent(const Spectral<T> &strain, const DeviatoricStress<T> &deviatoric,
                                  const VolumetricStress<T> &volumetric, Mandel4<Value<T>> &tangent)
{
  using V = Value<T>;
  const Vector3<V> D = value(deviatoric.stiffness), eps = value(strain.values),
                   tau = value(deviatoric.tau).array() + value(volumetric.mean);
  Matrix3<V> normal; // P diag(D) P + bulk 1 1^T - 2 diag(tau)
  Vector3<V> shear;
  const V constant = D.sum() / 9 + value(volumetric.bulk);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      normal(a, b) = constant - (D[a] + D[b]) / 3 + (a == b ? V(D[a] - 2 * tau[a]) : V(0));
  for (int k = 0; k < 3; ++k) {
    const int a = pair_index[k][0], b = pair_index[k][1];
    shear[k] = value(deviatoric.secant[k]) * x_coth(V(eps[a] - eps[b])) - tau[a] - tau[b];
  }
  const Mandel4<V> R = mandel_rotation(strain.axes);
  Mandel4<V> half;
  half.template leftCols<3>().noalias() = R.template leftCols<3>() * normal;
  half.template rightCols<3>().noalias() = R.template rightCols<3>() * shear.asDiagonal();
  tangent.noalias() += half * R.transpose();
}

/// b_e of the new state, an isotropic function of the trial strain; its logarithms lie `reach` times as far
/// from those of the trial strain as the step's.
template <class T>
Matrix3<T> Viscoelastic<T>::elastic_strain(const Spectral<T> &trial, const BranchStep<T> &step, double reach)
{
  using std::exp;
  Vector3<T> strain = step.strain;
  if (reach != 1) strain = trial.values + reach * (step.strain - trial.values);
  const Vector3<T> b = (2 * strain).array().exp();
  Vector3<Value<T>> divided = Vector3<Value<T>>::Zero(); // read only with dual numbers
  for (int k = 0; is_dual<T> && k < 3; ++k) {
    const int p = pair_index[k][0], q = pair_index[k][1];
    const Value<T> x = value(strain[p]), y = value(strain[q]);
    // (b_p - b_q)/(x - y) times (x - y)/(trial_p - trial_q), THEORY (1.16)
    const Value<T> ratio =
        reach == 1 ? step.strain_ratio[k] : Value<T>(1 + reach * (step.strain_ratio[k] - 1));
    divided[k] = 2 * exp(Value<T>(x + y)) * sinhc(Value<T>(x - y)) * ratio;
  }
  return isotropic_function(trial, b, divided);
}

} // namespace tribogel
