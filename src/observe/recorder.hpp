/// Measures each accepted step and writes history.csv (a row a step) and profile.csv (the surfaces at each phase's
/// end). Rows are flushed as they come, so that nothing is lost when a run dies.
#pragma once

#include "observe/energy.hpp"
#include "observe/measure.hpp"

#include <fstream>
#include <functional>

namespace tribogel
{

/// What the end of a phase looked like.
struct PhaseEnd {
  int phase; ///< counted from 1
  double time, approach, rotation, rate;
  Measurement measurement;
  double centre_displacement,
      rim_displacement; ///< of the bottom surface, down, at the axis and at the contact radius [mm]
};

/// One accepted step as the files and the console show it.
struct HistoryRow {
  double time, approach, rotation, rate, step;
  int phase; ///< counted from 1
  Measurement measurement;
  EnergyBalance energy;
  StepReport report;
};

class Recorder : public Observer
{
public:
  /// `directory` empty: nothing is written, the numbers are kept only.
  explicit Recorder(std::string where) : directory(std::move(where)) {}

  PetscErrorCode Start(Problem &problem) override;
  PetscErrorCode Step(Problem &problem, const StepReport &report) override;
  PetscErrorCode Failed(Problem &problem, const StepFailure &failure) override;
  PetscErrorCode Notice(Problem &problem, const std::string &text) override;

  std::vector<HistoryRow> rows;
  std::vector<PhaseEnd> phases;
  std::vector<std::string> notices;                               ///< what the problem had to tell
  std::vector<ProfileRow> last_profile;                           ///< at the end of the last completed phase
  std::function<void(const HistoryRow &)> on_row = {};            ///< e.g. the progress line
  std::function<void(const StepFailure &)> on_first_failure = {}; ///< of each kind
  std::function<void(const std::string &)> on_notice = {};

private:
  PetscErrorCode Record(Problem &problem, const StepReport &report);
  void write_row(const HistoryRow &row);
  void write_profile(double time, int phase);

  std::string directory;
  std::ofstream history, profile;
};

} // namespace tribogel
