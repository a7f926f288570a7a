/// The columns of history.csv and profile.csv, each declared once: the files, summary.json and `-help
/// columns` come from these tables.
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

template <class Row> struct Column {
  const char *name; ///< unit included
  const char *meaning;
  Cell (*value)(const Row &);
  bool in_summary = false; ///< of history.csv: at the phases' ends in summary.json too
};

std::span<const Column<HistoryRow>> history_columns();

/// A surface's row at a phase's end.
struct ProfileLine {
  const PhaseEnd &end;
  const ProfileRow &row;
};
std::span<const Column<ProfileLine>> profile_columns();

/// The names, separated by commas.
template <class Row> std::string header_of(std::span<const Column<Row>> columns)
{
  std::string line;
  for (const auto &column : columns) line += (line.empty() ? "" : ",") + std::string(column.name);
  return line;
}

/// 17 significant digits: the number is read back bit for bit; "nan" where it is undefined.
std::string text_of(const Cell &cell);

/// The row's cells, separated by commas, and a line feed.
template <class Row>
std::string line_of(std::span<const Column<Row>> columns, const std::type_identity_t<Row> &row)
{
  std::string line;
  for (const auto &column : columns) line += (line.empty() ? "" : ",") + text_of(column.value(row));
  return line + '\n';
}

/// Both tables for people: as text for a terminal, or as a page in Markdown.
std::string columns_text();
std::string columns_markdown();

} // namespace tribogel
