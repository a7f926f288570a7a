/// Looks options up by name, checks them against the table and remembers what each was resolved to.
#pragma once

#include "options/option_table.hpp"
#include "options/scene_input.hpp"

namespace tribogel
{

/// "-option = value: allowed", the form of every refusal of a value; a character that is not what it looks
/// like is named.
[[noreturn]] void refuse(const std::string &name, const std::string &value, const std::string &allowed);

class OptionReader
{
public:
  explicit OptionReader(const GivenOptions &options) : given(options) {}

  bool is_given(const std::string &name) const { return given.count(name) > 0; }
  std::string text(const Option &option) const; ///< as given, else the default

  double real(const Option &option) const;
  int integer(const Option &option) const;
  bool flag(const Option &option) const;
  std::string choice(const Option &option) const;
  std::string path(const Option &option) const;
  std::vector<double> reals(const Option &option) const;

  double real(const std::string &name) const { return real(declared(name)); }
  int integer(const std::string &name) const { return integer(declared(name)); }
  bool flag(const std::string &name) const { return flag(declared(name)); }
  std::string choice(const std::string &name) const { return choice(declared(name)); }
  std::string path(const std::string &name) const { return path(declared(name)); }
  std::vector<double> reals(const std::string &name) const { return reals(declared(name)); }

  /// Refuses two lists of different lengths; names both, their texts and their lengths, and what else is
  /// allowed.
  void expect_equal_lengths(const Option &list, const Option &reference,
                            const std::string &otherwise = "") const;

  static const Option &declared(const std::string &name);

private:
  const GivenOptions &given;
};

} // namespace tribogel
