/// Body of any shape: mesh in (X, Y, Z), unknowns the three displacements per node, in Cartesian components:
/// F = 1 + grad u. The interface is that of AxisymmetricTorsion.
#pragma once

#include "tribogel/math/tensor.hpp"

#include <array>

namespace tribogel
{

struct Solid {
  static constexpr int dim = 3;      ///< of the reference mesh
  static constexpr int unknowns = 3; ///< per node

  /// One number that F depends on: the derivative of an unknown by X_(derivative - 1).
  struct Input {
    int unknown, derivative;
  };
  static constexpr std::array<Input, 9> inputs{
      {{0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {2, 3}}};

  /// Volume per dX dY dZ.
  static double measure(const std::array<double, 3> &) { return 1; }

  /// Unknowns and their gradients interpolated at one point.
  template <class T> struct Field {
    std::array<T, 3> u;
    std::array<std::array<T, 3>, 3> grad; ///< d u_i / d X_j
  };

  template <class T> Matrix3<T> deformation(const std::array<double, 3> &, const Field<T> &f) const
  {
    Matrix3<T> F;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F(i, j) = i == j ? 1 + f.grad[i][j] : f.grad[i][j];
    return F;
  }

  /// dF for a unit value of unknown i at a node with gradient dN of its shape function.
  template <class T>
  Matrix3<T> first(const std::array<double, 3> &, const Field<T> &, int i, double,
                   const std::array<double, 3> &dN) const
  {
    Matrix3<T> dF = Matrix3<T>::Constant(T(0));
    for (int j = 0; j < 3; ++j) dF(i, j) = T(dN[j]);
    return dF;
  }

  /// P : d2F; F is linear.
  double second(const Matrix3<double> &, int, double, const std::array<double, 3> &, int, double,
                const std::array<double, 3> &) const
  {
    return 0;
  }
};

} // namespace tribogel
