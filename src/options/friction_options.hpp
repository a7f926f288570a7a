/// What others need of friction's options: that its law may be a table in a file, and that each law has its
/// own.
#pragma once

#include "options/scene_input.hpp"

namespace tribogel
{

/// The options with the lists of -friction_table_file in place of its name: what is computed with and what a
/// run that goes on is held to are the numbers. Throws UserError.
GivenOptions with_friction_table(const GivenOptions &given);

/// Is `option` a parameter of another law than the chosen one?
bool is_of_another_law(const std::string &option, const std::string &chosen);

} // namespace tribogel
