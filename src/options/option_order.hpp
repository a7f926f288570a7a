/// What counts of options that say the same thing, and what is worth telling of where they come from. Pure.
#pragma once

#include "support/command_line.hpp"

#include <array>
#include <string>
#include <vector>

namespace tribogel
{

/// Two options that say one thing in two ways; the later counts.
using TwoWays = std::array<const char *, 2>;
const std::vector<TwoWays> &two_ways();

/// The other way to say what this option says, or null.
const char *other_way(const std::string &name);

/// Takes out what a later option says in another way; a note for each option that goes.
std::vector<std::string> keep_later(std::vector<GivenOption> &options);

/// What is given twice in one place with different values, and what counts of ours though nobody named its
/// source.
std::vector<std::string> notes_on_sources(const std::vector<GivenOption> &options);

} // namespace tribogel
