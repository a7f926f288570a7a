/// All options that were given: read by the first process, known to all, before there is PETSc.
#pragma once

#include "support/command_line.hpp"

#include <string>
#include <vector>

namespace tribogel
{

/// All that was said, in its order, and what is to be noted of that.
struct OptionSources {
  std::vector<GivenOption> options;
  std::vector<std::string> notes; ///< on the first process only

  bool on_command_line(const std::string &name) const;
  std::vector<std::string> words(const std::string &program) const; ///< for PETSc
};

/// Reads files and environment on the first process; throws UserError on all. Collective on MPI_COMM_WORLD,
/// needs no PETSc.
OptionSources read_sources(const CommandLine &line);

/// The same error, which also says where the option was read that it begins with, unless that is the command
/// line.
UserError located(const UserError &error, const OptionSources &sources);

} // namespace tribogel
