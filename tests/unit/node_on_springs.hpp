/// Newton's method at one node: how many iterations a friction law takes.
#pragma once

#include "tribogel/contact/node/condition.hpp"

#include <Eigen/Dense>

namespace tribogel::testing
{

/// A node on springs, u and lambda unknown, which is given a velocity at once; its anchor comes down by p /
/// k_n, so that the pressure is p in the end. At the start it is at rest, unloaded (first touch) or under p.
/// 200: failed.
struct NodeOnSprings {
  double k, k_n, shift, c_N, c_T, p;
  Vector3<double> V;
  double traction; ///< of the solution [MPa]

  template <class Law> int newton_iterations(const Law &law, bool first_touch) const
  {
    constexpr int most = 200;
    constexpr double tolerance = 1e-10;
    using D = Dual<6>;
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    Vector6 x = Vector6::Zero(), row_scale, column_scale;
    if (!first_touch) x[5] = p;
    row_scale << traction, traction, p, traction, traction, p;
    column_scale << traction / k, traction / k, p / k_n, traction, traction, p;
    for (int iteration = 0; iteration < most; ++iteration) {
      Eigen::Matrix<D, 6, 1> X;
      for (int i = 0; i < 6; ++i) X[i] = D::seed(x[i], i);
      const ContactPoint<D> at{
          {X[3], X[4], X[5]}, {D(0), D(0), D(-1)}, X[2], {shift * X[0] + V[0], shift * X[1] + V[1], D(0)}};
      const auto C = contact_condition<D>(at, {c_N, c_T}, law).residual;
      const D rows[6] = {X[3] - k * X[0], X[4] - k * X[1], X[5] - k_n * X[2] - p, C[0], C[1], C[2]};
      Vector6 residual;
      Eigen::Matrix<double, 6, 6> J;
      for (int i = 0; i < 6; ++i) {
        residual[i] = rows[i].v / row_scale[i];
        for (int j = 0; j < 6; ++j) J(i, j) = rows[i].d[j] / row_scale[i] * column_scale[j];
      }
      if (!residual.allFinite()) return most;
      if (residual.norm() <= tolerance) return iteration;
      x -= Vector6(column_scale.array() * J.partialPivLu().solve(residual).array());
    }
    return most;
  }
};

} // namespace tribogel::testing
