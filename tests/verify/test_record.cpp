// The rows of a run as a checkpoint keeps them: no member is lost, and other columns do no harm.
#include "observe/columns.hpp"
#include "observe/record.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tribogel
{
namespace
{

/// All numbers of a row. The lists of names do not compile any more when there is a new one.
template <class Visit> void each_number(HistoryRow &row, const Visit &visit)
{
  auto &[time, approach, rotation, rate, step, phase, m, energy, report] = row;
  auto &[N, T, contact_N, contact_T, radius, apparent, gong, mean, by_area, by_pressure, transverse, bending,
         power] = m;
  auto &[work, stored, viscous, friction] = energy;
  auto &[newton, linear, ends_phase] = report;
  for (double *x :
       {&time,          &approach,   &rotation,   &rate,  &step, &N,       &T,           &contact_N,
        &contact_T,     &radius,     &apparent,   &gong,  &mean, &by_area, &by_pressure, &transverse[0],
        &transverse[1], &bending[0], &bending[1], &power, &work, &stored,  &viscous,     &friction})
    visit(*x);
  visit(phase);
  visit(newton);
  visit(linear);
  visit(ends_phase);
}

/// Numbers that are all different, and as doubles have no short decimals.
std::vector<HistoryRow> some_rows()
{
  std::vector<HistoryRow> rows(3);
  int count = 0;
  for (HistoryRow &row : rows)
    each_number(row, [&](auto &x) {
      using Number = std::remove_reference_t<decltype(x)>;
      x = static_cast<Number>(std::is_same_v<Number, double> ? std::sqrt(++count) : ++count);
    });
  rows[0].report.ends_phase = false;
  return rows;
}

std::vector<double> numbers_of(HistoryRow row)
{
  std::vector<double> numbers;
  each_number(row, [&](auto &x) { numbers.push_back(static_cast<double>(x)); });
  return numbers;
}

TEST(record, KeepsEachNumberOfARow)
{
  const std::vector<HistoryRow> rows = some_rows();
  std::vector<HistoryRow> again;
  ASSERT_TRUE(read_record(record_of(rows), again));
  ASSERT_EQ(again.size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(numbers_of(again[k]), numbers_of(rows[k])) << k;
}

TEST(record, KeepsThePhasesEnds)
{
  const std::vector<HistoryRow> rows = some_rows();
  const std::vector<PhaseEnd> ends{{rows[1], 0.25, 0.5}, {rows[2], 0.75, undefined}};
  std::vector<PhaseEnd> again;
  ASSERT_TRUE(read_record(record_of(ends), rows, again));
  ASSERT_EQ(again.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(numbers_of(again[k]), numbers_of(ends[k]));
    EXPECT_EQ(again[k].centre_displacement, ends[k].centre_displacement);
  }
  EXPECT_EQ(again[0].rim_displacement, 0.5);
  EXPECT_TRUE(std::isnan(again[1].rim_displacement));
  const std::vector<HistoryRow> fewer{rows[0], rows[1]};
  EXPECT_FALSE(read_record(record_of(ends), fewer, again));
}

TEST(record, GoesByNames)
{
  const Record record{"torque_Nmm,of_tomorrow,time_s", {3, 99, 1, 4, 99, 2}};
  std::vector<HistoryRow> rows;
  ASSERT_TRUE(read_record(record, rows));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].measurement.torque, 3);
  EXPECT_EQ(rows[0].time, 1);
  EXPECT_EQ(rows[1].measurement.torque, 4);
  EXPECT_EQ(rows[1].time, 2);
  EXPECT_TRUE(std::isnan(rows[1].measurement.mu_gong)); // not told: undefined as in a new row
}

TEST(record, OfWrongLengthIsNotTaken)
{
  std::vector<HistoryRow> rows;
  EXPECT_FALSE(read_record({"time_s,phase", {1, 2, 3}}, rows));
  EXPECT_FALSE(read_record({"", {1, 2}}, rows));
}

/// Checkpoints of version 0.1.0 before the names were written.
TEST(record, WithoutNamesIsTaken)
{
  Record record{unwritten_row_names(), {}};
  for (int k = 0; k < 28; ++k) record.numbers.push_back(k + 1);
  std::vector<HistoryRow> rows;
  ASSERT_TRUE(read_record(record, rows));
  ASSERT_EQ(rows.size(), 1u);
  const HistoryRow &row = rows[0];
  EXPECT_EQ(numbers_of(row), (std::vector<double>{1,  2,  3,  4,  5,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                                  16, 17, 19, 18, 20, 21, 22, 23, 24, 25, 6,  26, 27, 1}));
  Record of_ends{unwritten_phase_end_names(), {}};
  for (int k = 0; k < 22; ++k) of_ends.numbers.push_back(100 + k);
  std::vector<PhaseEnd> ends;
  ASSERT_TRUE(read_record(of_ends, rows, ends));
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].time, 1);
  EXPECT_EQ(ends[0].centre_displacement, 120);
  EXPECT_EQ(ends[0].rim_displacement, 121);
}

TEST(record_columns, ConsoleShowsTheNumbersOfTheFile)
{
  HistoryRow row{};
  row.phase = 3;
  row.measurement.torque = 11.44523456;
  EXPECT_EQ(console_heading(history_column("torque_Nmm")), "       T  N mm");
  EXPECT_EQ(console_text(history_column("torque_Nmm"), row), "      11.44523");
  EXPECT_EQ(console_text(history_column("phase"), row), "    3");
  EXPECT_EQ(console_text(history_column("mu_apparent"), row), "          nan");
  EXPECT_THROW(history_column("torque"), std::logic_error);
}

} // namespace
} // namespace tribogel
