/// Strict reading of one value from text: the whole text must be the value. No blanks, no "nan" or "inf", no
/// hexadecimal, nothing that does not fit; independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribogel
{

/// A value, or why there is none.
template <class T> struct Parsed {
  std::optional<T> value;
  std::string error; ///< empty if there is a value
};

Parsed<double> parse_real(std::string_view text);
Parsed<long> parse_integer(std::string_view text);
Parsed<bool> parse_flag(std::string_view text); ///< `true` or `false`; empty text (the bare option) is true

/// Reals separated by single commas.
Parsed<std::vector<double>> parse_reals(std::string_view text);

/// Shortest text that reads back as the same number.
std::string to_text(double value);

} // namespace tribogel
