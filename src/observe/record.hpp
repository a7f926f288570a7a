/// The rows of a run as plain numbers and back, for checkpoints. The numbers' names are written beside them,
/// so that a program with further columns reads them too.
#pragma once

#include "observe/recorder.hpp"

#include <string>
#include <vector>

namespace tribogel
{

/// Rows of equal length, one behind the other; `names` are those of a row's numbers, separated by commas.
struct Record {
  std::string names;
  std::vector<double> numbers;
};

Record record_of(const std::vector<HistoryRow> &rows);

/// Without what is of the phases' last steps: these are rows too.
Record record_of(const std::vector<PhaseEnd> &ends);

/// Into rows; then into the ends of the phases that end in them. Numbers without a name of ours are passed
/// over, and what has no number is left as it is. False if the numbers fill no rows, or not as many as phases
/// end.
bool read_record(const Record &record, std::vector<HistoryRow> &rows);
bool read_record(const Record &record, const std::vector<HistoryRow> &rows, std::vector<PhaseEnd> &ends);

/// The names in checkpoints that do not tell them.
std::string unwritten_row_names();
std::string unwritten_phase_end_names();

} // namespace tribogel
