/// What every friction law offers: tau(v, p), the tangential stress of a contact that slides at speed v >= 0
/// [mm/s] under the pressure p >= 0 [MPa], both per current area, split by what happens at v -> 0+:
///
///     tau(v, p) = static_strength(p) + steep_stress(v, p) + tau_1(v, p),    steep_stress(0, p) = tau_1(0, p)
///     = 0
///
/// static_strength is what a stick can hold, a set-valued threshold; steep_stress rises with v, with an
/// infinite slope at v = 0 (or is 0 throughout), so its inverse is smooth there; tau_1 is smooth.
/// steep_speed(stress, drag, p) is the v >= 0 that solves steep_stress(v, p) + drag v = stress, for stress,
/// drag > 0. A law without the first two parts has no kink at all.
#pragma once

#include <concepts>

namespace tribogel
{

/// tau at v -> 0+, which a stick must exceed [MPa].
template <class T> struct StaticStrength {
  T value; ///< [MPa], >= 0
  T d_p;   ///< derivative with respect to p
};

/// The rest tau_1 = tau - static strength at one (v, p).
template <class T> struct SlidingStress {
  T over_v; ///< tau_1 / v, finite at v = 0 [MPa s/mm]
  T d_v;    ///< d tau_1 / d v [MPa s/mm]
  T d_p;    ///< d tau_1 / d p
};

/// A law that is linear in p is the same per reference and per current area.
///
/// `Law` may be asked with velocities and pressures of the scalar type T (double or Dual).
template <class Law, class T>
concept FrictionLaw = requires(const Law &law, const T &v, const T &p)
{
  {
    law.static_strength(p).value
    } -> std::convertible_to<T>;
  {
    law.static_strength(p).d_p
    } -> std::convertible_to<T>;
  {
    law.sliding(v, p).over_v
    } -> std::convertible_to<T>;
  {
    law.sliding(v, p).d_v
    } -> std::convertible_to<T>;
  {
    law.sliding(v, p).d_p
    } -> std::convertible_to<T>;
  {
    law.steep_stress(v, p)
    } -> std::convertible_to<T>;
  {
    law.steep_speed(v, v, p)
    } -> std::convertible_to<T>;
  {
    law.has_steep_part()
    } -> std::convertible_to<bool>;
  {
    law.linear_in_pressure()
    } -> std::convertible_to<bool>;
  {
    law.coefficient(v, p)
    } -> std::convertible_to<T>; // tau / p
};

} // namespace tribogel
