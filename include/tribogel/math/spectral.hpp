/// Spectral form of symmetric 3x3 tensors and isotropic tensor functions of them, exact at coalescing
/// eigenvalues.
///
/// Nothing here divides by a difference of eigenvalues: whoever knows the function supplies its divided
/// differences in a form that is smooth where they coincide, THEORY (1.9), (1.10). T is double, Dual<N> or
/// Lanes.
#pragma once

#include "tribogel/math/elementary.hpp"
#include "tribogel/math/tensor.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace tribogel
{

/// The two axes of pair k = 0, 1, 2: the pairs of Mandel components 3, 4, 5.
inline constexpr int pair_index[3][2] = {{1, 2}, {0, 2}, {0, 1}};

/// A symmetric tensor S = axes (diag(values) + off-diagonal shears) axes^T, in the eigenvectors of its value.
///
/// The axes are plain numbers. Without derivatives the shears are zero; with dual numbers their values are
/// zero and their derivatives are the rotation of the eigenvectors times the difference of the eigenvalues,
/// which, unlike the rotation itself, exists and is continuous at coalescing eigenvalues.
template <class T> struct Spectral {
  Vector3<T> values;      ///< in no particular order
  Matrix3<Value<T>> axes; ///< columns
  Vector3<T> shears;      ///< by pair_index
};

/// A symmetric matrix on its way to being diagonal.
template <class V> struct JacobiRotations {
  Vector3<V> diagonal, off; ///< off-diagonal entries by pair_index
  std::array<Vector3<V>, 3> axis{Vector3<V>::UnitX(), Vector3<V>::UnitY(), Vector3<V>::UnitZ()};

  /// Turns the axes of one pair until its off-diagonal entry vanishes; false if it was round-off of the
  /// diagonal.
  template <int pair> bool rotate()
  {
    constexpr int a = pair_index[pair][0], b = pair_index[pair][1];
    constexpr double negligible = 0.25 * std::numeric_limits<double>::epsilon();
    using std::abs, std::sqrt;
    const V twice = 2 * off[pair], difference = diagonal[b] - diagonal[a];
    const auto done = off[pair] * off[pair] <= negligible * negligible * abs(V(diagonal[a] * diagonal[b]));
    if (all(done)) return false;
    const V sum = abs(difference) + sqrt(V(difference * difference + twice * twice));
    const V scale = where(done, V(0), V(1 / sqrt(V(sum * sum + twice * twice)))),
            signed_twice = where(difference < 0, V(-twice), twice);
    const V sine = scale * signed_twice, half_tangent = sine / (1 + scale * sum);
    const auto turn = [&](auto &x, auto &y) { // cosine = 1 - sine * half_tangent: small turns lose nothing
      const auto u = x;
      x -= sine * (y + half_tangent * x);
      y += sine * (u - half_tangent * y);
    };
    const V change = where(done, V(0), V(signed_twice / sum * off[pair]));
    diagonal[a] -= change;
    diagonal[b] += change;
    off[pair] = where(done, off[pair], V(0));
    turn(off[b], off[a]); // of the pairs (a, c) and (b, c), c the third axis
    turn(axis[a], axis[b]);
    return true;
  }
};

/// By Jacobi's method: twice as accurate as QR, also at coalescing eigenvalues, where closed forms are not,
/// and in two thirds of its time.
template <class T> Spectral<T> spectral(const Matrix3<T> &S)
{
  const Matrix3<Value<T>> A = value(S);
  JacobiRotations<Value<T>> jacobi{A.diagonal(), {A(1, 2), A(0, 2), A(0, 1)}};
  constexpr int most_sweeps = 20; // three to five are enough, whatever the matrix; NaN never ends
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const bool first = jacobi.template rotate<2>(), second = jacobi.template rotate<1>(),
               third = jacobi.template rotate<0>();
    if (!first && !second && !third) break;
  }
  Spectral<T> out;
  for (int a = 0; a < 3; ++a) out.axes.col(a) = jacobi.axis[a];
  out.values = jacobi.diagonal.template cast<T>();
  out.shears.setZero();
  if constexpr (is_dual<T>) {
    const Matrix3<T> local = out.axes.transpose() * S * out.axes;
    for (int a = 0; a < 3; ++a) out.values[a] += local(a, a) - local(a, a).v;
    for (int k = 0; k < 3; ++k) {
      const T &shear = local(pair_index[k][0], pair_index[k][1]);
      out.shears[k] = shear - shear.v;
    }
  }
  return out;
}

/// The logarithmic strain 1/2 ln B of a positive definite B, whose trace 1/2 ln det B the caller knows,
/// usually from determinants of the factors of B: a sum over eigenvalues carries several times the round-off,
/// which a bulk modulus would magnify. The values are NaN or infinite if B is not positive definite.
template <class T> Spectral<T> log_strain(const Matrix3<T> &B, const T &trace)
{
  using std::log;
  Spectral<T> s = spectral(B);
  if constexpr (is_dual<T>)
    for (int k = 0; k < 3; ++k) {
      const double x = s.values[pair_index[k][0]].v, y = s.values[pair_index[k][1]].v;
      s.shears[k] *= 0.5 / (std::sqrt(x * y) * sinhc(0.5 * std::log(x / y)));
    }
  for (int a = 0; a < 3; ++a) s.values[a] = 0.5 * log(s.values[a]);
  const T shift = (trace - s.values.sum()) / 3;
  for (int a = 0; a < 3; ++a) s.values[a] += shift;
  return s;
}

/// The isotropic function of S whose principal values are f_a, and whose divided differences
/// (f_a - f_b)/(S_a - S_b) are `divided` (by pair_index; read only with dual numbers).
template <class T>
Matrix3<T> isotropic_function(const Spectral<T> &S, const Vector3<T> &f, const Vector3<Value<T>> &divided)
{
  if constexpr (is_dual<T>) {
    Matrix3<T> local = f.asDiagonal();
    for (int k = 0; k < 3; ++k) {
      const int a = pair_index[k][0], b = pair_index[k][1];
      local(a, b) = local(b, a) = divided[k] * S.shears[k];
    }
    return S.axes * local * S.axes.transpose();
  } else {
    return S.axes * f.asDiagonal() * S.axes.transpose();
  }
}

/// The 6x6 matrix that takes the Mandel components in `axes` to those in the global frame; it is orthogonal.
template <class V> Mandel4<V> mandel_rotation(const Matrix3<V> &axes)
{
  constexpr double r = std::numbers::sqrt2;
  Mandel4<V> R;
  for (int row = 0; row < 6; ++row) {
    const auto p = axes.row(mandel_index[row][0]), q = axes.row(mandel_index[row][1]);
    for (int a = 0; a < 3; ++a) R(row, a) = (row < 3 ? 1 : r) * p[a] * q[a];
    for (int k = 0; k < 3; ++k) {
      const int a = pair_index[k][0], b = pair_index[k][1];
      R(row, 3 + k) = row < 3 ? V(r * p[a] * p[b]) : V(p[a] * q[b] + p[b] * q[a]);
    }
  }
  return R;
}

} // namespace tribogel
