/// Options of friction: which law, and its parameters as the laws declare them (friction/laws.hpp).
#pragma once

#include "options/option_reader.hpp"

namespace tribogel
{

/// -friction_law and what concerns any law; then a group for each law.
std::vector<OptionGroup> friction_groups();

/// The options with the lists of -friction_table_file in place of its name: what is computed with and what a
/// run that goes on is held to are the numbers. Throws UserError.
GivenOptions with_friction_table(const GivenOptions &given);

/// Into the scene; adds notes. Throws UserError.
void read_friction(const OptionReader &reader, SceneInput &input);

/// Is `option` a parameter of another law than the chosen one?
bool is_of_another_law(const std::string &option, const std::string &chosen);

} // namespace tribogel
