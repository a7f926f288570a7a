/// PETSc from start to end, with our own way of reporting its errors.
#pragma once

#include <petscsys.h>

#include <string>
#include <vector>

namespace tribogel
{

/// Starts PETSc and stops it at the end of its life; MPI must be running. PETSc's errors become one line on
/// stderr, "tribogel: error: ..."; one that only a single process of several meets ends them all. PETSc's
/// help texts are asked for and caught, not printed: they tell the names it knows. Its options are the words,
/// nothing else: no file and no variable of the environment.
class PetscSession
{
public:
  /// The words as in argv, the program's name first; names among them of options that PETSc does not read,
  /// and that are not to blame for what it cannot read.
  explicit PetscSession(const std::vector<std::string> &words,
                        const std::vector<std::string> &not_petscs = {});
  ~PetscSession();
  PetscSession(const PetscSession &) = delete;
  PetscSession &operator=(const PetscSession &) = delete;

  bool started() const { return is_started; } ///< false: an error, already reported

private:
  std::vector<std::string> texts; ///< PETSc keeps pointers to them
  std::vector<char *> pointers;
  char **arguments;
  bool is_started = false;
};

/// The exit status of errors from here on: bad_input while options are being read and the solver is set up
/// (the initial value), cannot_go_on afterwards. An error then also names PETSc's function and file.
void set_error_status(int status);
int error_status();

/// Prints "tribogel: error: <text>" on stderr, on the first process of MPI_COMM_WORLD only.
void print_error(const std::string &text);
void print_warning(const std::string &text); ///< "tribogel: warning: <text>", likewise

/// While it lives, an error that all processes know is kept, not printed: for work whose failure is not the
/// run's. One that a single process of several meets still ends them all.
class KeptErrors
{
public:
  KeptErrors();
  ~KeptErrors();
  KeptErrors(const KeptErrors &) = delete;
  KeptErrors &operator=(const KeptErrors &) = delete;

  const std::string &text() const; ///< the last one's, in one line

private:
  int stack_size =
      0; ///< of PETSc's names of functions, in debug builds: an error leaves it as it was when it happened
};

/// All that PETSc would have printed for -help since its start: what each object says of its options when it
/// reads them. From here on nothing is caught. To be called once, when the solver has been set up.
PetscErrorCode TakePetscHelp(std::string &help);

} // namespace tribogel
