/// Exact states of lubricated discs.
#pragma once

#include "scenes.hpp"
#include "solver_options.hpp"

#include <cmath>
#include <numbers>

namespace tribogel::test
{

/// Homogeneous uniaxial compression of a hyperelastic cylinder with a free wall.
struct UniaxialState {
  double axial, lateral; ///< stretches
  double pressure;       ///< Cauchy, positive in compression [MPa]

  /// Ratio of shear stress to shear angle for a small shear d x_theta = gamma d z on top of this state: the
  /// principal axes of b turn by gamma axial^2/(axial^2 - lateral^2) and take the stress along [MPa].
  double shear_stiffness() const { return -pressure * axial * axial / (axial * axial - lateral * lateral); }
};

/// Solves tau_lateral = 0 for the lateral stretch; Ogden's law written out here on its own, the paper's
/// (3.6), (3.7).
inline UniaxialState uniaxial_state(const Ogden<double> &law, double axial)
{
  const auto kirchhoff = [&](long double lateral, bool along_axis) {
    const long double J = lateral * lateral * axial, root = std::cbrt(J);
    long double tau = 0.5L * law.bulk_modulus * (J * J - 1);
    for (std::size_t r = 0; r < law.moduli.size(); ++r) {
      const long double z = std::pow(axial / root, static_cast<long double>(law.exponents[r]));
      const long double x = std::pow(lateral / root, static_cast<long double>(law.exponents[r]));
      tau += law.moduli[r] * (along_axis ? 2 : -1) * (z - x) / 3;
    }
    return tau;
  };
  long double low = 0.5L, high = 2;
  for (int k = 0; k < 80; ++k) {
    const long double middle = (low + high) / 2;
    (kirchhoff(middle, false) < 0 ? low : high) = middle;
  }
  const auto lateral = static_cast<double>(low);
  return {axial, lateral, static_cast<double>(-kirchhoff(low, true) / (low * low * axial))};
}

/// The axial stretch under a given pressure.
inline UniaxialState uniaxial_state_under(const Ogden<double> &law, double pressure)
{
  double low = 0.5, high = 1;
  for (int k = 0; k < 80; ++k) {
    const double middle = (low + high) / 2;
    (uniaxial_state(law, middle).pressure > pressure ? low : high) = middle;
  }
  return uniaxial_state(law, low);
}

} // namespace tribogel::test
