/// Axisymmetric body that may twist about its axis: mesh in the (R, Z) half plane, unknowns (u_R, w, u_Z) per
/// node with w = L phi, a length (L is the length scale of the twist, the top radius). A material point (R,
/// Theta, Z) moves to (R + u_R, Theta + phi, Z + u_Z). In physical components (e_r, e_theta, e_z) x (E_R,
/// E_Theta, E_Z), THEORY (2.1):
///
///       [ r,R        0      r,Z     ]
///   F = [ r phi,R    r/R    r phi,Z ]
///       [ z,R        0      z,Z     ]
///
/// F holds only gradients of phi: any number of revolutions is represented without loss of digits, and a
/// rigid rotation of the body is a constant phi.
///
/// This struct is what a model must offer to the element (the 3-D model offers the same): what F depends on,
/// `inputs`, `deformation`, the first variation `first` of F for one unit nodal unknown, the second variation
/// contracted with a stress, and `measure`.
#pragma once

#include "tribogel/math/tensor.hpp"

#include <array>
#include <numbers>

namespace tribogel
{

struct AxisymmetricTorsion {
  static constexpr int dim = 2;      ///< of the reference mesh
  static constexpr int unknowns = 3; ///< per node

  /// One number that F depends on: an unknown (derivative 0) or its derivative by X_(derivative - 1).
  struct Input {
    int unknown, derivative;
  };
  /// All of them. Not w and u_Z themselves: a rigid motion has no strain.
  static constexpr std::array<Input, 7> inputs{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 1}, {2, 2}}};

  double twist_length = 1; ///< L [mm]

  /// Volume per dR dZ [mm].
  static double measure(const std::array<double, 2> &X) { return 2 * std::numbers::pi * X[0]; }

  /// Unknowns and their gradients interpolated at one point.
  template <class T> struct Field {
    std::array<T, 3> u;
    std::array<std::array<T, 2>, 3> grad; ///< d u_i / d X_j
  };

  template <class T> Matrix3<T> deformation(const std::array<double, 2> &X, const Field<T> &f) const
  {
    const T r = X[0] + f.u[0];
    const T arm = r / twist_length;
    Matrix3<T> F;
    F << 1 + f.grad[0][0], T(0), f.grad[0][1],                     //
        arm * f.grad[1][0], 1 + f.u[0] / X[0], arm * f.grad[1][1], //
        f.grad[2][0], T(0), 1 + f.grad[2][1];
    return F;
  }

  /// dF for a unit value of unknown i at a node with shape function N and gradient dN.
  template <class T>
  Matrix3<T> first(const std::array<double, 2> &X, const Field<T> &f, int i, double N,
                   const std::array<double, 2> &dN) const
  {
    Matrix3<T> dF = Matrix3<T>::Constant(T(0));
    if (i == 0) {
      dF(0, 0) = T(dN[0]);
      dF(0, 2) = T(dN[1]);
      dF(1, 0) = N / twist_length * f.grad[1][0];
      dF(1, 1) = T(N / X[0]);
      dF(1, 2) = N / twist_length * f.grad[1][1];
    } else if (i == 1) {
      const T arm = (X[0] + f.u[0]) / twist_length;
      dF(1, 0) = arm * dN[0];
      dF(1, 2) = arm * dN[1];
    } else {
      dF(2, 0) = T(dN[0]);
      dF(2, 2) = T(dN[1]);
    }
    return dF;
  }

  /// P : d2F for unknown i at node a and unknown j at node b; F is bilinear in (u_R, phi) only.
  double second(const Matrix3<double> &P, int i, double Na, const std::array<double, 2> &dNa, int j,
                double Nb, const std::array<double, 2> &dNb) const
  {
    if (i == 0 && j == 1) return Na * (P(1, 0) * dNb[0] + P(1, 2) * dNb[1]) / twist_length;
    if (i == 1 && j == 0) return Nb * (P(1, 0) * dNa[0] + P(1, 2) * dNa[1]) / twist_length;
    return 0;
  }
};

} // namespace tribogel
