/// Rows of the record as plain numbers and back, for checkpoints. A new member of a row is one more line.
#pragma once

#include "observe/recorder.hpp"

#include <type_traits>

namespace tribogel
{

template <class Visit> void each_number(Measurement &m, const Visit &visit)
{
  visit(m.normal_force);
  visit(m.torque);
  visit(m.contact_force);
  visit(m.contact_torque);
  visit(m.contact_radius);
  visit(m.mu_apparent);
  visit(m.mu_gong);
  visit(m.mu_mean);
  visit(m.mu_area_weighted);
  visit(m.mu_pressure_weighted);
  for (int i = 0; i < 2; ++i) {
    visit(m.transverse_force[i]);
    visit(m.bending_moment[i]);
  }
  visit(m.friction_power);
}

template <class Visit> void each_number(HistoryRow &row, const Visit &visit)
{
  visit(row.time);
  visit(row.approach);
  visit(row.rotation);
  visit(row.rate);
  visit(row.step);
  visit(row.phase);
  each_number(row.measurement, visit);
  visit(row.energy.work);
  visit(row.energy.stored);
  visit(row.energy.viscous);
  visit(row.energy.friction);
  visit(row.report.newton_iterations);
  visit(row.report.linear_iterations);
  visit(row.report.ends_phase);
}

template <class Visit> void each_number(PhaseEnd &end, const Visit &visit)
{
  visit(end.phase);
  visit(end.time);
  visit(end.approach);
  visit(end.rotation);
  visit(end.rate);
  each_number(end.measurement, visit);
  visit(end.centre_displacement);
  visit(end.rim_displacement);
}

template <class Row> std::vector<double> numbers_of(std::vector<Row> rows)
{
  std::vector<double> numbers;
  for (Row &row : rows) each_number(row, [&](const auto &x) { numbers.push_back(static_cast<double>(x)); });
  return numbers;
}

/// False if the numbers do not fill rows.
template <class Row> bool rows_of(const std::vector<double> &numbers, std::vector<Row> &rows)
{
  Row row{};
  std::size_t width = 0;
  each_number(row, [&](const auto &) { ++width; });
  if (numbers.size() % width != 0) return false;
  rows.clear();
  for (std::size_t at = 0; at < numbers.size();) {
    each_number(row, [&](auto &x) { x = static_cast<std::remove_reference_t<decltype(x)>>(numbers[at++]); });
    rows.push_back(row);
  }
  return true;
}

} // namespace tribogel
