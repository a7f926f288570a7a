#include "observe/progress.hpp"

#include "observe/columns.hpp"
#include "support/exit_status.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace tribogel
{

Progress::Progress(const Schedule &phases, bool is_first_rank)
    : schedule(phases), speaks(is_first_rank), terminal(isatty(STDOUT_FILENO)), start(MPI_Wtime())
{
}

/// Steps grow within a phase, so time left is guessed from phases done, not from seconds simulated.
std::string Progress::estimate_left(double time) const
{
  double done = 0;
  for (const Phase &phase : schedule) {
    const double elapsed = (time - phase.start_time) / (1e-5 * phase.duration());
    if (elapsed > 0) done += std::min(1.0, std::log1p(elapsed) / std::log1p(1e5));
  }
  if (done <= 0) return "";
  const double spent = MPI_Wtime() - start, left = spent * (static_cast<double>(schedule.size()) / done - 1);
  char text[32];
  std::snprintf(text, sizeof text, "  about %.0f s left", left);
  return text;
}

void Progress::show(const HistoryRow &row)
{
  const bool ends = row.report.ends_phase;
  constexpr double redraw = 0.2; // seconds: a quick run makes hundreds of steps in one
  if (!speaks || !(ends || (terminal && MPI_Wtime() - drawn > redraw))) return;
  drawn = MPI_Wtime();
  const Measurement &m = row.measurement;
  std::printf("%sphase %d/%zu  t = %-10.6g s  step %-9.3g s  %2d Newton  N = %-10.6g N  T = %-11.6g N mm  mu "
              "weighted "
              "= %-10.4g%s%s",
              terminal ? "\r" : "", row.phase, schedule.size(), row.time, row.step,
              static_cast<int>(row.report.newton_iterations), m.normal_force, m.torque,
              m.mu_pressure_weighted, ends ? "                     " : estimate_left(row.time).c_str(),
              ends ? "\n" : "  ");
  std::fflush(stdout);
}

void Progress::show(const StepFailure &failure) const
{
  std::ostringstream text;
  text << std::setprecision(9) << "t = " << failure.time << std::setprecision(3) << " s: a step of "
       << failure.step << " s is cut: " << failure.words;
  show(text.str());
}

void Progress::show(const std::string &notice) const
{
  if (!speaks) return;
  std::printf("%s%s%s\n", terminal ? "\r" : "", notice.c_str(), terminal ? "                    " : "");
  std::fflush(stdout);
}

void Progress::finish(const Recorder &recorder, const SolveCounts &counts, const RunOutcome &outcome,
                      const RunCost &cost, const std::string &directory) const
{
  if (!speaks) return;
  std::vector<const Column<HistoryRow> *> columns;
  for (const char *name : {"phase", "time_s", "rate_rad_per_s", "normal_force_N", "torque_Nmm",
                           "contact_radius_mm", "mu_apparent", "mu_pressure_weighted"})
    columns.push_back(&history_column(name));
  std::string table = "\n";
  for (const auto *column : columns) table += (column == columns[0] ? "" : " ") + console_heading(*column);
  for (const PhaseEnd &end : recorder.phases) {
    table += "\n";
    for (const auto *column : columns)
      table += (column == columns[0] ? "" : " ") + console_text(*column, end);
  }
  std::printf("%s\n", table.c_str());
  std::printf("mu apparent: from T by eq. (3.13) of the paper; mu weighted: of the law, over the contact, by "
              "pressure\n");
  std::printf("\n%d steps (%d rejected, %d failed solves), %d Newton iterations, %.1f CPU s, %.1f s, %.0f MB "
              "on %d rank%s\n",
              static_cast<int>(counts.accepted_steps), static_cast<int>(counts.rejected_steps),
              static_cast<int>(counts.failed_solves), static_cast<int>(counts.newton_iterations),
              cost.cpu_seconds, cost.wall_seconds, cost.peak_memory_MB, cost.ranks,
              cost.ranks == 1 ? "" : "s");
  for (int k = 0; k < failure_kinds; ++k)
    if (const int count = counts.failures[static_cast<std::size_t>(k)])
      std::printf("  failed, step cut: %d x %s\n", count, failure_names[k]);
  if (outcome.status == exit_status::stopped_on_request)
    std::printf("%s\n", outcome.reason.c_str());
  else
    std::printf("%s %s\n", outcome.status == 0 ? "complete; files in" : "NOT complete; what there is, in",
                directory.c_str());
}

void Progress::show(const Companion &companion) const
{
  char cost[64];
  std::snprintf(cost, sizeof cost, ": %d unknowns, %d steps, %.1f CPU s",
                static_cast<int>(companion.unknowns), static_cast<int>(companion.steps),
                companion.cpu_seconds);
  show("error estimate: " + companion.name + cost + (companion.failure.empty() ? "" : ", failed"));
}

namespace
{

/// "0.12 (2.0)": an error and, in brackets, the observed order that it trusts; "?" where it is not known.
std::string text_of(const Extrapolation &error)
{
  char text[48];
  if (std::isnan(error.error)) return "?";
  if (error.verdict == Convergence::confirmed && error.order == error.order)
    std::snprintf(text, sizeof text, "%.2g (%.1f)", error.error, error.order);
  else
    std::snprintf(text, sizeof text, "%.2g", error.error);
  return text;
}

} // namespace

void Progress::show(const ErrorEstimate &estimate, const Recorder &recorder) const
{
  if (!speaks) return;
  const auto &phase = history_column("phase"), &N = history_column("normal_force_N"),
             &T = history_column("torque_Nmm");
  constexpr const char *line = "%s %s %16s %9s %s %16s %9s\n";
  if (!estimate.phases.empty()) {
    std::printf("\n");
    std::printf(line, console_heading(phase).c_str(), console_heading(N).c_str(), "+- mesh (order)",
                "+- time", console_heading(T).c_str(), "+- mesh (order)", "+- time");
  }
  for (std::size_t k = 0; k < estimate.phases.size(); ++k) {
    const auto &[force, torque] = estimate.phases[k];
    const PhaseEnd &end = recorder.phases[k];
    std::printf(line, console_text(phase, end).c_str(), console_text(N, end).c_str(),
                text_of(force.mesh).c_str(), text_of(force.time).c_str(), console_text(T, end).c_str(),
                text_of(torque.mesh).c_str(), text_of(torque.time).c_str());
  }
  for (const std::string &note : estimate.notes) std::printf("note: error estimate: %s\n", note.c_str());
  std::printf("error estimate: %zu companions, %.1f CPU s\n", estimate.companions.size(),
              estimate.cpu_seconds);
}

} // namespace tribogel
