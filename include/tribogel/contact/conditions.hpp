/// Contact and friction at one slave node as a semismooth equation, for both models.
///
/// All vectors are given in one orthonormal frame, (r, theta, z) or (x, y, z). With the multiplier lambda (nominal
/// traction on the slave), its pressure lambda_N = -lambda . n, the gap g >= 0 when open and the sliding velocity
/// v = slave minus master:
///
///     p   = max(0, lambda_N - c_N g)
///     C_N = lambda_N - p                     open: lambda_N = 0;   closed: g = 0
///     C_T = lambda_c - b s / max(b, |s|)     stick: v_T = 0;       slip: lambda_c = -b v_T / |v_T|
///
/// with lambda_c = lambda_T + (tau_1 / v) v_T the tangential traction without the law's smooth part, b = tau(0+, p) and
/// s = lambda_c - (c_T + max(0, tau_1 / v)) v_T. The vector equation is C = -C_N n + C_T = 0; at an open node it is
/// lambda = 0.
///
/// The second term in s keeps s pointing against v_T while the multiplier has not yet followed. With
/// s = lambda_c - c_T v_T Newton's method failed in 266 of the 3000 problems of test_conditions' node on a spring (none
/// with the term) and took twice the iterations. Where tau_1 < 0 (weakening) the term would hide the slip solution, so
/// only its positive part is taken.
///
/// Choices where the equation has a kink; value and derivative are always those of one definite side:
/// - lambda_N = c_N g is closed: two surfaces that just touch start with the row g = 0.
/// - |s| = b > 0 sticks.
/// - b = s = 0 (no law, no load, or the state at t = 0): C_T = lambda_c, whose row is never empty.
/// - v_T = 0: the smooth part is (tau_1 / v at v = 0) times v_T, differentiable without a direction.
/// - First touch: the law sees p, not lambda_N. While lambda_N is still 0, p = c_N |g| is not, so the node sticks as
///   long as its slip increment is below about mu |g|, and a high friction coefficient is felt at once. No memory of
///   the iteration before is needed: the same state always gives the same equation.
#pragma once

#include "tribogel/friction/law.hpp"
#include "tribogel/math/dual.hpp"
#include "tribogel/math/tensor.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

enum class ContactStatus { open, stick, slip };

template <class T> struct ContactPoint {
  Vector3<T> multiplier; ///< nominal traction on the slave [MPa]
  Vector3<T> normal;     ///< unit, out of the slave
  T gap;                 ///< along the normal, negative when penetrating [mm]
  Vector3<T> velocity;   ///< slave minus master; only its tangential part matters [mm/s]
};

/// The conditions hold for any positive values: they set how strongly a violated one changes the status of a node.
struct ContactScale {
  double normal;     ///< c_N, a stiffness per area [MPa/mm]
  double tangential; ///< c_T [MPa s/mm]
};

template <class T> struct ContactCondition {
  Vector3<T> residual; ///< C [MPa]
  ContactStatus status;
};

/// |v| without overflow or underflow; exactly 0, without derivatives, for v = 0.
template <class T> T robust_norm(const Vector3<T> &v)
{
  using std::sqrt;
  const double largest = std::max({std::abs(value(v[0])), std::abs(value(v[1])), std::abs(value(v[2]))});
  if (!(largest > 0)) return T(largest); // 0, or NaN
  const Vector3<T> w = v / T(largest);
  return largest * sqrt(T(w.dot(w)));
}

/// `on_axis`: on the axis of an axisymmetric model every tangential quantity vanishes; C_T = lambda_T there.
template <class T, FrictionLaw<T> Law>
ContactCondition<T> contact_condition(const ContactPoint<T> &at, const ContactScale &scale, const Law &law,
                                      bool on_axis = false)
{
  const T normal_part = at.multiplier.dot(at.normal); // -lambda_N
  const T p = -normal_part - scale.normal * at.gap;
  if (value(p) < 0) return {at.multiplier, ContactStatus::open};

  const T C_N = scale.normal * at.gap;
  const Vector3<T> lambda_T = at.multiplier - normal_part * at.normal;
  if (on_axis) return {lambda_T - C_N * at.normal, ContactStatus::stick};

  const Vector3<T> v = at.velocity - at.velocity.dot(at.normal) * at.normal;
  const T drag = law.sliding(robust_norm(v), p).over_v, c_T = scale.tangential;
  const Vector3<T> lambda_c = lambda_T + drag * v;
  const Vector3<T> s = (value(drag) > 0 ? lambda_T : lambda_c) - c_T * v;
  const T b = law.static_strength(p).value, magnitude = robust_norm(s);
  Vector3<T> C_T = lambda_c;
  ContactStatus status = ContactStatus::stick;
  if (value(magnitude) > value(b)) {
    C_T -= (b / magnitude) * s;
    status = ContactStatus::slip;
  } else if (value(b) > 0)
    C_T = (value(drag) > 0 ? T(c_T + drag) : c_T) * v; // = lambda_c - s, without its cancellation
  return {C_T - C_N * at.normal, status};
}

} // namespace tribogel
