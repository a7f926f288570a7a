/// The words of the command line and of options files, judged before PETSc reads them: PETSc drops a stray word in
/// silence, and an error it meets on one process only would leave the others waiting. Pure but for reading files.
#pragma once

#include "scene/user_error.hpp"

#include <set>
#include <string>
#include <vector>

namespace tribogel
{

enum class HelpRequest { none, table, petsc, markdown, version };

struct CommandLine {
  std::vector<std::string> words; ///< for PETSc: argv[0], then all but -help and -version; -help for -help petsc
  std::set<std::string> names;    ///< options given here (not in files), lower case, without the first dash
  std::vector<std::string> options_files; ///< in their order
  HelpRequest help = HelpRequest::none;
};

/// PETSc's rule: one or two dashes and a letter; "-.5", "-3e4", "-inf" and "-nan" are values.
bool is_option_name(const std::string &word);

/// Throws UserError for a stray word, an unknown kind of -help, a missing file name.
CommandLine read_command_line(const std::vector<std::string> &words);

/// Throws UserError for a stray word in the environment variable PETSC_OPTIONS.
void check_environment_options(const std::string &text);

/// Throws UserError if the file cannot be read or a line is not "-name", "-name value", a comment or empty. Files named
/// in it are checked as well. YAML files (.yml, .yaml) are checked for being readable only.
void check_options_file(const std::string &path);

/// Those that PETSc reads unasked, unless -skip_petscrc is given: ~/.petscrc, .petscrc and petscrc, as far as they
/// exist.
std::vector<std::string> standing_options_files();

} // namespace tribogel
