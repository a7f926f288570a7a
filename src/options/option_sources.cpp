#include "options/option_sources.hpp"

#include "options/option_order.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace tribogel
{

namespace
{

/// The same text on all processes.
void share(std::string &text)
{
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
}

/// Four texts an option; none of them can hold a byte 0.
std::string packed(const std::vector<GivenOption> &options)
{
  std::string text;
  for (const GivenOption &option : options)
    for (const std::string &part : {option.name, option.value, option.source, std::to_string(option.line)})
      text += part + '\0';
  return text;
}

std::vector<GivenOption> unpacked(const std::string &text)
{
  std::vector<GivenOption> options;
  std::istringstream stream(text);
  GivenOption option;
  for (std::string line; std::getline(stream, option.name, '\0') &&
                         std::getline(stream, option.value, '\0') &&
                         std::getline(stream, option.source, '\0') && std::getline(stream, line, '\0');) {
    option.line = std::stoi(line);
    options.push_back(option);
  }
  return options;
}

std::string variable(const char *name)
{
  const char *text = std::getenv(name);
  return text ? text : "";
}

} // namespace

bool OptionSources::on_command_line(const std::string &name) const
{
  return std::any_of(options.begin(), options.end(), [&](const GivenOption &option) {
    return option.source == command_line_source && same_name(option.name, name);
  });
}

std::vector<std::string> OptionSources::words(const std::string &program) const
{
  std::vector<std::string> words{program};
  for (const GivenOption &option : options) {
    words.push_back(option.name);
    if (!option.value.empty()) words.push_back(option.value);
  }
  return words;
}

OptionSources read_sources(const CommandLine &line)
{
  OptionSources sources;
  std::string complaint, options;
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) {
    try {
      if (!variable("PETSC_OPTIONS_YAML").empty())
        throw UserError{"PETSC_OPTIONS_YAML: YAML is not read, it keeps no order; allowed: PETSC_OPTIONS, or "
                        "-options_file"};
      std::vector<GivenOption> found =
          all_options(line, variable("PETSC_OPTIONS"), unasked_options_files(line));
      sources.notes = keep_later(found);
      for (const std::string &note : notes_on_sources(found)) sources.notes.push_back(note);
      options = packed(found);
    } catch (const UserError &error) {
      complaint = error.text;
    }
  }
  share(complaint);
  if (!complaint.empty()) throw UserError{complaint};
  share(options);
  sources.options = unpacked(options);
  return sources;
}

UserError located(const UserError &error, const OptionSources &sources)
{
  for (auto option = sources.options.rbegin(); option != sources.options.rend(); ++option) {
    if (!error.text.starts_with(option->name + " = ") && !error.text.starts_with(option->name + ": "))
      continue;
    return option->source == command_line_source ? error
                                                 : UserError{error.text + " (" + option->place() + ")"};
  }
  return error;
}

} // namespace tribogel
