#include "options/petsc_options.hpp"

#include "options/material_options.hpp"
#include "options/nearest_name.hpp"
#include "options/option_table.hpp"
#include "options/petsc_limits.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <sstream>

namespace tribogel
{

namespace
{

struct LeftOption {
  std::string name, text; ///< name without the first dash
};

/// Options in the database that nothing has asked for.
PetscErrorCode GetLeftOptions(std::vector<LeftOption> &left)
{
  PetscInt count;
  char **names, **texts;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsLeftGet(nullptr, &count, &names, &texts));
  for (PetscInt i = 0; i < count; ++i) left.push_back({names[i], texts[i] ? texts[i] : ""});
  PetscCall(PetscOptionsLeftRestore(nullptr, &count, &names, &texts));
  PetscFunctionReturn(0);
}

PetscErrorCode GetOption(const std::string &name, GivenOptions &given, bool &found)
{
  const char *text = nullptr;
  PetscBool set;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsFindPair(nullptr, nullptr, name.c_str(), &text, &set));
  if (set) given[name] = text ? text : "";
  found = set;
  PetscFunctionReturn(0);
}

std::string without_dashes(const std::string &name)
{
  const std::size_t first = name.find_first_not_of('-');
  std::string text = first == std::string::npos ? "" : name.substr(first);
  for (char &c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// First words of our names, in use or kept for us; no option of PETSc begins like that.
bool begins_like_ours(const std::string &name)
{
  static const char *const words[] = {"model",     "task",       "specimens", "top",      "bottom",
                                      "initial",   "plate",      "friction",  "schedule", "element",
                                      "elements",  "contact",    "maxwell",   "time",     "output",
                                      "overwrite", "checkpoint", "restart",   "wall",     "phase"};
  const std::string plain = without_dashes(name);
  const std::string first = plain.substr(0, plain.find_first_of("_="));
  return std::any_of(std::begin(words), std::end(words), [&](const char *word) { return first == word; }) ||
         plain.starts_with("mesh_") || plain == "error_estimate";
}

std::string with_value(const std::string &name, const std::string &text)
{
  return "-" + name + (text.empty() ? "" : " = " + text);
}

std::string unknown_text(const std::string &name, const std::string &text,
                         const std::vector<std::string> &known)
{
  static const std::regex branch(
      "(top|bottom)_maxwell([0-9]+)_(ogden_moduli|ogden_exponents|bulk_modulus|viscosities)");
  if (std::regex_match(without_dashes(name), branch))
    return with_value(name, text) +
           ": no branch of that number; allowed: -top_maxwell_..., -top_maxwell2_..., "
           "-top_maxwell3_... and so on (likewise bottom), numbered without gaps";
  const std::string nearest =
      nearest_name("-" + without_dashes(name), known, std::max(4, plausible_distance(name)));
  return with_value(name, text) + ": unknown option; allowed: the names in -help and -help petsc" +
         (nearest.empty() ? "" : "; the nearest is " + nearest);
}

/// Our names, the ones PETSc reads at its start, and those in its help texts, where each stands as
/// "  -name: <default> ..." or "  -name <now default> ...".
std::vector<std::string> all_names(const std::string &help)
{
  std::vector<std::string> names = option_names();
  for (const char *name : {"-options_file", "-options_left", "-options_view", "-log_view", "-malloc_debug",
                           "-malloc_dump", "-memory_view", "-info", "-skip_petscrc", "-help"})
    names.push_back(name);
  std::istringstream words(help);
  for (std::string word; words >> word;) {
    word.resize(std::min(word.find_first_of(":<,"), word.size()));
    if (is_option_name(word)) names.push_back(word);
  }
  return names;
}

/// PETSc passes over an option that wants a number and has none. Those that do show a number in their help.
PetscErrorCode ExpectNumbers(const std::string &help)
{
  static const std::regex entry("^ +(-\\w+):? <(now )?[-+]?[.0-9]");
  std::istringstream lines(help);
  PetscFunctionBeginUser;
  for (std::string line; std::getline(lines, line);) {
    std::smatch parts;
    GivenOptions given;
    bool found;
    if (!std::regex_search(line, parts, entry)) continue;
    const std::string name = parts[1];
    PetscCall(GetOption(name, given, found));
    if (found && given[name].empty())
      throw UserError{name + ": value missing; allowed: a number, see -help petsc"};
  }
  PetscFunctionReturn(0);
}

} // namespace

bool is_read_late(const std::string &name)
{
  static const char *const exact[] = {
      "citations", "get_total_flops", "mpidump", "objects_dump",  "options_left",      "help",
      "h",         "skip_petscrc",    "nox",     "saved_options", "snes_test_jacobian"};
  for (const char *word : exact)
    if (name == word) return true;
  for (const char *stem :
       {"options_view", "options_monitor", "malloc", "log_", "memory_", "info", "history", "checkstack"})
    if (name.starts_with(stem)) return true;
  for (const char *stem :
       {"ts_", "snes_", "ksp_", "pc_", "mat_", "vec_", "dm_", "sub_", "mg_", "fieldsplit_"})
    if (name.starts_with(stem) &&
        (name.find("_view") != std::string::npos || name.ends_with("_converged_reason")))
      return true;
  return false;
}

PetscErrorCode ReadGivenOptions(GivenOptions &given)
{
  bool found;
  std::vector<LeftOption> left;
  PetscFunctionBeginUser;
  for (const std::string &name : option_names()) PetscCall(GetOption(name, given, found));
  for (const std::string body : {"top", "bottom"}) {
    bool any = true;
    for (int branch = 2; any; ++branch) {
      any = false;
      for (const std::string &name : branch_names(body, branch).all()) {
        PetscCall(GetOption(name, given, found));
        any = any || found;
      }
    }
  }
  PetscCall(GetLeftOptions(left));
  for (const LeftOption &option : left) {
    const std::string plain = "-" + without_dashes(option.name);
    if (begins_like_ours(option.name) ||
        !nearest_name(plain, option_names(), plausible_distance(plain)).empty())
      throw UserError{unknown_text(option.name, option.text, option_names())};
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ReadScene(const OptionSources &sources, SceneInput &input)
{
  GivenOptions given, of_petsc;
  bool found;
  PetscFunctionBeginUser;
  PetscCall(ReadGivenOptions(given));
  for (const std::string &name : limited_petsc_options()) PetscCall(GetOption(name, of_petsc, found));
  for (const auto &[name, value] : of_petsc) check_petsc_option(name, value);
  input = scene_from_options(given);
  input.notes.insert(input.notes.begin(), sources.notes.begin(),
                     sources.notes.end()); // the first process has them
  const auto tolerance = of_petsc.find("-ts_atol"), control = of_petsc.find("-ts_adapt_type");
  if (tolerance != of_petsc.end() && !given.count("-time_tolerance"))
    input.notes.push_back("-ts_atol = " + tolerance->second +
                          ": the steps follow it in place of -time_tolerance");
  if (control != of_petsc.end() && control->second == "none")
    input.notes.push_back("-ts_adapt_type = none: the steps are as long as each phase's first (-ts_dt) and "
                          "follow no tolerance");
  PetscFunctionReturn(0);
}

PetscErrorCode CheckUnusedOptions(const OptionSources &sources, const std::string &petsc_help,
                                  std::vector<std::string> &warnings)
{
  std::vector<LeftOption> left;
  PetscFunctionBeginUser;
  PetscCall(ExpectNumbers(petsc_help));
  PetscCall(GetLeftOptions(left));
  for (const LeftOption &option : left) {
    if (is_read_late(without_dashes(option.name))) continue;
    if (!sources.on_command_line("-" + option.name)) {
      warnings.push_back(with_value(option.name, option.text) +
                         " (from a file or PETSC_OPTIONS) was read by no part of the program");
      continue;
    }
    throw UserError{unknown_text(option.name, option.text, all_names(petsc_help))};
  }
  PetscFunctionReturn(0);
}

std::vector<std::pair<std::string, std::string>> resolved_options(const SceneInput &input)
{
  std::vector<std::pair<std::string, std::string>> all = input.options;
  const char *environment = std::getenv("PETSC_OPTIONS");
  all.emplace_back("PETSC_OPTIONS", environment ? environment : "");
  char *text = nullptr;
  if (PetscOptionsGetAll(nullptr, &text) != 0) return all;
  std::istringstream words(text ? text : "");
  bool own = true;
  for (std::string word; words >> word;) {
    if (is_option_name(word)) {
      own = std::any_of(input.options.begin(), input.options.end(),
                        [&](const auto &option) { return option.first == without_dashes(word); });
      if (!own) all.emplace_back(word.substr(1), "");
    } else if (!own) {
      all.back().second += (all.back().second.empty() ? "" : " ") + word;
    }
  }
  PetscFree(text);
  return all;
}

} // namespace tribogel
