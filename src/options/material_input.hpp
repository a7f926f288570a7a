/// The options of one specimen's material -> Viscoelastic.
#pragma once

#include "options/option_reader.hpp"

namespace tribogel
{

/// `body` is "top" or "bottom". Adds warnings and notes to `input`.
Viscoelastic<double> read_material(const OptionReader &reader, const std::string &body, SceneInput &input);

} // namespace tribogel
