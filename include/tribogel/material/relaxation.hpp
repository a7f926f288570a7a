/// What people know a material by at small strain: relaxation times, Poisson's ratio.
#pragma once

#include "tribogel/material/maxwell.hpp"

namespace tribogel
{

/// Poisson's ratio nu = (3 K - 2 G) / (2 (3 K + G)) of a spring [1]; negative (auxetic) for K < 2/3 G.
inline double initial_poisson_ratio(const Ogden<double> &law)
{
  const double G = law.shear_modulus(), K = law.bulk_modulus;
  return (3 * K - 2 * G) / (2 * (3 * K + G));
}

/// Relaxation times of a branch [s]: eta_D / G of the shape, eta_V / K of the volume.
inline double shape_relaxation_time(const MaxwellBranch<double> &branch)
{
  return branch.deviatoric_viscosity / branch.spring.shear_modulus();
}

inline double volume_relaxation_time(const MaxwellBranch<double> &branch)
{
  return branch.volumetric_viscosity / branch.spring.bulk_modulus;
}

} // namespace tribogel
