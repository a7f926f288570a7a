/// Where options come from: the command line, options files, the environment. All of them are read here, by
/// one set of rules, and PETSc is handed words only: it drops a stray word in silence, ends a line elsewhere,
/// forgets the order, and an error that it meets on one process only would leave the others waiting. Pure but
/// for reading files.
#pragma once

#include "support/user_error.hpp"

#include <string>
#include <vector>

namespace tribogel
{

enum class HelpRequest { none, table, petsc, markdown, columns, version };

inline constexpr const char *command_line_source = "the command line", *environment_source = "PETSC_OPTIONS";

/// One option as it was given.
struct GivenOption {
  std::string name, value; ///< the name with its dash and the prefixes in force; value empty: none
  std::string source = command_line_source; ///< that, PETSC_OPTIONS, or "options file " and its path
  int line = 0;                             ///< of the file, from 1
  bool unasked = false;                     ///< from a file or a variable that is read without being named

  std::string place() const; ///< "on the command line", "in options file a.opts line 3"
};

struct CommandLine {
  std::vector<GivenOption> options; ///< all but -help and -version, in their order; files not yet read
  HelpRequest help = HelpRequest::none;
};

/// PETSc's rule: one or two dashes and a letter; "-.5", "-3e4", "-inf" and "-nan" are values.
bool is_option_name(const std::string &word);

/// Names are the same whatever their case.
bool same_name(const std::string &a, const std::string &b);

/// Throws UserError for a stray word and an unknown kind of -help.
CommandLine read_command_line(const std::vector<std::string> &words);

/// All options, what counts less first: those of the files that are read unasked, of the variable
/// PETSC_OPTIONS, of the command line, with those of a file where -options_file stands. Throws UserError for
/// a file that cannot be read or is no UTF-8 text, a line that is not "-name", "-name value", a comment or
/// empty, a stray word, characters that are not what they look like.
std::vector<GivenOption> all_options(const CommandLine &line, const std::string &environment,
                                     const std::vector<std::string> &unasked_files);

/// Those that PETSc too would read unasked: ~/.petscrc, .petscrc and petscrc, as far as they exist; none with
/// -skip_petscrc.
std::vector<std::string> unasked_options_files(const CommandLine &line);

} // namespace tribogel
