/// SDIRK2's step control: the largest error of N(t) lies within a factor of three of `-time_tolerance`, over
/// one and a half decades of it, and so does that of T(t) where its rise is resolved; the method restarts at
/// each jump with a short step. Fails with an eighth of the estimate or four times it, and if a phase goes on
/// with the last one's step.
#include "probe.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

/// Pressed, held, turned so slowly against so much friction that T takes seconds to rise.
Scene scene_of(double tolerance)
{
  Scene scene = paper_scene(4);
  scene.friction = PolynomialFriction<double>{{2}, {1}};
  scene.schedule = schedule_from_rates({27, 60, 90}, {0.79, 0.79, 0.79}, {0, 0, 0.01});
  scene.time = {TimeRule::sdirk2, tolerance};
  return scene;
}

std::vector<HistoryRow> rows_of(const Scene &scene)
{
  const SolverOptions options(newton_tolerance(1e-10));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows;
}

std::array<double, 2> loads(const HistoryRow &row)
{
  return {row.measurement.normal_force, row.measurement.torque};
}

/// On a parabola through three rows of the phase that holds `time`.
std::array<double, 2> loads_at(const std::vector<HistoryRow> &rows, const HistoryRow &at)
{
  std::size_t n = 1;
  while (rows[n].time < at.time) ++n;
  while (n + 1 < rows.size() && (rows[n].phase != at.phase || rows[n - 1].report.ends_phase)) ++n;
  std::array<double, 2> sum{};
  for (std::size_t j = n - 1; j <= n + 1; ++j) {
    double weight = 1;
    for (std::size_t k = n - 1; k <= n + 1; ++k)
      if (k != j) weight *= (at.time - rows[k].time) / (rows[j].time - rows[k].time);
    for (std::size_t i = 0; i < 2; ++i) sum[i] += weight * loads(rows[j])[i];
  }
  return sum;
}

} // namespace

TEST(error_estimate, OfForceAndTorqueIsWithinAFactorOfThree)
{
  const std::vector<HistoryRow> reference = rows_of(scene_of(3e-4));
  std::array<double, 2> largest{};
  for (const HistoryRow &row : reference)
    for (std::size_t i = 0; i < 2; ++i) largest[i] = std::max(largest[i], std::abs(loads(row)[i]));
  for (double tolerance : {0.3, 0.1, 0.03, 0.01}) {
    const std::vector<HistoryRow> rows = rows_of(scene_of(tolerance));
    std::array<double, 2> error{};
    for (const HistoryRow &row : rows) {
      if (row.report.ends_phase || row.time == 0) continue;
      const std::array<double, 2> exact = loads_at(reference, row);
      for (std::size_t i = 0; i < 2; ++i)
        error[i] = std::max(error[i], 100 * std::abs(loads(row)[i] - exact[i]) / largest[i]);
    }
    std::printf("tolerance %g %%: %zu steps, errors of N %.2e %%, T %.2e %%\n", tolerance, rows.size() - 1,
                error[0], error[1]);
    const double worst = std::max(error[0], error[1]);
    EXPECT_LT(worst, 3 * tolerance);
    EXPECT_GT(worst, tolerance / 3);
  }
}

TEST(error_estimate, StepsRestartAtEachJump)
{
  const std::vector<HistoryRow> rows = rows_of(scene_of(0.1));
  for (std::size_t n = 2; n < rows.size(); ++n) {
    if (!rows[n - 1].report.ends_phase) continue;
    EXPECT_LT(rows[n].step, 0.5 * rows[n - 1].step);
    EXPECT_LT(rows[n].step, 0.7);
  }
}

} // namespace tribogel::test
