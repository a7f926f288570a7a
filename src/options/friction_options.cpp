/// Which law of friction, and its parameters as the laws declare them (friction/laws.hpp).
#include "options/friction_options.hpp"

#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "support/parse.hpp"
#include "tribogel/friction/laws.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace tribogel
{

namespace
{

constexpr const char *none = "none";
constexpr const char *table_file = "-friction_table_file", *table_speeds = "-friction_table_speeds",
                     *table_coefficients = "-friction_table_coefficients";

Option option_of(const LawDeclaration &law, const LawParameter &parameter)
{
  std::string rule = parameter.rule;
  if (std::string(parameter.fallback).empty())
    rule += std::string(rule.empty() ? "" : ", ") + "to be given with this law";
  return {.name = law.option(parameter),
          .kind = parameter.is_list ? OptionKind::reals : OptionKind::real,
          .fallback = parameter.fallback,
          .unit = parameter.unit,
          .meaning = parameter.meaning,
          .source = parameter.source,
          .range = {parameter.lowest, parameter.highest, parameter.lowest_excluded},
          .rule = rule};
}

OptionGroup choice_group()
{
  OptionGroup group{
      "Friction of the two gels",
      {{.name = "-friction_law",
        .kind = OptionKind::choice,
        .fallback = "polynomial",
        .meaning = "none, or the law whose parameters follow in its own table; v is the sliding speed"
                   " in mm/s, p the pressure in MPa, tau the stress, mu = tau / p",
        .source = "paper",
        .choices = {none}},
       {.name = "-friction_speed_range",
        .kind = OptionKind::reals,
        .fallback = "",
        .unit = "mm/s",
        .meaning = "lowest and highest speed for which the law was found; sliding faster gives a"
                   " notice",
        .source = "own",
        .range = any_real,
        .rule = "two, increasing, the first >= 0"},
       {.name = table_file,
        .kind = OptionKind::path,
        .fallback = "",
        .meaning = "with -friction_law table: a text file of two columns, v in mm/s and mu, separated by a"
                   " comma; a heading and lines that begin with # are passed over",
        .source = "own",
        .rule = "in place of -friction_table_speeds and -friction_table_coefficients"}}};
  for (const KnownLaw &law : known_laws()) group.options[0].choices.emplace_back(law.declaration->name);
  return group;
}

/// What concerns any law; then a group for each law.
std::vector<OptionGroup> declare_friction()
{
  std::vector<OptionGroup> groups{choice_group()};
  for (const KnownLaw &law : known_laws()) {
    groups.push_back({std::string("-friction_law ") + law.declaration->name + ": " +
                          law.declaration->formula + " (" + law.declaration->source + ")",
                      {}});
    for (const LawParameter &parameter : law.declaration->parameters)
      groups.back().options.push_back(option_of(*law.declaration, parameter));
  }
  return groups;
}

/// -friction_speed_range, if it is given.
std::optional<std::array<double, 2>> read_speed_range(const OptionReader &reader)
{
  const Option &range = OptionReader::declared("-friction_speed_range");
  if (!reader.is_given(range.name)) return {};
  const std::vector<double> v = reader.reals(range);
  if (v.size() != 2 || !(0 <= v[0] && v[0] < v[1]))
    refuse(range.name, reader.text(range), "allowed: " + range.allowed());
  return std::array<double, 2>{v[0], v[1]};
}

/// Of a law that is chosen all must have values; of another those are looked at that are given.
LawValues read_values(const OptionReader &reader, const LawDeclaration &law, bool chosen)
{
  LawValues values;
  for (const LawParameter &parameter : law.parameters) {
    const Option &option = OptionReader::declared(law.option(parameter));
    if (reader.text(option).empty() && !reader.is_given(option.name)) {
      if (chosen)
        throw UserError{option.name + ": not given; -friction_law " + law.name + " needs it: " + law.formula +
                        "; allowed: " + option.allowed()};
      values.emplace_back();
      continue;
    }
    values.push_back(parameter.is_list ? reader.reals(option) : std::vector<double>{reader.real(option)});
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const LawParameter &parameter = law.parameters[k]; parameter.as_long_as >= 0 && !values[k].empty())
      reader.expect_equal_lengths(OptionReader::declared(law.option(parameter)),
                                  OptionReader::declared(law.option(law.parameters[parameter.as_long_as])));
  return values;
}

void expect_possible(const OptionReader &reader, const LawDeclaration &law, const LawValues &values)
{
  if (!law.objection) return;
  const LawObjection objection = law.objection(values);
  if (objection.text.empty()) return;
  const Option &option = OptionReader::declared(law.option(law.parameters[objection.parameter]));
  refuse(option.name, reader.text(option), objection.text);
}

/// Options of friction that are given and do nothing.
void note_idle(const OptionReader &reader, const std::string &chosen, SceneInput &input)
{
  std::string idle;
  for (const OptionGroup &group : declare_friction())
    for (const Option &option : group.options) {
      const bool is_idle = is_of_another_law(option.name, chosen) ||
                           (chosen == none && option.name == "-friction_speed_range") ||
                           (chosen != "table" && option.name == table_file);
      if (is_idle && reader.is_given(option.name)) idle += (idle.empty() ? "" : ", ") + option.name;
    }
  if (!idle.empty()) input.notes.push_back("without effect with -friction_law " + chosen + ": " + idle);
}

/// A floor of the pressure does nothing where tau is proportional to it.
void note_idle_floor(const OptionReader &reader, const LawDeclaration &law, SceneInput &input)
{
  std::string exponent, floor;
  for (const LawParameter &parameter : law.parameters) {
    if (std::string(parameter.name) == "pressure_exponent") exponent = law.option(parameter);
    if (std::string(parameter.name) == "pressure_floor") floor = law.option(parameter);
  }
  if (input.scene.friction.linear_in_pressure() && !floor.empty() && reader.is_given(floor))
    input.notes.push_back("without effect with " + exponent + " 1: " + floor);
}

/// The two columns of a file, each as a list of options.
std::array<std::string, 2> columns_of(const std::string &path)
{
  std::error_code ignored;
  std::ifstream stream(path);
  if (!std::filesystem::is_regular_file(path, ignored) || !stream)
    refuse(table_file, path, "cannot be read; allowed: a text file of two columns, v in mm/s and mu");
  std::array<std::string, 2> columns;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    line.erase(std::remove_if(line.begin(), line.end(), [](char c) { return c == ' ' || c == '\t'; }),
               line.end());
    const auto row = parse_reals(line);
    if (!row.value && columns[0].empty()) continue; // a heading
    if (!row.value || row.value->size() != 2)
      refuse(table_file, path,
             "line " + std::to_string(number) + " is no pair of numbers; allowed: v in mm/s, a comma, mu");
    for (int k = 0; k < 2; ++k) columns[k] += (columns[k].empty() ? "" : ",") + to_text((*row.value)[k]);
  }
  if (columns[0].empty())
    refuse(table_file, path, "holds no numbers; allowed: lines with v in mm/s, a comma, mu");
  return columns;
}

void read_friction(const OptionReader &reader, SceneInput &input)
{
  const std::string chosen = reader.choice("-friction_law");
  const auto speeds = read_speed_range(reader);
  for (const KnownLaw &law : known_laws()) {
    const bool is_chosen = law.declaration->name == chosen;
    const LawValues values = read_values(reader, *law.declaration, is_chosen && input.scene.has_contact());
    const bool complete = std::none_of(values.begin(), values.end(), [](const auto &v) { return v.empty(); });
    if (complete) expect_possible(reader, *law.declaration, values);
    if (!is_chosen || !input.scene.has_contact()) continue;
    input.scene.friction = law.make(values);
    input.scene.friction_speeds = speeds;
    note_idle_floor(reader, *law.declaration, input);
    if (input.scene.friction.law()->may_fall())
      input.notes.push_back(
          "-friction_law = " + chosen +
          ": friction that weakens with speed has unstable sliding states; see whether mu(v) of "
          "these numbers becomes negative at high speed");
  }
  if (input.scene.has_contact()) note_idle(reader, chosen, input);
}

} // namespace

GivenOptions with_friction_table(const GivenOptions &given)
{
  const auto file = given.find(table_file);
  if (file == given.end()) return given;
  if (file->second.empty()) throw UserError{std::string(table_file) + ": value missing; allowed: a path"};
  GivenOptions all = given;
  all.erase(table_file);
  const auto columns = columns_of(file->second);
  const char *const lists[] = {table_speeds, table_coefficients};
  for (int k = 0; k < 2; ++k) {
    const auto list = all.try_emplace(lists[k], columns[k]).first;
    if (parse_reals(list->second).value != parse_reals(columns[k]).value)
      refuse(table_file, file->second,
             "has other numbers than " + list->first + " = " + list->second + "; allowed: one of them");
  }
  return all;
}

bool is_of_another_law(const std::string &option, const std::string &chosen)
{
  for (const KnownLaw &law : known_laws())
    for (const LawParameter &parameter : law.declaration->parameters)
      if (law.declaration->option(parameter) == option) return law.declaration->name != chosen;
  return false;
}

OptionSubject friction_options()
{
  return {declare_friction, read_friction};
}

} // namespace tribogel
