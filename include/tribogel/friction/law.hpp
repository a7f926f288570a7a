/// What every friction law offers: tau(v, p), the tangential stress of a contact that slides at speed v >= 0 [mm/s]
/// under the pressure p >= 0 [MPa], split at v -> 0+ into what a stick can hold and what the sliding adds to it:
///
///     tau(v, p) = static_strength(p) + tau_1(v, p),    tau_1(0, p) = 0
///
/// The contact conditions treat the first part as a set-valued threshold and the second as a smooth function of the
/// velocity, so a law without the first part has no kink at all.
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
    law.coefficient(v, p)
    } -> std::convertible_to<T>; // tau / p
};

} // namespace tribogel
