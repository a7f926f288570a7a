#include "support/petsc_session.hpp"

#include "support/exit_status.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
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
bool keeps_errors = false;
std::string kept_error;
std::vector<std::string> given_words;     ///< all that PETSc is told
std::vector<std::string> names_of_others; ///< options in there that are not PETSc's
constexpr std::size_t longest_word = 200; ///< of a message; a damaged file may hold any
PetscErrorCode (*const print_as_ever)(FILE *, const char[], std::va_list) = PetscVFPrintf;

int rank_in_world()
{
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

std::vector<std::string> split(const std::string &text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The same word but for a full stop, or the same number; of a list one of its entries.
bool same(const std::string &said, const std::string &value)
{
  const std::string word = said.substr(0, said.find_last_not_of(".,;:") + 1);
  if (word == value || said == value) return true;
  if (const std::size_t comma = value.find(','); comma != std::string::npos)
    return same(said, value.substr(0, comma)) || same(said, value.substr(comma + 1));
  char *end_of_word = nullptr, *end_of_value = nullptr;
  const double x = std::strtod(word.c_str(), &end_of_word), y = std::strtod(value.c_str(), &end_of_value);
  return x == y && end_of_word != word.c_str() && *end_of_word == 0 && *end_of_value == 0;
}

/// Of an option, rather than a value, which may be negative.
bool is_name(const std::string &word)
{
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
}

/// The options whose value is a word of the message: PETSc does not say which one it could not read. From the
/// database, and before there is one from the words that PETSc was given.
std::string options_behind(const std::string &message)
{
  char *all = nullptr;
  PetscBool ready = PETSC_FALSE;
  PetscInitialized(&ready);
  if (ready && (PetscOptionsGetAll(nullptr, &all) != 0 || !all)) return {};
  std::string unquoted = message;
  std::replace(unquoted.begin(), unquoted.end(), '"', ' ');
  const std::vector<std::string> words = all ? split(all) : given_words, said = split(unquoted);
  PetscFree(all);
  std::string found;
  for (std::size_t i = 1; i < words.size(); ++i)
    if (is_name(words[i - 1]) && !is_name(words[i]) &&
        std::find(names_of_others.begin(), names_of_others.end(), words[i - 1]) == names_of_others.end() &&
        std::any_of(said.begin(), said.end(), [&](const std::string &word) { return same(word, words[i]); }))
      found += (found.empty() ? "" : ", ") + words[i - 1] + " = " + words[i];
  return found;
}

/// Options that have been read already and that PETSc would read again, by other rules: hidden from it while
/// this lives.
class HiddenVariable
{
public:
  explicit HiddenVariable(const char *its_name) : name(its_name)
  {
    if (const char *now = std::getenv(name)) text = now;
    unsetenv(name);
  }
  HiddenVariable(const HiddenVariable &) = delete;
  HiddenVariable &operator=(const HiddenVariable &) = delete;
  ~HiddenVariable()
  {
    if (text) setenv(name, text->c_str(), 1);
  }

private:
  const char *name;
  std::optional<std::string> text;
};

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

/// PETSc's lists of types, "  -ksp_type <now gmres ...> (one of) cg ...\n", bypass PetscHelpPrintf: several
/// calls make up the line, and the first and the last are known by their formats. All else is printed as
/// ever.
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

/// One line that a terminal can show: PETSc's messages may have several, and what is quoted may hold
/// anything.
std::string one_line(std::string text)
{
  for (char &c : text)
    if (std::iscntrl(static_cast<unsigned char>(c)))
      c = std::isspace(static_cast<unsigned char>(c)) ? ' ' : '?';
  std::string line;
  for (std::size_t begin = 0, end; begin < text.size(); begin = end) {
    end = std::min(text.find(' ', begin + 1), text.size());
    line += end - begin > longest_word ? text.substr(begin, longest_word) + "..."
                                       : text.substr(begin, end - begin);
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

/// An error known to all processes is printed by the first one and returned up to main on all. One that a
/// single process meets, e.g. while it reads a file for the others, would leave them waiting: it ends the
/// program. The pause lets the first process, if it has the same error, speak for all.
PetscErrorCode ReportError(MPI_Comm comm, int, const char *function, const char *file, PetscErrorCode code,
                           PetscErrorType type, const char *message, void *)
{
  if (type == PETSC_ERROR_REPEAT) return code;
  int together = 1, all = 1;
  MPI_Comm_size(comm, &together);
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  const bool alone = together < all;
  if (keeps_errors && !alone) {
    kept_error = one_line(message && *message ? message : "PETSc failed");
    return code;
  }
  if (alone && rank_in_world() != 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  if (alone || rank_in_world() == 0) {
    std::string text = message ? message : "";
    if (text.empty()) text = "PETSc failed";
    if (status_of_errors != exit_status::bad_input) {
      text += std::string(" (PETSc, ") + function + " in " + file + ")";
    } else if (const std::string options = options_behind(text); !options.empty()) {
      text = options + ": " + text + "; allowed: see -help petsc";
    }
    std::fprintf(stderr, "tribogel: error: %s\n", one_line(text).c_str());
  }
  if (alone) MPI_Abort(MPI_COMM_WORLD, status_of_errors);
  return code;
}

void print_line(const char *kind, const std::string &text)
{
  if (rank_in_world() == 0) std::fprintf(stderr, "tribogel: %s: %s\n", kind, one_line(text).c_str());
}

} // namespace

PetscSession::PetscSession(const std::vector<std::string> &words, const std::vector<std::string> &not_petscs)
    : texts(words)
{
  static const std::string no_files = "-skip_petscrc";
  const bool asked = std::find(texts.begin(), texts.end(), no_files) != texts.end();
  if (!asked) texts.push_back(no_files);
  for (std::string &text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  arguments = pointers.data();
  given_words = texts;
  names_of_others = not_petscs;
  int count = static_cast<int>(texts.size());
  PetscHelpPrintf = CatchHelp;
  PetscVFPrintf = CatchTypeLists;
  PetscPushErrorHandler(ReportError,
                        nullptr); // for good: popping it fails when -malloc_debug began in between
  const HiddenVariable options("PETSC_OPTIONS"), more_options("PETSC_OPTIONS_YAML");
  is_started = PetscInitialize(&count, &arguments, nullptr, nullptr) == 0 &&
               PetscOptionsSetValue(nullptr, "-help", nullptr) == 0;
  if (is_started && !asked) PetscOptionsClearValue(nullptr, no_files.c_str());
}

PetscSession::~PetscSession()
{
  if (!is_started) return;
  PetscBool asked =
      PETSC_FALSE; // debug builds of PETSc list unused options unasked; CheckUnusedOptions is our list
  PetscOptionsHasName(nullptr, nullptr, "-options_left", &asked);
  if (!asked) PetscOptionsSetValue(nullptr, "-options_left", "false");
  PetscFinalize();
}

KeptErrors::KeptErrors()
{
#if defined(PETSC_USE_DEBUG)
  stack_size = petscstack.currentsize;
#endif
  keeps_errors = true;
  kept_error.clear();
}

KeptErrors::~KeptErrors()
{
  keeps_errors = false;
#if defined(PETSC_USE_DEBUG)
  petscstack.currentsize = stack_size;
#endif
}

const std::string &KeptErrors::text() const
{
  return kept_error;
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
