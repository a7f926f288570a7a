/// Fixed-size tensors and the Mandel notation.
///
/// A symmetric tensor S is stored as the 6-vector (S11, S22, S33, r S23, r S13, r S12) with r = sqrt(2), so
/// that the dot product of two vectors is the double contraction S : T, and a 6x6 matrix is a fourth-order
/// tensor with both minor symmetries. In the axisymmetric model the axes 1, 2, 3 are r, theta, z.
#pragma once

#include <Eigen/Dense>

#include <numbers>

namespace tribogel
{

template <class T> using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T> using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T> using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <class T> using Mandel = Eigen::Matrix<T, 6, 1>;  ///< symmetric tensor
template <class T> using Mandel4 = Eigen::Matrix<T, 6, 6>; ///< fourth-order tensor, minor symmetric

/// The two indices behind each Mandel component.
inline constexpr int mandel_index[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

template <class T> Mandel<T> to_mandel(const Matrix3<T> &S)
{
  constexpr double r = std::numbers::sqrt2;
  Mandel<T> v;
  v << S(0, 0), S(1, 1), S(2, 2), r * S(1, 2), r * S(0, 2), r * S(0, 1);
  return v;
}

template <class T> Matrix3<T> from_mandel(const Mandel<T> &v)
{
  constexpr double s = 1 / std::numbers::sqrt2;
  Matrix3<T> S;
  S << v[0], s * v[5], s * v[4], //
      s * v[5], v[1], s * v[3],  //
      s * v[4], s * v[3], v[2];
  return S;
}

} // namespace tribogel
