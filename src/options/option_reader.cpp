#include "options/option_reader.hpp"

#include "options/nearest_name.hpp"
#include "support/characters.hpp"
#include "support/parse.hpp"

#include <algorithm>
#include <stdexcept>

namespace tribogel
{

namespace
{

/// The value, or a refusal that says what is wrong and what is allowed.
template <class T> T value_or_refuse(const Option &option, const std::string &text, const Parsed<T> &parsed)
{
  if (parsed.value) return *parsed.value;
  if (text.empty()) throw UserError{option.name + ": value missing; allowed: " + option.allowed()};
  refuse(option.name, text, parsed.error + "; allowed: " + option.allowed());
}

void expect_in_range(const Option &option, const std::string &text, double value)
{
  if (!option.range.contains(value)) refuse(option.name, text, "allowed: " + option.allowed());
}

} // namespace

void refuse(const std::string &name, const std::string &value, const std::string &allowed)
{
  const std::string odd = foreign_character(value);
  throw UserError{name + " = " + value + ": " + (odd.empty() ? "" : "it holds " + odd + "; ") + allowed};
}

std::string OptionReader::text(const Option &option) const
{
  const auto found = given.find(option.name);
  return found == given.end() ? option.fallback : found->second;
}

double OptionReader::real(const Option &option) const
{
  const double value = value_or_refuse(option, text(option), parse_real(text(option)));
  expect_in_range(option, text(option), value);
  return value;
}

int OptionReader::integer(const Option &option) const
{
  const long value = value_or_refuse(option, text(option), parse_integer(text(option)));
  expect_in_range(option, text(option), static_cast<double>(value));
  return static_cast<int>(value);
}

bool OptionReader::flag(const Option &option) const
{
  return value_or_refuse(option, text(option), parse_flag(text(option)));
}

std::string OptionReader::choice(const Option &option) const
{
  const std::string word = text(option);
  if (word.empty()) throw UserError{option.name + ": value missing; allowed: " + option.allowed()};
  if (std::find(option.choices.begin(), option.choices.end(), word) != option.choices.end()) return word;
  const std::string meant = nearest_name(word, option.choices, plausible_distance(word));
  refuse(option.name, word,
         "allowed: " + option.allowed() + (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

std::string OptionReader::path(const Option &option) const
{
  const std::string value = text(option);
  if (value.empty()) throw UserError{option.name + ": value missing; allowed: " + option.allowed()};
  return value;
}

std::vector<double> OptionReader::reals(const Option &option) const
{
  const std::string list = text(option);
  const std::vector<double> values = value_or_refuse(option, list, parse_reals(list));
  for (double value : values) expect_in_range(option, list, value);
  if (option.count && values.size() != option.count)
    refuse(option.name, list,
           std::to_string(values.size()) + (values.size() == 1 ? " value" : " values") +
               "; allowed: " + option.allowed());
  return values;
}

void OptionReader::expect_equal_lengths(const Option &list, const Option &reference,
                                        const std::string &otherwise) const
{
  const std::size_t length = reals(list).size(), expected = reals(reference).size();
  if (length == expected) return;
  const auto described = [&](const Option &option, std::size_t n) {
    return option.name + " = " + text(option) + (is_given(option.name) ? "" : " (default)") + " has " +
           std::to_string(n);
  };
  throw UserError{described(list, length) + ", " + described(reference, expected) +
                  "; allowed: lists of equal lengths" + otherwise};
}

const Option &OptionReader::declared(const std::string &name)
{
  if (const Option *option = find_option(name)) return *option;
  throw std::logic_error("option " + name + " is not in the table");
}

} // namespace tribogel
