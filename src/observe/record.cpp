#include "observe/record.hpp"

#include "observe/columns.hpp"

#include <sstream>

namespace tribogel
{

namespace
{

/// Those that can be set.
template <class Row> std::vector<const Column<Row> *> recorded(std::span<const Column<Row>> columns)
{
  std::vector<const Column<Row> *> all;
  for (const Column<Row> &column : columns)
    if (column.set) all.push_back(&column);
  return all;
}

std::vector<const Column<HistoryRow> *> recorded_of_row()
{
  auto all = recorded(history_columns());
  for (const auto *column : recorded(kept_columns())) all.push_back(column);
  return all;
}

template <class Row>
Record record_with(const std::vector<const Column<Row> *> &columns, const std::vector<Row> &rows)
{
  Record record;
  for (const auto *column : columns)
    record.names += (record.names.empty() ? "" : ",") + std::string(column->name);
  for (const Row &row : rows)
    for (const auto *column : columns) record.numbers.push_back(number_of(column->value(row)));
  return record;
}

/// For each number of a row the column that it belongs to, or null.
template <class Row>
std::vector<const Column<Row> *> columns_named(const std::string &names,
                                               const std::vector<const Column<Row> *> &known)
{
  std::vector<const Column<Row> *> columns;
  std::istringstream stream(names);
  for (std::string name; std::getline(stream, name, ',');) {
    columns.push_back(nullptr);
    for (const auto *column : known)
      if (name == column->name) columns.back() = column;
  }
  return columns;
}

template <class Row>
bool fill(const Record &record, const std::vector<const Column<Row> *> &known, std::vector<Row> &rows)
{
  const auto columns = columns_named(record.names, known);
  if (columns.empty() || record.numbers.size() != rows.size() * columns.size()) return false;
  auto number = record.numbers.begin();
  for (Row &row : rows)
    for (const auto *column : columns) {
      if (column) column->set(row, *number);
      ++number;
    }
  return true;
}

} // namespace

Record record_of(const std::vector<HistoryRow> &rows)
{
  return record_with(recorded_of_row(), rows);
}

Record record_of(const std::vector<PhaseEnd> &ends)
{
  return record_with(recorded(phase_end_columns()), ends);
}

bool read_record(const Record &record, std::vector<HistoryRow> &rows)
{
  const auto known = recorded_of_row();
  const std::size_t width = columns_named(record.names, known).size();
  if (width == 0) return false;
  rows.assign(record.numbers.size() / width, HistoryRow{});
  return fill(record, known, rows);
}

bool read_record(const Record &record, const std::vector<HistoryRow> &rows, std::vector<PhaseEnd> &ends)
{
  ends.clear();
  for (const HistoryRow &row : rows)
    if (row.report.ends_phase) ends.push_back({row});
  return fill(record, recorded(phase_end_columns()), ends);
}

std::string unwritten_row_names()
{
  return "time_s,approach_mm,rotation_rad,rate_rad_per_s,step_s,phase,normal_force_N,torque_Nmm,contact_"
         "force_N,"
         "contact_torque_Nmm,contact_radius_mm,mu_apparent,mu_gong,mu_mean,mu_area_weighted,"
         "mu_pressure_weighted,transverse_force_x_N,bending_moment_x_Nmm,transverse_force_y_N,"
         "bending_moment_y_Nmm,friction_power_Nmm_per_s,work_of_plates_Nmm,stored_energy_Nmm,"
         "viscous_dissipation_Nmm,frictional_dissipation_Nmm,newton_iterations,linear_iterations,ends_phase";
}

std::string unwritten_phase_end_names()
{
  const std::string of_the_row(20, ',');
  return of_the_row + "bottom_surface_centre_displacement_mm,bottom_surface_rim_displacement_mm";
}

} // namespace tribogel
