/// Euler's rule with its default tolerance keeps what it promises: N(t) within 0.3 % of its largest value and
/// N at the ends of phases within 0.1 % of a run with steps so short that their own error is a tenth of that;
/// and the error falls as the root of the tolerance. Fails without N in the estimate, with a quarter of it,
/// and with first steps five times as long.
#include "probe.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

namespace
{

std::vector<HistoryRow> rows_with(const OptionList &given)
{
  Scene scene = paper_scene(4);
  scene.time.rule = TimeRule::exponential_euler;
  scene.schedule.resize(2);
  const SolverOptions options(given);
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows;
}

double force_at(const std::vector<HistoryRow> &rows, double time)
{
  const auto after = std::lower_bound(rows.begin(), rows.end(), time,
                                      [](const HistoryRow &row, double t) { return row.time < t; });
  if (after == rows.begin()) return after->measurement.normal_force;
  const HistoryRow &a = *(after - 1), &b = *after;
  const double s = (time - a.time) / (b.time - a.time);
  return (1 - s) * a.measurement.normal_force + s * b.measurement.normal_force;
}

struct Errors {
  double anywhere = 0, at_ends = 0; ///< of N over its largest value
};

Errors errors(const std::vector<HistoryRow> &rows, const std::vector<HistoryRow> &reference)
{
  Errors e;
  double largest = 0;
  for (const HistoryRow &row : reference) largest = std::max(largest, row.measurement.normal_force);
  for (const HistoryRow &row : rows) {
    const double error = std::abs(row.measurement.normal_force - force_at(reference, row.time)) / largest;
    e.anywhere = std::max(e.anywhere, error);
    if (row.report.ends_phase) e.at_ends = std::max(e.at_ends, error);
  }
  std::printf("%zu steps: N(t) %.3f %%, at the ends of phases %.3f %%\n", rows.size() - 1, 100 * e.anywhere,
              100 * e.at_ends);
  return e;
}

} // namespace

TEST(time_control, EulersStepsKeepTheForceWithinItsBounds)
{
  const auto reference = rows_with({{"-ts_atol", "1e-5"}, {"-ts_dt", "2e-3"}});
  const Errors usual = errors(rows_with({}), reference),
               fine = errors(rows_with({{"-ts_atol", "1e-4"}}), reference);
  EXPECT_LE(usual.anywhere, 3e-3);
  EXPECT_LE(usual.at_ends, 1e-3);
  EXPECT_GT(usual.anywhere / fine.anywhere, 2);
  EXPECT_LT(usual.anywhere / fine.anywhere, 5);
}

} // namespace tribogel::test
