#include "scene/output_directory.hpp"

#include "scene/user_error.hpp"

#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>

#include <unistd.h>

namespace tribogel
{

namespace
{

namespace fs = std::filesystem;

/// Runs `work` on the first process and throws its complaint, if any, on all of them.
PetscErrorCode OnFirstProcess(MPI_Comm comm, const std::function<std::string()> &work)
{
  PetscFunctionBeginUser;
  PetscMPIInt rank;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  std::string complaint = rank == 0 ? work() : "";
  int length = static_cast<int>(complaint.size());
  PetscCallMPI(MPI_Bcast(&length, 1, MPI_INT, 0, comm));
  complaint.resize(static_cast<std::size_t>(length));
  PetscCallMPI(MPI_Bcast(complaint.data(), length, MPI_CHAR, 0, comm));
  if (length > 0) throw UserError{complaint};
  PetscFunctionReturn(0);
}

std::string option_text(const OutputParameters &output)
{
  return "-output_directory = " + output.directory + ": ";
}

/// The path itself or the nearest one above it that exists.
fs::path nearest_existing(const fs::path &path)
{
  std::error_code ignored;
  fs::path here = fs::absolute(path, ignored);
  while (!fs::exists(here, ignored) && here.has_parent_path() && here.parent_path() != here) here = here.parent_path();
  return here;
}

std::string make_directory(const OutputParameters &output)
{
  std::error_code failed;
  fs::create_directories(output.directory, failed);
  if (!failed)
    for (const char *file : run_files) {
      fs::remove(fs::path(output.directory) / file, failed);
      if (failed) break;
    }
  return failed ? option_text(output) + failed.message() + "; allowed: a directory that can be made and written" : "";
}

} // namespace

std::string objection_to(const OutputParameters &output)
{
  const std::string allowed = "; allowed: a directory that can be made and written";
  std::error_code ignored;
  const fs::path existing = nearest_existing(output.directory);
  if (!fs::is_directory(existing, ignored))
    return option_text(output) + existing.string() + " is not a directory" + allowed;
  if (access(existing.c_str(), W_OK | X_OK) != 0)
    return option_text(output) + existing.string() + ": " + std::strerror(errno) + allowed;
  if (!output.overwrite)
    for (const char *file : run_files)
      if (fs::exists(fs::path(output.directory) / file, ignored))
        return option_text(output) + "holds a run (" + file + "); allowed: a directory without one, or -overwrite";
  return {};
}

PetscErrorCode CheckOutputDirectory(MPI_Comm comm, const OutputParameters &output)
{
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, [&] { return objection_to(output); }));
  PetscFunctionReturn(0);
}

PetscErrorCode PrepareOutputDirectory(MPI_Comm comm, const OutputParameters &output)
{
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, [&] { return make_directory(output); }));
  PetscFunctionReturn(0);
}

} // namespace tribogel
