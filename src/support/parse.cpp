#include "support/parse.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tribogel
{

namespace
{

template <class T> Parsed<T> failed(std::string why)
{
  return {std::nullopt, std::move(why)};
}

std::string quoted(std::string_view text)
{
  return "'" + std::string(text) + "'";
}

bool has_blank(std::string_view text)
{
  return text.find_first_of(" \t\r\n\v\f") != std::string_view::npos;
}

/// std::from_chars takes no plus sign; people write one. "+-1" stays wrong.
std::string_view without_plus(std::string_view text)
{
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

template <class T> Parsed<T> parse_number(std::string_view text, const char *kind)
{
  if (text.empty()) return failed<T>("value missing");
  if (has_blank(text)) return failed<T>(quoted(text) + " contains a blank");
  const std::string_view digits = without_plus(text);
  T value{};
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || status == std::errc::invalid_argument)
    return failed<T>(quoted(text) + " is not " + kind);
  if (status == std::errc::result_out_of_range) return failed<T>(quoted(text) + " does not fit " + kind);
  return {value, {}};
}

} // namespace

Parsed<double> parse_real(std::string_view text)
{
  Parsed<double> result = parse_number<double>(text, "a real number");
  if (result.value && !std::isfinite(*result.value)) return failed<double>(quoted(text) + " is not finite");
  return result;
}

Parsed<long> parse_integer(std::string_view text)
{
  return parse_number<long>(text, "a whole number");
}

Parsed<bool> parse_flag(std::string_view text)
{
  if (text.empty() || text == "true") return {true, {}};
  if (text == "false") return {false, {}};
  return failed<bool>(quoted(text) + " is neither true nor false");
}

Parsed<std::vector<double>> parse_reals(std::string_view text)
{
  using Reals = std::vector<double>;
  if (text.empty()) return failed<Reals>("value missing");
  if (has_blank(text)) return failed<Reals>("blanks in a list: separate the numbers by commas only");
  Reals values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin)
      return failed<Reals>("number " + std::to_string(values.size() + 1) + " of the list is empty");
    const Parsed<double> item = parse_real(text.substr(begin, end - begin));
    if (!item.value) return failed<Reals>(item.error);
    values.push_back(*item.value);
    begin = end + 1;
  }
  return {values, {}};
}

std::string to_text(double value)
{
  char buffer[64];
  const bool short_integer = std::abs(value) < 1e9 && value == std::floor(value); // 2000000 rather than 2e+06
  const auto result = short_integer
                          ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                          : std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

} // namespace tribogel
