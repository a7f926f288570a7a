/// The options of one specimen's material -> Viscoelastic.
#pragma once

#include "options/option_reader.hpp"

namespace tribogel
{

/// `body` is "top" or "bottom". Adds warnings and notes to `input`.
Viscoelastic<double> read_material(const OptionReader &reader, const std::string &body, SceneInput &input);

/// Poisson's ratio of the initial response [1]; negative (auxetic) for K < 2/3 G.
double initial_poisson_ratio(const Ogden<double> &law);

/// Relaxation times of a branch at small strain [s]: eta_D / G of the shape, eta_V / K of the volume.
double shape_relaxation_time(const MaxwellBranch<double> &branch);
double volume_relaxation_time(const MaxwellBranch<double> &branch);

} // namespace tribogel
