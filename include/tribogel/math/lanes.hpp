/// Several numbers at once, as many as one of the processor's vectors holds: the scalar with which code that
/// is templated on it does at as many points, in about the time of one, what it does with `double` at one.
///
/// A comparison gives a `Mask`, lane by lane. What must be asked in one way for all scalars: `any` and `all`
/// make a branch of it; `where` takes one of two values, lane by lane; `choose` too, but computes only what
/// some lane needs. No lane's result depends on the others.
#pragma once

#include "tribogel/math/dual.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tribogel
{

struct Lanes {
  static constexpr int count = std::max(2, static_cast<int>(Eigen::internal::packet_traits<double>::size));
  using Vector [[gnu::vector_size(sizeof(double) * count)]] = double;

  struct Mask {
    decltype(Vector{} < Vector{}) v;

    friend Mask operator&(const Mask &a, const Mask &b) { return {a.v & b.v}; }
    friend Mask operator!(const Mask &a) { return {~a.v}; }
    friend bool any(const Mask &a) { return a.bits() != 0; }
    friend bool all(const Mask &a) { return a.bits() == (1u << count) - 1; }

    /// One for each lane.
    unsigned bits() const
    {
#if defined(__AVX512DQ__)
      return _mm512_movepi64_mask(reinterpret_cast<__m512i>(v));
#elif defined(__AVX__) && !defined(__AVX512F__)
      return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(v)));
#else
      // Not v[k]: GCC 12's bounds sanitizer sees the offset in bytes there and stops.
      const auto lane = std::bit_cast<std::array<std::int64_t, count>>(v);
      unsigned all = 0;
      for (std::size_t k = 0; k < count; ++k) all |= (lane[k] ? 1u : 0u) << k;
      return all;
#endif
    }
  };

  Vector v;

  Lanes() = default;
  Lanes(double x) : v(x - Vector{}) {} // implicit: constants mix freely
  explicit Lanes(const Vector &x) : v(x) {}

  Lanes &operator+=(const Lanes &b)
  {
    return v += b.v, *this;
  }
  Lanes &operator-=(const Lanes &b)
  {
    return v -= b.v, *this;
  }
  Lanes &operator*=(const Lanes &b)
  {
    return v *= b.v, *this;
  }
  Lanes &operator/=(const Lanes &b)
  {
    return v /= b.v, *this;
  }
  friend Lanes operator+(const Lanes &a)
  {
    return a;
  }
  friend Lanes operator-(const Lanes &a)
  {
    return Lanes(-a.v);
  }
  friend Lanes operator+(const Lanes &a, const Lanes &b)
  {
    return Lanes(a.v + b.v);
  }
  friend Lanes operator-(const Lanes &a, const Lanes &b)
  {
    return Lanes(a.v - b.v);
  }
  friend Lanes operator*(const Lanes &a, const Lanes &b)
  {
    return Lanes(a.v * b.v);
  }
  friend Lanes operator/(const Lanes &a, const Lanes &b)
  {
    return Lanes(a.v / b.v);
  }

  friend Mask operator==(const Lanes &a, const Lanes &b)
  {
    return {a.v == b.v};
  }
  friend Mask operator<(const Lanes &a, const Lanes &b)
  {
    return {a.v < b.v};
  }
  friend Mask operator>(const Lanes &a, const Lanes &b)
  {
    return {a.v > b.v};
  }
  friend Mask operator<=(const Lanes &a, const Lanes &b)
  {
    return {a.v <= b.v};
  }
  friend Mask isfinite(const Lanes &x)
  {
    return {x.v - x.v == Vector{}};
  }

  friend Lanes where(const Mask &condition, const Lanes &a, const Lanes &b)
  {
    return Lanes(condition.v ? a.v : b.v);
  }
  template <class A, class B> friend Lanes choose(const Mask &condition, const A &a, const B &b)
  {
    if (!any(condition)) return b();
    return all(condition) ? a() : where(condition, a(), b());
  }

  friend Lanes abs(const Lanes &x)
  {
    return of(x.array().abs());
  }
  friend Lanes sqrt(const Lanes &x)
  {
    return of(x.array().sqrt());
  }
  friend Lanes exp(const Lanes &x)
  {
    return of(x.array().exp());
  }
  friend Lanes log(const Lanes &x)
  {
    return of(x.array().log());
  }
  friend Lanes sinh(const Lanes &x)
  {
    return 0.5 * (exp(x) - exp(-x));
  } ///< for |x| not small
  friend Lanes tanh(const Lanes &x);
  friend Lanes expm1(const Lanes &x);

private:
  using Array = Eigen::Array<double, count, 1>;
  Eigen::Map<const Array, Eigen::AlignedMax> array() const
  {
    return Eigen::Map<const Array, Eigen::AlignedMax>(reinterpret_cast<const double *>(&v));
  }
  template <class Expression> static Lanes of(const Expression &x)
  {
    Lanes y;
    Eigen::Map<Array, Eigen::AlignedMax>(reinterpret_cast<double *>(&y.v)) = x;
    return y;
  }
};

/// The same questions for one number.
inline bool any(bool condition)
{
  return condition;
}
inline bool all(bool condition)
{
  return condition;
}
template <class T> T where(bool condition, const T &a, const T &b)
{
  return condition ? a : b;
}
template <class A, class B> auto choose(bool condition, const A &a, const B &b)
{
  return condition ? a() : b();
}

inline Lanes value(const Lanes &x)
{
  return x;
}

/// What a scalar is without derivatives.
template <class T> struct ValueOf {
  using type = double;
};
template <> struct ValueOf<Lanes> {
  using type = Lanes;
};
template <class T> using Value = typename ValueOf<T>::type;

} // namespace tribogel

namespace Eigen
{

template <> struct NumTraits<tribogel::Lanes> : NumTraits<double> {
  using Real = tribogel::Lanes;
  using NonInteger = tribogel::Lanes;
  using Nested = tribogel::Lanes;
};

template <class Operation> struct ScalarBinaryOpTraits<tribogel::Lanes, double, Operation> {
  using ReturnType = tribogel::Lanes;
};
template <class Operation> struct ScalarBinaryOpTraits<double, tribogel::Lanes, Operation> {
  using ReturnType = tribogel::Lanes;
};

} // namespace Eigen
