#include "support/petsc_session.hpp"

#include "support/exit_status.hpp"

#include <algorithm>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <string_view>
#include <thread>
#include <utility>

namespace tribogel
{

namespace
{

// PETSc's handlers are plain C functions, and there is one PETSc in a process: so is their state.
int status_of_errors = exit_status::bad_input;
std::string caught_help;
PetscErrorCode (*const print_as_ever)(FILE *, const char[], std::va_list) = PetscVFPrintf;

int rank_in_world()
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

/// The options in the database whose value is a word of the message: PETSc does not say which one it could not read.
std::string options_with_value_in(const std::string &message)
{
  char *all = nullptr;
  PetscBool ready = PETSC_FALSE;
  PetscInitialized(&ready);
  if (!ready || PetscOptionsGetAll(nullptr, &all) != 0 || !all) return {};
  const auto split = [](const std::string &text) {
    std::istringstream stream(text);
    return std::vector<std::string>{std::istream_iterator<std::string>(stream), {}};
  };
  const std::vector<std::string> words = split(all), said = split(message);
  PetscFree(all);
  std::string found;
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i - 1][0] == '-' && std::find(said.begin(), said.end(), words[i]) != said.end())
      found += (found.empty() ? "" : ", ") + words[i - 1] + " = " + words[i];
  return found;
}

void catch_text(const char format[], std::va_list list)
{
  std::va_list again;
  va_copy(again, list);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  if (length <= 0) return;
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  std::vsnprintf(text.data(), text.size(), format, list);
  text.pop_back();
  caught_help += text;
}

PetscErrorCode CatchHelp(MPI_Comm, const char format[], ...)
{
  std::va_list list;
  va_start(list, format);
  catch_text(format, list);
  va_end(list);
  return 0;
}

/// PETSc's lists of types, "  -ksp_type <now gmres ...> (one of) cg ...\n", bypass PetscHelpPrintf: several calls make
/// up the line, and the first and the last are known by their formats. All else is printed as ever.
PetscErrorCode CatchTypeLists(FILE *file, const char format[], std::va_list list)
{
  static bool inside = false;
  const std::string_view text = format;
  if (file == PETSC_STDOUT && text.ends_with("(one of)")) inside = true;
  if (!inside) return print_as_ever(file, format, list);
  catch_text(format, list);
  if (text.ends_with('\n')) inside = false;
  return 0;
}

/// One line: PETSc's messages may have several.
std::string flattened(const char *message)
{
  std::string text = message ? message : "";
  for (char &c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// An error known to all processes is printed by the first one and returned up to main on all. One that a single
/// process meets, e.g. while it reads a file for the others, would leave them waiting: it ends the program. The pause
/// lets the first process, if it has the same error, speak for all.
PetscErrorCode ReportError(MPI_Comm comm, int, const char *function, const char *file, PetscErrorCode code,
                           PetscErrorType type, const char *message, void *)
{
  if (type == PETSC_ERROR_REPEAT) return code;
  int together = 1, all = 1;
  MPI_Comm_size(comm, &together);
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  const bool alone = together < all;
  if (alone && rank_in_world() != 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  if (alone || rank_in_world() == 0) {
    std::string text = flattened(message);
    if (text.empty()) text = "PETSc failed";
    if (status_of_errors != exit_status::bad_input) {
      text += std::string(" (PETSc, ") + function + " in " + file + ")";
    } else if (const std::string options = options_with_value_in(text); !options.empty()) {
      text = options + ": " + text + "; allowed: see -help petsc";
    }
    std::fprintf(stderr, "tribogel: error: %s\n", text.c_str());
  }
  if (alone) MPI_Abort(MPI_COMM_WORLD, status_of_errors);
  return code;
}

void print_line(const char *kind, const std::string &text)
{
  if (rank_in_world() == 0) std::fprintf(stderr, "tribogel: %s: %s\n", kind, flattened(text.c_str()).c_str());
}

} // namespace

PetscSession::PetscSession(const std::vector<std::string> &words) : texts(words)
{
  for (std::string &text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  arguments = pointers.data();
  int count = static_cast<int>(texts.size());
  PetscHelpPrintf = CatchHelp;
  PetscVFPrintf = CatchTypeLists;
  PetscPushErrorHandler(ReportError, nullptr); // for good: popping it fails when -malloc_debug began in between
  is_started = PetscInitialize(&count, &arguments, nullptr, nullptr) == 0 &&
               PetscOptionsSetValue(nullptr, "-help", nullptr) == 0;
}

PetscSession::~PetscSession()
{
  if (!is_started) return;
  PetscBool asked = PETSC_FALSE; // debug builds of PETSc list unused options unasked; CheckUnusedOptions is our list
  PetscOptionsHasName(nullptr, nullptr, "-options_left", &asked);
  if (!asked) PetscOptionsSetValue(nullptr, "-options_left", "false");
  PetscFinalize();
}

void set_error_status(int status)
{
  status_of_errors = status;
}

int error_status()
{
  return status_of_errors;
}

void print_error(const std::string &text)
{
  print_line("error", text);
}

void print_warning(const std::string &text)
{
  print_line("warning", text);
}

PetscErrorCode TakePetscHelp(std::string &help)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsClearValue(nullptr, "-help"));
  PetscVFPrintf = print_as_ever;
  help = std::exchange(caught_help, {});
  PetscFunctionReturn(0);
}

} // namespace tribogel
