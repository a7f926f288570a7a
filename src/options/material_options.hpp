/// What others need of the materials' options: the names of Maxwell branches, of which there may be any
/// number.
#pragma once

#include "options/scene_input.hpp"

namespace tribogel
{

/// The names of the four options of one Maxwell branch: moduli, exponents, bulk modulus, viscosities. `body`
/// is "top" or "bottom"; branches count from 1, and the first has no number in its names.
struct BranchNames {
  std::string moduli, exponents, bulk_modulus, viscosities;
  std::vector<std::string> all() const { return {moduli, exponents, bulk_modulus, viscosities}; }
};
BranchNames branch_names(const std::string &body, int branch);

/// A warning for each branch of a read scene that its schedule is too slow or too short to see.
void warn_about_relaxation(SceneInput &input);

} // namespace tribogel
