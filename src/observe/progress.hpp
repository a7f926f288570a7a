/// The console: a live line on a terminal, one line a phase elsewhere, a table at the end. First rank only.
#pragma once

#include "observe/summary.hpp"

namespace tribogel
{

class Progress
{
public:
  Progress(const Schedule &schedule, bool speaks);
  void show(const HistoryRow &row);
  void show(const StepFailure &failure) const;
  void show(const std::string &notice) const;
  void finish(const Recorder &recorder, const SolveCounts &counts, const RunOutcome &outcome,
              const RunCost &cost, const std::string &directory) const;
  void show(const Companion &companion) const;
  void show(const ErrorEstimate &estimate, const Recorder &recorder) const;

private:
  std::string estimate_left(double time) const;

  Schedule schedule;
  bool speaks, terminal;
  double start, drawn = 0;
};

} // namespace tribogel
