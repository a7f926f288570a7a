#include "observe/output_directory.hpp"

#include "support/first_process.hpp"

#include <cstring>
#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace tribogel
{

namespace
{

namespace fs = std::filesystem;

std::string option_text(const OutputSettings &output)
{
  return "-output_directory = " + output.directory + ": ";
}

/// The path itself or the nearest one above it that exists.
fs::path nearest_existing(const fs::path &path)
{
  std::error_code ignored;
  fs::path here = fs::absolute(path, ignored);
  while (!fs::exists(here, ignored) && here.has_parent_path() && here.parent_path() != here)
    here = here.parent_path();
  return here;
}

/// What was made on the way to a directory that could not be made goes again.
void remove_made(fs::path path, const fs::path &existing)
{
  std::error_code ignored;
  for (; path != existing && path.has_relative_path(); path = path.parent_path()) fs::remove(path, ignored);
}

std::string make_directory(const OutputSettings &output)
{
  std::error_code failed, ignored;
  const fs::path existing = nearest_existing(output.directory);
  fs::create_directories(output.directory, failed);
  if (failed) remove_made(fs::absolute(output.directory, ignored), existing);
  if (!failed)
    for (const char *file : run_files) {
      if (output.restart && std::string(file) != "summary.json")
        continue; // that of the run which has stopped
      fs::remove(fs::path(output.directory) / file, failed);
      if (failed) break;
    }
  return failed
             ? option_text(output) + failed.message() + "; allowed: a directory that can be made and written"
             : "";
}

} // namespace

std::string objection_to(const OutputSettings &output)
{
  const std::string allowed = "; allowed: a directory that can be made and written";
  std::error_code ignored;
  const fs::path existing = nearest_existing(output.directory);
  if (!fs::is_directory(existing, ignored))
    return option_text(output) + existing.string() + " is not a directory" + allowed;
  if (access(existing.c_str(), W_OK | X_OK) != 0)
    return option_text(output) + existing.string() + ": " + std::strerror(errno) + allowed;
  if (!output.overwrite && !output.restart)
    for (const char *file : run_files)
      if (fs::exists(fs::path(output.directory) / file, ignored))
        return option_text(output) + "holds a run (" + file +
               "); allowed: a directory without one, or -overwrite";
  return {};
}

PetscErrorCode CheckOutputDirectory(MPI_Comm comm, const OutputSettings &output)
{
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, [&] { return objection_to(output); }));
  PetscFunctionReturn(0);
}

PetscErrorCode PrepareOutputDirectory(MPI_Comm comm, const OutputSettings &output)
{
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, [&] { return make_directory(output); }));
  PetscFunctionReturn(0);
}

} // namespace tribogel
