#include "options/option_order.hpp"

#include "options/option_table.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

std::string described(const GivenOption &option)
{
  return option.name + (option.value.empty() ? "" : " = " + option.value) + " (" + option.place() + ")";
}

/// The last option of that name, or the end.
std::vector<GivenOption>::const_reverse_iterator last_of(const std::vector<GivenOption> &options,
                                                         const std::string &name)
{
  return std::find_if(options.rbegin(), options.rend(),
                      [&](const GivenOption &option) { return same_name(option.name, name); });
}

} // namespace

const std::vector<TwoWays> &two_ways()
{
  static const std::vector<TwoWays> pairs{{"-schedule_rates", "-schedule_twists"},
                                          {"-time_tolerance", "-ts_atol"}};
  return pairs;
}

const char *other_way(const std::string &name)
{
  for (const TwoWays &pair : two_ways())
    for (std::size_t k = 0; k < 2; ++k)
      if (same_name(pair[k], name)) return pair[1 - k];
  return nullptr;
}

std::vector<std::string> keep_later(std::vector<GivenOption> &options)
{
  std::vector<std::string> notes;
  for (const TwoWays &pair : two_ways()) {
    const auto first = last_of(options, pair[0]), second = last_of(options, pair[1]);
    if (first == options.rend() || second == options.rend()) continue;
    const auto &earlier = first < second ? second : first,
               &later = first < second ? first : second; // reversed
    notes.push_back(described(*earlier) + " gives way to " + described(*later) +
                    ": both say the same thing, and the later one counts");
    const std::string name = earlier->name;
    std::erase_if(options, [&](const GivenOption &option) { return same_name(option.name, name); });
  }
  return notes;
}

std::vector<std::string> notes_on_sources(const std::vector<GivenOption> &options)
{
  std::vector<std::string> notes;
  for (auto option = options.begin(); option != options.end(); ++option) {
    const auto again = std::find_if(option + 1, options.end(), [&](const GivenOption &other) {
      return same_name(other.name, option->name);
    });
    if (again == options.end()) {
      if (option->unasked && find_option(option->name))
        notes.push_back(described(*option) + " counts: it is read without being named");
    } else if (again->source == option->source && again->value != option->value) {
      notes.push_back(described(*option) + " gives way to " + described(*again) + ", which comes later");
    }
  }
  return notes;
}

} // namespace tribogel
