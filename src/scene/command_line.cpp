#include "scene/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace tribogel
{

namespace
{

std::string lower_case(std::string text)
{
  for (char &c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> split(const std::string &text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

HelpRequest help_kind(const std::string &value)
{
  if (value.empty()) return HelpRequest::table;
  if (value == "petsc") return HelpRequest::petsc;
  if (value == "markdown") return HelpRequest::markdown;
  throw UserError{"-help = " + value + ": allowed: nothing, petsc or markdown"};
}

/// -help and -version are questions to the program, not settings.
void refuse_question(const std::string &name, const std::string &place)
{
  if (name == "-help" || name == "-h" || name == "-version")
    throw UserError{name + ": stands " + place + "; allowed: on the command line only"};
}

[[noreturn]] void refuse_stray(const std::string &word, const std::string &place, const std::string &before)
{
  throw UserError{word + ": stray word " + place + (before.empty() ? "" : " after " + before) +
                  "; allowed: -option or -option value, commas and no blanks in lists"};
}

bool is_yaml(const std::string &path)
{
  return path.ends_with(".yml") || path.ends_with(".yaml");
}

/// Control characters other than blanks: a byte 0 would end PETSc's copy of the line.
bool is_text(const std::string &line)
{
  return std::none_of(line.begin(), line.end(), [](unsigned char c) { return std::iscntrl(c) && !std::isspace(c); });
}

void check_options_file(const std::string &path, std::vector<std::string> opened)
{
  if (std::find(opened.begin(), opened.end(), path) != opened.end())
    throw UserError{"-options_file = " + path + ": the file names itself; allowed: files that do not form a circle"};
  opened.push_back(path);
  const auto unreadable = [&](const std::string &why) {
    throw UserError{"-options_file = " + path + ": " + why + "; allowed: a readable text file of options"};
  };
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::directory) unreadable("is a directory");
  if (std::filesystem::exists(path, ignored) && kind != std::filesystem::file_type::regular)
    unreadable("is a device or a pipe, which cannot be read twice");
  std::ifstream file(path);
  if (!file) unreadable(std::strerror(errno));
  if (is_yaml(path)) return;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (!is_text(line)) unreadable("line " + std::to_string(number) + " is no text");
    const std::vector<std::string> words = split(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    const std::string place = "in options file " + path + " line " + std::to_string(number);
    if (!is_option_name(words[0])) refuse_stray(words[0], place, "");
    refuse_question(words[0], place);
    if (words.size() > 2) refuse_stray(words[2], place, words[0] + " = " + words[1]);
    if (words[0] == "-options_file") {
      if (words.size() < 2) throw UserError{"-options_file: value missing " + place + "; allowed: a path"};
      check_options_file(words[1], opened);
    }
  }
  if (file.bad()) unreadable(std::strerror(errno));
}

} // namespace

bool is_option_name(const std::string &word)
{
  if (word.size() < 2 || word[0] != '-') return false;
  const std::size_t first = word[1] == '-' ? 2 : 1;
  if (first >= word.size() || !std::isalpha(static_cast<unsigned char>(word[first]))) return false;
  char *end = nullptr;
  std::strtod(word.c_str(), &end);
  return end == word.c_str() || *end == '_' || std::isalnum(static_cast<unsigned char>(*end));
}

CommandLine read_command_line(const std::vector<std::string> &words)
{
  CommandLine line;
  if (words.empty()) return line;
  line.words.push_back(words[0]);
  std::vector<std::string> prefixes; // of -prefix_push
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string &name = words[i];
    if (!is_option_name(name))
      refuse_stray(name, "on the command line",
                   i > 2 && is_option_name(words[i - 2]) ? words[i - 2] + " = " + words[i - 1] : "");
    const bool has_value = i + 1 < words.size() && !is_option_name(words[i + 1]);
    const std::string value = has_value ? words[++i] : "";
    if (name == "-help" || name == "-h" || name == "--help") {
      line.help = help_kind(value);
      if (line.help == HelpRequest::petsc) line.words.push_back("-help");
    } else if (name == "-version" || name == "--version") {
      if (has_value) throw UserError{"-version = " + value + ": allowed: nothing"};
      line.help = HelpRequest::version;
    } else {
      line.words.push_back(name);
      if (has_value) line.words.push_back(value);
      if (name == "-options_file") {
        if (!has_value) throw UserError{"-options_file: value missing; allowed: a path"};
        line.options_files.push_back(value);
      } else if (name == "-prefix_push") {
        prefixes.push_back(value);
      } else if (name == "-prefix_pop") {
        if (prefixes.empty()) throw UserError{"-prefix_pop: allowed: after a -prefix_push"};
        prefixes.pop_back();
      } else {
        std::string full;
        for (const std::string &prefix : prefixes) full += prefix;
        line.names.insert(lower_case(full + name.substr(1)));
      }
    }
  }
  return line;
}

void check_environment_options(const std::string &text)
{
  std::string name, value;
  for (const std::string &word : split(text)) {
    if (is_option_name(word)) {
      refuse_question(word, "in PETSC_OPTIONS");
      name = word;
      value.clear();
      continue;
    }
    if (name.empty() || !value.empty())
      refuse_stray(word, "in PETSC_OPTIONS", name.empty() ? "" : name + " = " + value);
    value = word;
  }
}

void check_options_file(const std::string &path)
{
  check_options_file(path, {});
}

std::vector<std::string> standing_options_files()
{
  std::vector<std::string> files = {".petscrc", "petscrc"};
  if (const char *home = std::getenv("HOME")) files.insert(files.begin(), std::string(home) + "/.petscrc");
  std::error_code ignored;
  std::erase_if(files, [&](const std::string &path) { return !std::filesystem::is_regular_file(path, ignored); });
  return files;
}

} // namespace tribogel
