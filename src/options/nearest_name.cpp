#include "options/nearest_name.hpp"

#include <algorithm>
#include <cctype>

namespace tribogel
{

int edit_distance(std::string_view a, std::string_view b)
{
  const auto same = [&](std::size_t i, std::size_t j) {
    return std::tolower(static_cast<unsigned char>(a[i])) == std::tolower(static_cast<unsigned char>(b[j]));
  };
  const std::size_t columns = b.size() + 1;
  std::vector<int> before(columns), last(columns), now(columns);
  for (std::size_t j = 0; j < columns; ++j) now[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = now;
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j < columns; ++j) {
      const int change = same(i - 1, j - 1) ? 0 : 1;
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
  }
  return now[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string> &candidates, int at_most)
{
  std::string best;
  int best_distance = at_most + 1;
  for (const std::string &candidate : candidates) {
    const int distance = edit_distance(name, candidate);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

int plausible_distance(std::string_view name)
{
  return name.size() < 8 ? 1 : static_cast<int>(name.size() / 4);
}

} // namespace tribogel
