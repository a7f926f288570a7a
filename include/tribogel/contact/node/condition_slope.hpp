/// Derivatives of the contact condition at a node by dual numbers.
#pragma once

#include "tribogel/contact/node/condition.hpp"

namespace tribogel
{

/// d C / d (multiplier 0..2, gap 3, velocity 4..6, normal 7..9 and, with 11 inputs, area ratio 10).
template <int inputs, class Law>
Eigen::Matrix<double, 3, inputs> condition_slope(const ContactPoint<double> &at, const ContactScale &scale,
                                                 const Law &law, bool on_axis = false)
{
  using D = Dual<inputs>;
  ContactPoint<D> point;
  point.gap = D::seed(at.gap, 3);
  for (int i = 0; i < 3; ++i) {
    point.multiplier[i] = D::seed(at.multiplier[i], i);
    point.velocity[i] = D::seed(at.velocity[i], 4 + i);
    point.normal[i] = D::seed(at.normal[i], 7 + i);
  }
  if constexpr (inputs > 10)
    point.area_ratio = D::seed(at.area_ratio, 10);
  else
    point.area_ratio = D(at.area_ratio);
  const auto C = contact_condition<D>(point, scale, law, on_axis);
  Eigen::Matrix<double, 3, inputs> slope;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < inputs; ++j) slope(i, j) = C.residual[i].d[j];
  return slope;
}

} // namespace tribogel
