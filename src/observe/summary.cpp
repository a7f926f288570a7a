#include "observe/summary.hpp"

#include "observe/columns.hpp"
#include "support/files.hpp"
#include "support/first_process.hpp"
#include "support/version.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tribogel
{

namespace
{

using Json = nlohmann::ordered_json;

/// JSON has no NaN.
Json number(double x)
{
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json json_of(const Cell &cell)
{
  if (const auto *count = std::get_if<long>(&cell)) return *count;
  return number(number_of(cell));
}

/// The columns of history.csv that are worth it, and what is known at phases' ends only.
Json describe(const PhaseEnd &end)
{
  Json json;
  for (const Column<HistoryRow> &column : history_columns())
    if (column.in_summary) json[column.name] = json_of(column.value(end));
  for (const Column<PhaseEnd> &column : phase_end_columns()) json[column.name] = json_of(column.value(end));
  return json;
}

Json phase_ends(const Recorder &recorder)
{
  Json json = Json::array();
  for (const PhaseEnd &end : recorder.phases) json.push_back(describe(end));
  return json;
}

/// Largest imbalance between plate and contact over the run beside the largest force and torque; the energies
/// at its end.
Json balances(const Recorder &recorder)
{
  double force = 0, torque = 0, most_force = 0, most_torque = 0, most_work = 0;
  for (const HistoryRow &row : recorder.rows) {
    force = std::max(force, std::abs(row.measurement.force_mismatch()));
    torque = std::max(torque, std::abs(row.measurement.torque_mismatch()));
    most_force = std::max(most_force, std::abs(row.measurement.normal_force));
    most_torque = std::max(most_torque, std::abs(row.measurement.torque));
    most_work = std::max(most_work, std::abs(row.energy.work));
  }
  const HistoryRow last = recorder.rows.empty() ? HistoryRow{} : recorder.rows.back();
  Json json{{"max_normal_force_N", most_force},
            {"max_torque_Nmm", most_torque},
            {"max_force_mismatch_N", force},
            {"max_torque_mismatch_Nmm", torque}};
  for (const char *name :
       {"work_of_plates_Nmm", "stored_energy_Nmm", "viscous_dissipation_Nmm", "frictional_dissipation_Nmm"})
    json[name] = json_of(history_column(name).value(last));
  json["energy_residual_relative"] = number(last.energy.residual() / most_work);
  return json;
}

Json describe(const Extrapolation &error)
{
  return {{"error", number(error.error)},
          {"observed_order", number(error.order)},
          {"verdict", convergence_names[static_cast<std::size_t>(error.verdict)]}};
}

Json describe(const ErrorEstimate &estimate, const std::vector<PhaseEnd> &ends)
{
  Json json{{"notes", estimate.notes}, {"cpu_s", estimate.cpu_seconds}};
  json["companions"] = Json::array();
  for (const Companion &companion : estimate.companions)
    json["companions"].push_back({{"name", companion.name},
                                  {"edges_over_run", companion.size},
                                  {"tolerance_over_run", companion.tolerance_over},
                                  {"unknowns", companion.unknowns},
                                  {"accepted_steps", companion.steps},
                                  {"cpu_s", companion.cpu_seconds},
                                  {"failure", companion.failure}});
  json["phases"] = Json::array();
  for (std::size_t k = 0; k < estimate.phases.size(); ++k) {
    Json phase{{"phase", ends[k].phase}, {"time_s", ends[k].time}};
    const char *const names[] = {"normal_force_N", "torque_Nmm"};
    const double values[] = {ends[k].measurement.normal_force, ends[k].measurement.torque};
    for (std::size_t load = 0; load < 2; ++load)
      phase[names[load]] = {{"value", number(values[load])},
                            {"mesh", describe(estimate.phases[k][load].mesh)},
                            {"time", describe(estimate.phases[k][load].time)}};
    json["phases"].push_back(phase);
  }
  return json;
}

/// The law with its numbers, and its curve mu(v), that of steady sliding, for drawings: three decades below
/// the slowest rim's speed up to the fastest, under the mean pressure at the end.
Json describe_law(const Scene &scene, const Recorder &recorder)
{
  constexpr int points = 61;
  const FrictionLaw &law = *scene.friction.law();
  Json json{{"name", law.declaration().name},
            {"in_numbers", law.in_numbers()},
            {"source", law.declaration().source}};
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
  for (const Phase &phase : scene.schedule) {
    const double rim = std::abs(phase.rate) * scene.upper_gel().radius;
    if (rim > 0) slowest = std::min(slowest, rim);
    fastest = std::max(fastest, rim);
  }
  const Measurement last = recorder.rows.empty() ? Measurement{} : recorder.rows.back().measurement;
  const double pressure = last.normal_force / (std::numbers::pi * last.contact_radius * last.contact_radius);
  if (!(fastest > 0 && pressure > 0 && std::isfinite(pressure))) return json;
  json["pressure_MPa"] = pressure;
  const double lowest = 1e-3 * slowest;
  for (int k = 0; k < points; ++k) {
    const double v = lowest * std::pow(fastest / lowest, static_cast<double>(k) / (points - 1));
    json["speed_mm_per_s"].push_back(v);
    json["mu"].push_back(number(scene.friction.coefficient(v, pressure)));
  }
  return json;
}

std::string petsc_version()
{
  char text[256];
  PetscGetVersion(text, sizeof text);
  return text;
}

Json summary_of(const Problem &problem, const Recorder &recorder, const RunOutcome &outcome,
                const RunCost &cost, const std::vector<std::pair<std::string, std::string>> &options,
                const std::vector<std::string> &warnings, const ErrorEstimate *estimate)
{
  Json json;
  json["program"] = {{"name", "tribogel"}, {"version", version}, {"petsc", petsc_version()}};
  json["status"] = outcome.status;
  json["reason"] = outcome.reason;
  json["time_s"] = problem.stepper.state.time;
  for (const auto &[name, value] : options) json["options"][name] = value;
  if (problem.system.scene.has_contact() && problem.system.scene.friction.law())
    json["friction_law"] = describe_law(problem.system.scene, recorder);
  json["warnings"] = warnings;
  json["notices"] = recorder.notices;
  json["phases"] = phase_ends(recorder);
  json["balances"] = balances(recorder);
  int most_newton = 0;
  double longest = 0;
  for (const HistoryRow &row : recorder.rows) {
    most_newton = std::max(most_newton, static_cast<int>(row.report.newton_iterations));
    longest = std::max(longest, row.step);
  }
  const SolveCounts &counts = problem.stepper.counts;
  json["counts"] = {{"unknowns", problem.system.mesh.unknowns},
                    {"accepted_steps", counts.accepted_steps},
                    {"rejected_steps", counts.rejected_steps},
                    {"failed_solves", counts.failed_solves},
                    {"newton_iterations", counts.newton_iterations},
                    {"largest_newton_iterations", most_newton},
                    {"linear_iterations", counts.linear_iterations},
                    {"matrix_pattern_rebuilds", counts.pattern_rebuilds},
                    {"longest_step_s", longest}};
  for (int k = 0; k < failure_kinds; ++k)
    json["failures"][failure_names[k]] = counts.failures[static_cast<std::size_t>(k)];
  json["cost"] = {{"ranks", cost.ranks},
                  {"restarts", cost.restarts},
                  {"cpu_s", cost.cpu_seconds},
                  {"wall_s", cost.wall_seconds},
                  {"peak_memory_MB", cost.peak_memory_MB}};
  if (estimate) json["error_estimate"] = describe(*estimate, recorder.phases);
  return json;
}

} // namespace

PetscErrorCode WriteSummary(MPI_Comm comm, const std::string &directory, const Problem &problem,
                            const Recorder &recorder, const RunOutcome &outcome, const RunCost &cost,
                            const std::vector<std::pair<std::string, std::string>> &options,
                            const std::vector<std::string> &warnings, const ErrorEstimate *estimate,
                            std::string &complaint)
{
  constexpr int indentation = 2;
  PetscFunctionBeginUser;
  const auto write = [&] {
    const Json json = summary_of(problem, recorder, outcome, cost, options, warnings, estimate);
    // A directory's name need not be UTF-8.
    const std::string text = json.dump(indentation, ' ', false, Json::error_handler_t::replace);
    return replace_file(directory + "/summary.json", text + "\n");
  };
  PetscCall(OnFirstProcess(comm, write, complaint));
  PetscFunctionReturn(0);
}

} // namespace tribogel
