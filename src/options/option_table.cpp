#include "options/option_table.hpp"

#include "support/parse.hpp"

#include <cmath>

namespace tribogel
{

namespace
{

std::string joined(const std::vector<std::string> &words, const std::string &between)
{
  std::string text;
  for (const std::string &word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

} // namespace

std::string Range::in_words() const
{
  const bool bounded_above = std::isfinite(high);
  if (std::isfinite(low) && low == high) return to_text(low) + " only";
  if (std::isfinite(low) && bounded_above)
    return (low_excluded ? "above " : "") + to_text(low) + " to " + to_text(high);
  if (std::isfinite(low)) return (low_excluded ? "> " : ">= ") + to_text(low);
  return bounded_above ? "<= " + to_text(high) : "any";
}

std::string Option::allowed() const
{
  const std::string bounds = range.in_words() == "any" ? "" : " " + range.in_words();
  std::string text;
  switch (kind) {
  case OptionKind::real:
    text = "a real number" + bounds;
    break;
  case OptionKind::integer:
    text = "a whole number" + bounds;
    break;
  case OptionKind::reals:
    text =
        (count ? std::to_string(count) + " real numbers" : "real numbers") + bounds + " separated by commas";
    break;
  case OptionKind::choice:
    text = joined(choices, " or ");
    break;
  case OptionKind::flag:
    text = "nothing, true or false";
    break;
  case OptionKind::path:
    text = "a path";
    break;
  }
  if (!rule.empty()) text += ", " + rule;
  if (!unit.empty() && unit != "-") text += " [" + unit + "]";
  return text;
}

std::vector<std::string> option_names()
{
  std::vector<std::string> names;
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options) names.push_back(option.name);
  return names;
}

const Option *find_option(const std::string &name)
{
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options)
      if (option.name == name) return &option;
  return nullptr;
}

} // namespace tribogel
