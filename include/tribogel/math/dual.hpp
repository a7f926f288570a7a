/// Forward dual numbers: a value and its first derivatives in N directions.
///
/// Whatever is written for `double` and templated on the scalar gives exact derivatives when it is called
/// with `Dual<N>`:
///
///     auto x = Dual<2>::seed(3, 0), y = Dual<2>::seed(4, 1);
///     auto r = sqrt(x * x + y * y);   // r.v = 5, r.d = {0.6, 0.8}
///
/// Comparisons look at the value only. Call functions unqualified after `using std::exp;`, so that both
/// scalars work.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <type_traits>

namespace tribogel
{

template <int N> struct Dual {
  static constexpr int directions = N;

  double v = 0;              ///< value
  std::array<double, N> d{}; ///< derivative in each direction

  Dual() = default;
  Dual(double value) : v(value) {} // implicit: constants mix freely

  /// The independent variable number `index`.
  static Dual seed(double value, int index)
  {
    Dual x(value);
    x.d[index] = 1;
    return x;
  }

  /// f(x), when f and f' at x.v are known.
  Dual chain(double f, double slope) const
  {
    Dual y(f);
    for (int k = 0; k < N; ++k) y.d[k] = slope * d[k];
    return y;
  }

  Dual &operator+=(const Dual &b)
  {
    v += b.v;
    for (int k = 0; k < N; ++k) d[k] += b.d[k];
    return *this;
  }
  Dual &operator-=(const Dual &b)
  {
    v -= b.v;
    for (int k = 0; k < N; ++k) d[k] -= b.d[k];
    return *this;
  }
  Dual &operator*=(const Dual &b)
  {
    for (int k = 0; k < N; ++k) d[k] = d[k] * b.v + v * b.d[k];
    v *= b.v;
    return *this;
  }
  Dual &operator/=(const Dual &b)
  {
    const double inverse = 1 / b.v;
    v /= b.v;
    for (int k = 0; k < N; ++k) d[k] = (d[k] - v * b.d[k]) * inverse;
    return *this;
  }
  Dual &operator+=(double b)
  {
    v += b;
    return *this;
  }
  Dual &operator-=(double b)
  {
    v -= b;
    return *this;
  }
  Dual &operator*=(double b)
  {
    v *= b;
    for (double &x : d) x *= b;
    return *this;
  }
  Dual &operator/=(double b)
  {
    v /= b;
    for (double &x : d) x /= b;
    return *this;
  }

  friend Dual operator+(const Dual &a) { return a; }
  friend Dual operator-(const Dual &a) { return a.chain(-a.v, -1); }
  friend Dual operator+(Dual a, const Dual &b) { return a += b; }
  friend Dual operator-(Dual a, const Dual &b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual &b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual &b) { return a /= b; }
  friend Dual operator+(Dual a, double b) { return a += b; }
  friend Dual operator-(Dual a, double b) { return a -= b; }
  friend Dual operator*(Dual a, double b) { return a *= b; }
  friend Dual operator/(Dual a, double b) { return a /= b; }
  friend Dual operator+(double a, Dual b) { return b += a; }
  friend Dual operator-(double a, const Dual &b) { return b.chain(a - b.v, -1); }
  friend Dual operator*(double a, Dual b) { return b *= a; }
  friend Dual operator/(double a, const Dual &b) { return b.chain(a / b.v, -a / (b.v * b.v)); }

  friend bool operator==(const Dual &a, const Dual &b) { return a.v == b.v; }
  friend bool operator!=(const Dual &a, const Dual &b) { return a.v != b.v; }
  friend bool operator<(const Dual &a, const Dual &b) { return a.v < b.v; }
  friend bool operator>(const Dual &a, const Dual &b) { return a.v > b.v; }
  friend bool operator<=(const Dual &a, const Dual &b) { return a.v <= b.v; }
  friend bool operator>=(const Dual &a, const Dual &b) { return a.v >= b.v; }

  // The derivative at a kink (abs, hypot at 0) is 0; sqrt, cbrt and log at 0 give infinite or undefined ones.
  friend Dual abs(const Dual &x) { return x.chain(std::abs(x.v), (x.v > 0) - (x.v < 0)); }
  friend Dual sqrt(const Dual &x) { return x.chain(std::sqrt(x.v), 0.5 / std::sqrt(x.v)); }
  friend Dual cbrt(const Dual &x) { return x.chain(std::cbrt(x.v), std::cbrt(x.v) / (3 * x.v)); }
  friend Dual exp(const Dual &x) { return x.chain(std::exp(x.v), std::exp(x.v)); }
  friend Dual expm1(const Dual &x) { return x.chain(std::expm1(x.v), std::exp(x.v)); }
  friend Dual log(const Dual &x) { return x.chain(std::log(x.v), 1 / x.v); }
  friend Dual log1p(const Dual &x) { return x.chain(std::log1p(x.v), 1 / (1 + x.v)); }
  friend Dual sin(const Dual &x) { return x.chain(std::sin(x.v), std::cos(x.v)); }
  friend Dual cos(const Dual &x) { return x.chain(std::cos(x.v), -std::sin(x.v)); }
  friend Dual tan(const Dual &x) { return x.chain(std::tan(x.v), 1 + std::tan(x.v) * std::tan(x.v)); }
  friend Dual atan(const Dual &x) { return x.chain(std::atan(x.v), 1 / (1 + x.v * x.v)); }
  friend Dual sinh(const Dual &x) { return x.chain(std::sinh(x.v), std::cosh(x.v)); }
  friend Dual cosh(const Dual &x) { return x.chain(std::cosh(x.v), std::sinh(x.v)); }
  friend Dual tanh(const Dual &x) { return x.chain(std::tanh(x.v), 1 - std::tanh(x.v) * std::tanh(x.v)); }

  /// The slope of x^0 is 0, also at x = 0.
  friend Dual pow(const Dual &x, double exponent)
  {
    return x.chain(std::pow(x.v, exponent), exponent == 0 ? 0 : exponent * std::pow(x.v, exponent - 1));
  }
  /// The derivative with respect to the exponent is taken as 0 where x <= 0.
  friend Dual pow(const Dual &x, const Dual &exponent)
  {
    const Dual y = pow(x, exponent.v);
    return y + exponent.chain(0, x.v > 0 ? y.v * std::log(x.v) : 0);
  }
  friend Dual pow(double x, const Dual &exponent) { return pow(Dual(x), exponent); }

  friend Dual atan2(const Dual &y, const Dual &x)
  {
    const double square = x.v * x.v + y.v * y.v;
    return y.chain(std::atan2(y.v, x.v), x.v / square) + x.chain(0, -y.v / square);
  }
  friend Dual hypot(const Dual &x, const Dual &y)
  {
    const double h = std::hypot(x.v, y.v);
    return h > 0 ? x.chain(h, x.v / h) + y.chain(0, y.v / h) : Dual(0);
  }

  /// Of the value and of every derivative.
  friend bool isfinite(const Dual &x)
  {
    bool finite = std::isfinite(x.v);
    for (double derivative : x.d) finite = finite && std::isfinite(derivative);
    return finite;
  }
  friend bool isnan(const Dual &x)
  {
    bool nan = std::isnan(x.v);
    for (double derivative : x.d) nan = nan || std::isnan(derivative);
    return nan;
  }

  friend std::ostream &operator<<(std::ostream &out, const Dual &x)
  {
    out << x.v << " (";
    for (int k = 0; k < N; ++k) out << (k ? " " : "") << x.d[k];
    return out << ")";
  }
};

template <class T> inline constexpr bool is_dual = false;
template <int N> inline constexpr bool is_dual<Dual<N>> = true;

/// The value without derivatives, for both scalars.
inline double value(double x)
{
  return x;
}
template <int N> double value(const Dual<N> &x)
{
  return x.v;
}

/// The values of a vector or matrix.
template <class Derived> auto value(const Eigen::MatrixBase<Derived> &m)
{
  return m.unaryExpr([](const typename Derived::Scalar &x) { return value(x); }).eval();
}

/// The derivatives in one direction of a vector or matrix of dual numbers.
template <class Derived> auto derivative(const Eigen::MatrixBase<Derived> &m, int direction)
{
  return m.unaryExpr([direction](const typename Derived::Scalar &x) { return x.d[direction]; }).eval();
}

/// A parameter as the scalar S of the computation at hand: its value when S is double, itself otherwise.
template <class S, class T> S as_scalar(const T &x)
{
  if constexpr (std::is_same_v<S, double>)
    return value(x);
  else
    return S(x);
}

} // namespace tribogel

namespace Eigen
{

template <int N> struct NumTraits<tribogel::Dual<N>> : NumTraits<double> {
  using Real = tribogel::Dual<N>;
  using NonInteger = tribogel::Dual<N>;
  using Nested = tribogel::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1 + N,
    AddCost = 1 + N,
    MulCost = 1 + 3 * N
  };
};

template <int N, class Operation> struct ScalarBinaryOpTraits<tribogel::Dual<N>, double, Operation> {
  using ReturnType = tribogel::Dual<N>;
};
template <int N, class Operation> struct ScalarBinaryOpTraits<double, tribogel::Dual<N>, Operation> {
  using ReturnType = tribogel::Dual<N>;
};

} // namespace Eigen
