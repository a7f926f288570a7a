/// The evolution law at a point, integrated by a library along a motion without any two coaxial times.
#pragma once

#include "material_samples.hpp"

#include "tribogel/material/viscoelastic.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace samples
{

using tribogel::from_mandel;
using tribogel::Mandel;
using tribogel::to_mandel;

/// Shear, stretch and rotation about axes that turn: no two times are coaxial. A cycle of 4 s that starts
/// with a jerk.
inline Matrix3<double> wandering(double t)
{
  const double w = std::numbers::pi / 2;
  const Matrix3<double> one = Matrix3<double>::Identity();
  return one + 0.35 * std::sin(w * t) * noise(71) + 0.25 * (1 - std::cos(w * t)) * noise(72) +
         0.2 * std::sin(2 * w * t) * noise(73);
}

/// The evolution law -1/2 (L_v b_e) b_e^-1 = V^-1 : tau as an ordinary differential equation for X = C_i^-1
/// of each branch, b_e = F X F^T: dX/dt = -2 F^-1 (V^-1 : tau) b_e F^-T. Integrated by a library to 1e-12.
std::vector<double> integrate_flow(const Viscoelastic<double> &material,
                                   Matrix3<double> (*deformation)(double), double end);

inline Mandel<double> stress_at(const Viscoelastic<double> &material, const Matrix3<double> &F,
                                const std::vector<double> &history)
{
  return material.evaluate(F, {history.data()}, {0}, nullptr, false).tau;
}

} // namespace samples
