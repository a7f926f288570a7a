/// What is known of a step, a phase's end and a node of a surface, each declared once: history.csv,
/// profile.csv, summary.json, the console's table, the checkpoint's record and `-help columns` come from
/// these tables.
#pragma once

#include "observe/recorder.hpp"

#include <span>
#include <string>
#include <type_traits>
#include <variant>

namespace tribogel
{

/// What stands in a cell: a real number, a whole one, or a word.
using Cell = std::variant<double, long, const char *>;

/// How the console shows a column.
struct ConsoleStyle {
  const char *heading = nullptr; ///< unit included
  int width = 0, digits = 0;
};

template <class Row> struct Column {
  const char *name; ///< unit included
  const char *meaning;
  Cell (*value)(const Row &);
  void (*set)(Row &, double) = nullptr; ///< null where the value follows from others
  bool in_summary = false;              ///< of history.csv: at the phases' ends in summary.json too
  ConsoleStyle console = {};
};

std::span<const Column<HistoryRow>> history_columns();

/// Of a step, in the checkpoint's record besides history_columns().
std::span<const Column<HistoryRow>> kept_columns();

/// Of a phase's end besides those of its last step, in summary.json.
std::span<const Column<PhaseEnd>> phase_end_columns();

/// A surface's row at a phase's end.
struct ProfileLine {
  const PhaseEnd &end;
  const ProfileRow &row;
};
std::span<const Column<ProfileLine>> profile_columns();

/// That of history_columns() with this name.
const Column<HistoryRow> &history_column(const std::string &name);

/// The names, separated by commas.
template <class Row> std::string header_of(std::span<const Column<Row>> columns)
{
  std::string line;
  for (const auto &column : columns) line += (line.empty() ? "" : ",") + std::string(column.name);
  return line;
}

/// 17 significant digits: the number is read back bit for bit; "nan" where it is undefined.
std::string text_of(const Cell &cell);

/// NaN of a word.
double number_of(const Cell &cell);

/// The row's cells, separated by commas, and a line feed.
template <class Row>
std::string line_of(std::span<const Column<Row>> columns, const std::type_identity_t<Row> &row)
{
  std::string line;
  for (const auto &column : columns) line += (line.empty() ? "" : ",") + text_of(column.value(row));
  return line + '\n';
}

/// As wide as the column is on the console.
std::string console_heading(const Column<HistoryRow> &column);
std::string console_text(const Column<HistoryRow> &column, const HistoryRow &row);

/// Both tables for people: as text for a terminal, or as a page in Markdown.
std::string columns_text();
std::string columns_markdown();

} // namespace tribogel
