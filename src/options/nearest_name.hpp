/// What a misspelt name was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tribogel
{

/// Letters to insert, delete, change or exchange with their neighbour to turn one name into the other
/// (Damerau-Levenshtein, each letter touched once). Upper and lower case are the same, as in PETSc's option
/// names.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate of smallest distance if it is within `at_most`, else empty; the first one of equals.
std::string nearest_name(std::string_view name, const std::vector<std::string> &candidates, int at_most);

/// The distance up to which a name of this length counts as a misspelling of another: 1 for up to 7 letters,
/// then a quarter of the letters.
int plausible_distance(std::string_view name);

} // namespace tribogel
