/// Every option of tribogel, declared once, by its group (option_groups.hpp): the reader, -help,
/// options/README.md and the search for misspelt names all use this table. Nothing here knows PETSc.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace tribogel
{

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;

  bool contains(double x) const
  {
    return (low_excluded ? x > low : x >= low) && x <= high;
  }                             ///< false for NaN
  std::string in_words() const; ///< "> 0", ">= 1", "1 to 2", "any"
};

inline constexpr Range any_real{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range non_negative{0};

enum class OptionKind { real, reals, integer, choice, flag, path };

struct Option {
  std::string name; ///< as the user writes it, with the dash
  OptionKind kind;
  std::string fallback{}; ///< text of the default; empty: none
  std::string unit{};     ///< "-" for numbers without one, empty for words
  std::string meaning;
  std::string source; ///< of the default: "paper" (fixed by its text), "assumed" (the text is silent), "own"
  Range range{};
  std::vector<std::string> choices{};
  std::size_t count = 0;   ///< numbers in a list; 0: any number, at least one
  std::string rule{};      ///< what is allowed beyond range and count, in words
  bool may_change = false; ///< when a stopped run is continued

  std::string allowed() const; ///< what may stand after the name, in words, unit included
};

struct OptionGroup {
  std::string title;
  std::vector<Option> options;
};

/// All groups in the order of -help.
const std::vector<OptionGroup> &option_table();

/// The names of all of them.
std::vector<std::string> option_names();

/// The entry of that name, or null.
const Option *find_option(const std::string &name);

} // namespace tribogel
