/// Contact and friction at one slave node as a semismooth equation, for both models.
///
/// All vectors are given in one orthonormal frame, (r, theta, z) or (x, y, z). With the multiplier lambda
/// (nominal traction on the slave), its pressure lambda_N = -lambda . n, the gap g >= 0 when open and the
/// sliding velocity v = slave minus master:
///
///     p   = max(0, lambda_N - c_N g)
///     C_N = lambda_N - p                     open: lambda_N = 0;   closed: g = 0
///     C_T = lambda_c - b s / max(b, |s|)     stick: v_T = 0;       slip: lambda_c = -b v_T / |v_T|
///
/// with lambda_c = lambda_T + (tau_1 / v) v_T the tangential traction without the law's smooth part, b =
/// tau(0+, p) and s = lambda_c - k v_T, k = c_T + max(0, tau_1 / v). The vector equation is C = -C_N n + C_T
/// = 0; at an open node it is lambda = 0.
///
/// A law with a steep part tau_s(v) takes the speed V at which that part fits to s in place of the bare
/// threshold:
///
///     C_T = lambda_c - (b + tau_s(V)) s / |s|,    b + tau_s(V) + k V = |s|,    |s| > b
///         = k (v_T + V s / |s|)                   (the same; whichever cancels less is evaluated)
///
/// C_T = 0 says v_T = -V s / |s| and |lambda_c| = b + tau_s(V): the law itself, whatever k is. The slope of b
/// + tau_s(V) in |s| is tau_s' / (tau_s' + k), between 0 and 1 and 1 at rest, so Newton's method moves from
/// rest and C_T is even continuously differentiable at |s| = b. With tau_s = 0 it is the condition above.
///
/// In a steady state of the half plane the direction of the velocity is that of the plates: c_T is infinite.
/// s then points against v_T and V = |v_T|, so that the condition is the law as it stands,
///
///     C_T = lambda_c + (b + tau_s(|v_T|)) v_T / |v_T|,    C_T = lambda_c where v_T = 0,
///
/// linear in lambda. (A finite c_T leaves the row of a steep law at rest empty: all that it holds is k v_T.)
///
/// Measured on the node on springs of tests/unit/test_conditions_steep.cpp, 1000 problems over decades of v,
/// p and traction for each law, from rest under pressure and at first touch. With c_T from 0.1 to 2 times the
/// spring's stiffness x time the exponents (0.1), (0.5), (0.9), (0, 0.5), (0.5, 2), (0.1, 2.5), (0, 0.5, 1,
/// 2) never fail and take at most 11 iterations; with 10 times up to 83 of 1000 fail (m = 0.1 alone), with a
/// threshold up to 319, where Coulomb's law itself fails in 50 at rest and in 286 at first touch. Other
/// forms, from rest: lambda = -tau(|v_T|) v_T/|v_T| fails in 492 (m = 0.1) and 367 (m = 0.5), v_T =
/// -v(|lambda|) lambda/|lambda| in 60 to 99 and up to 36. If tau_1 kept the terms with m >= 1, exponents
/// (0.5, 2) would fail at first touch in 23 to 70.
///
/// The second term in s keeps s pointing against v_T while the multiplier has not yet followed. With
/// s = lambda_c - c_T v_T Newton's method failed in 266 of the 3000 problems of test_conditions' node on a
/// spring (none with the term) and took twice the iterations. Where tau_1 < 0 (weakening) the term would hide
/// the slip solution, so only its positive part is taken.
///
/// A law with memory may fall within a solve, by no more than f = steepest_fall(p) per speed (b p h/L of rate
/// and state). c_T is then raised by 2 f: b + tau_s(V) + k V rises, and the slope of the strength in |s| lies
/// between -1 and 1.
///
/// Choices where the equation has a kink; value and derivative are always those of one definite side:
/// - lambda_N = c_N g is closed: two surfaces that just touch start with the row g = 0.
/// - |s| = b > 0 sticks.
/// - b = s = 0 (no law, no load, or the state at t = 0): C_T = lambda_c, whose row is never empty. With a
/// steep part
///   under pressure: C_T = k v_T.
/// - An area ratio J scales the law, tau per reference area = J tau(v, p / J), where it is not linear in p.
/// - v_T = 0: the smooth part is (tau_1 / v at v = 0) times v_T, differentiable without a direction.
/// - First touch: the law sees p, not lambda_N. While lambda_N is still 0, p = c_N |g| is not, so the node
/// sticks as
///   long as its slip increment is below about mu |g|, and a high friction coefficient is felt at once. No
///   memory of the iteration before is needed: the same state always gives the same equation.
#pragma once

#include "tribogel/friction/friction.hpp"
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
  T area_ratio = 1; ///< current over reference area; of no effect for a law that is linear in the pressure
};

/// The conditions hold for any positive values: they set how strongly a violated one changes the status of a
/// node.
struct ContactScale {
  double normal;     ///< c_N, a stiffness per area [MPa/mm]
  double tangential; ///< c_T [MPa s/mm]; infinite where the velocity is given
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

/// tau(|v|, p) v / |v| at a given velocity, without the threshold at rest; tau = area_ratio times the law's.
template <class T, FrictionFor<T> Law>
Vector3<T> drag_at(const Vector3<T> &v, const T &area_ratio, const T &cauchy, const Law &law)
{
  const T speed = robust_norm(v);
  T over_speed = law.drag(speed, cauchy);
  if (value(speed) > 0) over_speed += (law.threshold(cauchy) + law.steep(speed, cauchy)) / speed;
  return area_ratio * over_speed * v;
}

/// c_T, or more where the law remembers and may fall.
template <class T, FrictionFor<T> Law>
T tangential_scale(const ContactScale &scale, const T &area_ratio, const T &cauchy, const Law &law)
{
  T c_T = scale.tangential;
  if constexpr (requires { law.steepest_fall(cauchy); })
    if (law.has_memory()) c_T += 2 * area_ratio * law.steepest_fall(cauchy);
  return c_T;
}

/// `on_axis`: on the axis of an axisymmetric model every tangential quantity vanishes; C_T = lambda_T there.
template <class T, FrictionFor<T> Law>
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
  const T J = law.linear_in_pressure() ? T(1) : at.area_ratio, cauchy = p / J;
  if (std::isinf(scale.tangential)) {
    const bool moves = value(robust_norm(v)) > 0;
    return {lambda_T + drag_at<T>(v, J, cauchy, law) - C_N * at.normal,
            moves ? ContactStatus::slip : ContactStatus::stick};
  }
  const T drag = J * law.drag(robust_norm(v), cauchy), c_T = tangential_scale<T>(scale, J, cauchy, law);
  const bool dragged = value(drag) > 0;
  const T k = dragged ? T(c_T + drag) : c_T;
  const Vector3<T> lambda_c = lambda_T + drag * v;
  const Vector3<T> s = (dragged ? lambda_T : lambda_c) - c_T * v;
  const T b = J * law.threshold(cauchy), magnitude = robust_norm(s);
  const bool steep = law.has_steep_part() && value(p) > 0;
  Vector3<T> C_T = lambda_c;
  ContactStatus status = ContactStatus::stick;
  if (value(magnitude) > value(b)) {
    const T speed = steep ? T(law.steep_speed(T((magnitude - b) / J), T(k / J), cauchy)) : T(0);
    const T strength = steep ? T(b + J * law.steep(speed, cauchy)) : b;
    if (steep && (value(speed) == 0 || value(k) * value(speed) < value(strength)))
      C_T = k * (v + (speed / magnitude) * s); // the same without the cancellation of lambda_c and s
    else
      C_T -= (strength / magnitude) * s;
    status = ContactStatus::slip;
  } else if (value(b) > 0 || steep)
    C_T = k * v; // = lambda_c - s
  return {C_T - C_N * at.normal, status};
}

} // namespace tribogel
