/// Why a run is to end behind the step at hand, the same on all ranks: because someone asked for it, and then
/// it can be continued from there, or because it cannot go on.
#pragma once

#include <string>

namespace tribogel
{

class StopWish
{
public:
  /// The last request counts.
  void request(const std::string &why) { asked = why; }

  /// All reasons count, each once, and more than a request.
  void give_up(const std::string &why)
  {
    if (obstacle.find(why) == std::string::npos) obstacle += (obstacle.empty() ? "" : "; ") + why;
  }

  /// What another wants too.
  void add(const StopWish &other)
  {
    if (!other.asked.empty()) request(other.asked);
    if (other.given_up()) give_up(other.obstacle);
  }

  void clear() { *this = {}; }

  bool wanted() const { return is_request() || given_up(); }
  bool is_request() const { return !asked.empty() && !given_up(); }
  bool given_up() const { return !obstacle.empty(); }

  /// Empty: nothing speaks for a stop.
  const std::string &reason() const { return given_up() ? obstacle : asked; }

private:
  std::string asked, obstacle;
};

} // namespace tribogel
