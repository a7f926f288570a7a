#include "support/command_line.hpp"

#include "support/characters.hpp"
#include "support/options_text.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

namespace tribogel
{

namespace
{

std::string lower_case(std::string text)
{
  for (char &c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_one_of(const std::string &name, std::initializer_list<const char *> names)
{
  return std::any_of(names.begin(), names.end(), [&](const char *other) { return same_name(name, other); });
}

HelpRequest help_kind(const std::string &value)
{
  if (value.empty()) return HelpRequest::table;
  if (value == "petsc") return HelpRequest::petsc;
  if (value == "markdown") return HelpRequest::markdown;
  if (value == "columns") return HelpRequest::columns;
  throw UserError{"-help = " + value + ": allowed: nothing, petsc, columns or markdown"};
}

/// What somebody may have meant who wrote a word without an option.
std::string way_out(const std::string &word)
{
  std::error_code ignored;
  if (std::filesystem::is_regular_file(word, ignored))
    return "it is a file; allowed: " +
           std::string(word.ends_with(".msh") ? "-mesh_file " : "-options_file ") + word;
  if (std::filesystem::exists(word + "/checkpoint.h5", ignored))
    return "it is the directory of a run; allowed: -restart " + word + " to continue it";
  const std::string odd = word.empty() ? "" : foreign_character(word.substr(0, 4));
  const bool begins_oddly = !odd.empty() && static_cast<unsigned char>(word[0]) > '~';
  return (begins_oddly ? "it begins with " + odd + "; " : "") +
         "allowed: -option or -option value, commas and no blanks in lists";
}

[[noreturn]] void refuse_stray(const std::string &word, const std::string &place, const std::string &before)
{
  const std::string way = way_out(word);
  throw UserError{(word.empty() ? "an empty word" : shown(word)) + ": stray word " + place +
                  (before.empty() ? "" : " after " + before) + (way.starts_with("it ") ? ": " : "; ") + way};
}

bool is_yaml(const std::string &path)
{
  return path.ends_with(".yml") || path.ends_with(".yaml") || path.ends_with(":yaml");
}

void check_characters(const GivenOption &option)
{
  const std::string head =
      shown(option.name) + (option.value.empty() ? "" : " = " + shown(option.value)) + ": ";
  if (const std::string odd = foreign_character(option.name); !odd.empty())
    throw UserError{head + "the option's name holds " + odd + ", " + option.place() +
                    "; allowed: letters, digits, _ and - in names, a blank or a tab after them"};
  if (const std::size_t sign = option.name.find('='); sign != std::string::npos)
    throw UserError{option.name + ": unknown option " + option.place() +
                    "; allowed: " + option.name.substr(0, sign) + " " + option.name.substr(sign + 1) +
                    ", with a blank in place of the equals sign"};
  if (const std::string odd = unreadable_character(option.value); !odd.empty())
    throw UserError{head + "the value holds " + odd + ", " + option.place() +
                    "; allowed: characters that can be seen, in UTF-8"};
}

/// Words as options: a name, and the word after it if that is no name. All have the source of `from`.
std::vector<GivenOption> paired(const std::vector<std::string> &words, const GivenOption &from)
{
  std::vector<GivenOption> options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!is_option_name(words[i]))
      refuse_stray(words[i], from.place(),
                   options.empty() ? "" : options.back().name + " = " + options.back().value);
    options.push_back(from);
    options.back().name = words[i];
    if (i + 1 == words.size() || is_option_name(words[i + 1])) continue;
    options.back().value = words[++i];
    if (options.back().value.empty())
      throw UserError{words[i - 1] + ": value missing, an empty word stands in its place " + from.place() +
                      "; allowed: a value, or the option alone"};
  }
  return options;
}

/// Puts options into their order and reads the files that are named among them.
class Collector
{
public:
  std::vector<GivenOption> options;

  void take(GivenOption option)
  {
    check_characters(option);
    if (is_one_of(option.name, {"-help", "--help", "-h", "-version", "--version"}))
      throw UserError{option.name + ": stands " + option.place() + "; allowed: on the command line only"};
    if (is_one_of(option.name, {"-options_file", "-options_file_yaml", "-options_string_yaml"})) {
      take_file(option);
    } else if (same_name(option.name, "-prefix_push")) {
      if (option.value.empty())
        throw UserError{"-prefix_push: value missing " + option.place() +
                        "; allowed: how the names that follow begin"};
      prefixes.push_back(option.value);
    } else if (same_name(option.name, "-prefix_pop")) {
      if (prefixes.empty())
        throw UserError{"-prefix_pop: stands " + option.place() + "; allowed: after a -prefix_push"};
      prefixes.pop_back();
    } else {
      std::string prefix;
      for (const std::string &part : prefixes) prefix += part;
      option.name.insert(1, prefix);
      options.push_back(std::move(option));
    }
  }

  void take_words(const std::vector<std::string> &words, const GivenOption &from)
  {
    for (const GivenOption &option : paired(words, from)) take(option);
  }

  /// `named`: how a refusal of the whole file begins.
  void read_file(const std::string &path, const std::string &named, bool unasked)
  {
    if (std::find(opened.begin(), opened.end(), path) != opened.end())
      throw UserError{named + ": the file names itself; allowed: files that do not form a circle"};
    opened.push_back(path);
    const std::size_t before = prefixes.size();
    for (const TextLine &line : lines_of_file(path, named)) {
      const GivenOption from{
          .name = "", .value = "", .source = "options file " + path, .line = line.number, .unasked = unasked};
      const std::vector<GivenOption> found = paired(words_of_line(line.text, from.place()), from);
      if (found.size() > 1)
        throw UserError{found[1].name + ": stands " + from.place() + " beside " + found[0].name +
                        "; allowed: one option a line"};
      if (!found.empty()) take(found[0]);
    }
    if (prefixes.size() != before)
      throw UserError{
          named +
          ": -prefix_push and -prefix_pop do not balance; allowed: as many of the one as of the other"};
    opened.pop_back();
  }

private:
  void take_file(const GivenOption &option)
  {
    if (option.value.empty())
      throw UserError{option.name + ": value missing " + option.place() + "; allowed: a path"};
    const std::string named = option.name + " = " + option.value;
    if (!same_name(option.name, "-options_file") || is_yaml(option.value))
      throw UserError{named + ": YAML is not read, it keeps no order; allowed: -options_file with lines of "
                              "the form -option value"};
    read_file(option.value, named, option.unasked);
  }

  std::vector<std::string> prefixes, opened;
};

} // namespace

std::string GivenOption::place() const
{
  if (source == command_line_source) return "on the command line";
  return "in " + source + (line > 0 ? " line " + std::to_string(line) : "");
}

bool is_option_name(const std::string &word)
{
  if (word.size() < 2 || word[0] != '-') return false;
  const std::size_t first = word[1] == '-' ? 2 : 1;
  if (first >= word.size() || !std::isalpha(static_cast<unsigned char>(word[first]))) return false;
  char *end = nullptr;
  std::strtod(word.c_str(), &end);
  return end == word.c_str() || *end == '_' || std::isalnum(static_cast<unsigned char>(*end));
}

bool same_name(const std::string &a, const std::string &b)
{
  return lower_case(a) == lower_case(b);
}

CommandLine read_command_line(const std::vector<std::string> &words)
{
  CommandLine line;
  const std::vector<std::string> after_program(words.begin() + std::min<std::ptrdiff_t>(1, std::ssize(words)),
                                               words.end());
  for (const GivenOption &option : paired(after_program, {})) {
    if (is_one_of(option.name, {"-help", "--help", "-h"})) {
      line.help = help_kind(option.value);
    } else if (is_one_of(option.name, {"-version", "--version"})) {
      if (!option.value.empty()) throw UserError{"-version = " + option.value + ": allowed: nothing"};
      line.help = HelpRequest::version;
    } else {
      line.options.push_back(option);
    }
  }
  return line;
}

std::vector<GivenOption> all_options(const CommandLine &line, const std::string &environment,
                                     const std::vector<std::string> &unasked_files)
{
  Collector collector;
  for (const std::string &path : unasked_files) collector.read_file(path, path, true);
  const GivenOption from{.name = "", .value = "", .source = environment_source, .unasked = true};
  collector.take_words(words_of_line(environment, from.place()), from);
  for (const GivenOption &option : line.options) collector.take(option);
  return collector.options;
}

std::vector<std::string> unasked_options_files(const CommandLine &line)
{
  for (const GivenOption &option : line.options)
    if (same_name(option.name, "-skip_petscrc")) return {};
  std::vector<std::string> files = {".petscrc", "petscrc"};
  if (const char *home = std::getenv("HOME")) files.insert(files.begin(), std::string(home) + "/.petscrc");
  std::error_code ignored;
  std::erase_if(files,
                [&](const std::string &path) { return !std::filesystem::is_regular_file(path, ignored); });
  return files;
}

} // namespace tribogel
