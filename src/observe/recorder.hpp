/// Measures each accepted step and writes history.csv (a row a step) and profile.csv (the surfaces at each
/// phase's end). Rows are written as they come, so that nothing is lost when a run dies; the first that
/// cannot be written ends the run. A recorder that has rows when it starts goes on with the files of the run
/// that they are from.
#pragma once

#include "observe/energy.hpp"
#include "observe/measure.hpp"
#include "support/files.hpp"

#include <array>
#include <cstdint>
#include <functional>

namespace tribogel
{

/// One accepted step; columns.hpp says what of it is shown where. A new member is one more column.
struct HistoryRow {
  double time, approach, rotation, rate, step;
  int phase; ///< counted from 1
  Measurement measurement;
  EnergyBalance energy;
  StepReport report;
};

/// The last step of a phase, and what is known at such only.
struct PhaseEnd : HistoryRow {
  double centre_displacement = undefined,
         rim_displacement =
             undefined; ///< of the bottom surface, down, at the axis and at the contact radius [mm]
};

/// Where the run in `directory` keeps its checkpoint.
std::string checkpoint_in(const std::string &directory);

class Recorder : public Observer
{
public:
  /// `directory` empty: nothing is written, the numbers are kept only.
  explicit Recorder(std::string where) : directory(std::move(where)) {}

  PetscErrorCode Start(const Problem &problem) override;
  PetscErrorCode Step(const Problem &problem, const StepReport &report) override;
  PetscErrorCode Failed(const Problem &problem, const StepFailure &failure) override;
  PetscErrorCode Notice(const Problem &problem, const std::string &text) override;

  /// What a complete run has to tell in the end.
  PetscErrorCode Conclude(const Problem &problem);

  /// First process: the files' rows so far survive the machine's end; `bytes` is updated. Returns what went
  /// wrong.
  std::string bring_to_disk();

  /// First process: what speaks against going on behind the first `bytes` of the files; empty if nothing
  /// does.
  std::string objection_to_resume() const;

  /// First process, behind the reason why a file cannot be written: when it was, what is left, how to go on.
  std::string way_out(const Problem &problem) const;

  std::array<std::uintmax_t, 2>
      bytes{};           ///< of history.csv and profile.csv that belong to `rows` and `phases`
  std::string complaint; ///< why rows are missing in the files, the same on all ranks; empty: none is
  std::vector<HistoryRow> rows;
  std::vector<PhaseEnd> phases;
  std::vector<std::string> notices;     ///< what the problem had to tell
  std::vector<ProfileRow> last_profile; ///< at the end of the last completed phase of this program
  std::function<void(const HistoryRow &)> on_row = {};            ///< e.g. the progress line
  std::function<void(const StepFailure &)> on_first_failure = {}; ///< of each kind
  std::function<void(const std::string &)> on_notice = {};

private:
  std::array<std::string, 2> paths() const;
  std::string open(bool goes_on);
  PetscErrorCode Record(const Problem &problem, const StepReport &report);
  PetscErrorCode Write(const Problem &problem, const std::function<std::string()> &work);
  std::string profile_of(const PhaseEnd &end) const;

  std::string directory;
  GrowingFile history, profile;
};

} // namespace tribogel
