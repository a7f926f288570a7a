#include "observe/columns.hpp"

#include "support/first_process.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tribogel
{

namespace
{

/// Of history.csv and profile.csv.
enum : std::size_t { history_file, profile_file };
constexpr std::array files = {history_file, profile_file};

std::string header(std::size_t file)
{
  return file == history_file ? header_of(history_columns()) : header_of(profile_columns());
}

/// How far the bottom surface has gone down at the current radius r, between its nodes; a surface in space
/// has them in any order and more than one at a radius.
double displacement_at(const std::vector<ProfileRow> &profile, double r)
{
  const auto down = [](const ProfileRow *row) { return row->reference_z - row->z; };
  const ProfileRow *inner = nullptr,
                   *outer = nullptr; // the nearest with a smaller radius, and with r or a larger one
  for (const ProfileRow &row : profile) {
    if (row.surface != std::string("bottom")) continue;
    if (row.r >= r) {
      if (!outer || row.r < outer->r) outer = &row;
    } else if (!inner || row.r > inner->r)
      inner = &row;
  }
  if (!outer) return undefined;
  if (!inner) return down(outer);
  const double s = (r - inner->r) / (outer->r - inner->r);
  return (1 - s) * down(inner) + s * down(outer);
}

} // namespace

PetscErrorCode Recorder::Start(const Problem &problem)
{
  PetscFunctionBeginUser;
  const bool goes_on = !rows.empty();
  PetscCall(Write(problem, [&] { return open(goes_on); }));
  if (!goes_on) PetscCall(Record(problem, {}));
  PetscFunctionReturn(0);
}

/// The first process works; what it could not write ends the run on all.
PetscErrorCode Recorder::Write(const Problem &problem, const std::function<std::string()> &work)
{
  PetscFunctionBeginUser;
  if (directory.empty() || !complaint.empty()) PetscFunctionReturn(0);
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(problem.system.mesh.dm)));
  const auto explained = [&] {
    const std::string failed = work();
    return failed.empty() ? failed : failed + way_out(problem);
  };
  PetscCall(OnFirstProcess(comm, explained, complaint));
  if (!complaint.empty()) stop.give_up(complaint);
  PetscFunctionReturn(0);
}

std::string Recorder::way_out(const Problem &problem) const
{
  char when[40];
  std::snprintf(when, sizeof when, " (at t = %.10g s); ", problem.stepper.state.time);
  std::error_code ignored;
  const bool resumable = std::filesystem::exists(checkpoint_in(directory), ignored);
  return when + (resumable ? "what was written before is kept, and -restart " + directory +
                                 " goes on from its checkpoint"
                           : "there is no checkpoint to go on from");
}

std::string checkpoint_in(const std::string &directory)
{
  return directory + "/checkpoint.h5";
}

std::array<std::string, 2> Recorder::paths() const
{
  return {directory + "/history.csv", directory + "/profile.csv"};
}

/// New files, or those that are there without what was written after the last checkpoint. Returns what went
/// wrong.
std::string Recorder::open(bool goes_on)
{
  for (const std::size_t k : files) {
    GrowingFile &file = k == history_file ? history : profile;
    std::string failed = goes_on ? file.resume(paths()[k], bytes[k]) : file.create(paths()[k]);
    if (failed.empty() && !goes_on) failed = file.append(header(k) + "\n");
    if (!failed.empty()) return failed;
  }
  return {};
}

std::string Recorder::bring_to_disk()
{
  bytes = {history.size(), profile.size()};
  for (GrowingFile *file : {&history, &profile})
    if (std::string failed = file->bring_to_disk(); !failed.empty()) return failed;
  return {};
}

std::string Recorder::objection_to_resume() const
{
  for (const std::size_t k : files) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(paths()[k], failed);
    if (failed) return paths()[k] + ": " + failed.message();
    if (size < bytes[k]) return paths()[k] + " is shorter than at the checkpoint";
    std::string first;
    std::getline(std::ifstream(paths()[k]), first);
    if (first != header(k)) return paths()[k] + " has other columns than this program writes";
  }
  return {};
}

PetscErrorCode Recorder::Step(const Problem &problem, const StepReport &report)
{
  PetscFunctionBeginUser;
  PetscCall(Record(problem, report));
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Failed(const Problem &problem, const StepFailure &failure)
{
  PetscFunctionBeginUser;
  if (on_first_failure && problem.stepper.counts.failures[static_cast<std::size_t>(failure.kind)] == 1)
    on_first_failure(failure);
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Notice(const Problem &, const std::string &text)
{
  PetscFunctionBeginUser;
  notices.push_back(text);
  if (on_notice) on_notice(text);
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Conclude(const Problem &problem)
{
  PetscFunctionBeginUser;
  const bool pressed = std::any_of(rows.begin(), rows.end(), [&problem](const HistoryRow &row) {
    return std::abs(row.measurement.normal_force) > problem.system.least.loads[0];
  });
  if (pressed || !problem.system.contact || !problem.system.contact->between_gels()) PetscFunctionReturn(0);
  double approach = 0;
  for (const Phase &phase : problem.system.scene.schedule) approach = std::max(approach, phase.end_approach);
  std::ostringstream text;
  text << "the gels have never been pressed together: N and T are zero throughout. The top plate comes down "
          "by "
       << approach << " mm at most, and the gels are " << problem.system.scene.initial_gap
       << " mm apart at the start: -schedule_approach has to be larger than -initial_gap";
  PetscCall(Notice(problem, text.str()));
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Record(const Problem &problem, const StepReport &report)
{
  HistoryRow row{};
  std::vector<ProfileRow> surfaces;
  PetscFunctionBeginUser;
  const State &state = problem.stepper.state;
  const PlateMotion motion = problem.stepper.motion(state.time);
  PetscCall(Measure(problem, row.measurement, report.ends_phase ? &surfaces : nullptr));
  row.time = state.time;
  row.phase = state.phase + 1;
  row.approach = -motion.top_travel;
  row.rotation = motion.top_rotation;
  row.rate = motion.top_rate;
  row.step = state.step;
  row.report = report;
  PetscCall(AddEnergies(problem, rows.empty() ? nullptr : &rows.back().measurement, row.measurement,
                        rows.empty() ? EnergyBalance{} : rows.back().energy, row.energy));
  rows.push_back(row);
  PetscCall(Write(problem, [&] { return history.append(line_of(history_columns(), row)); }));
  if (report.ends_phase) {
    last_profile = std::move(surfaces);
    phases.push_back({row, displacement_at(last_profile, 0),
                      displacement_at(last_profile, row.measurement.contact_radius)});
    PetscCall(Write(problem, [&] { return profile.append(profile_of(phases.back())); }));
  }
  if (on_row) on_row(row);
  PetscFunctionReturn(0);
}

std::string Recorder::profile_of(const PhaseEnd &end) const
{
  std::string text;
  for (const ProfileRow &row : last_profile) text += line_of(profile_columns(), ProfileLine{end, row});
  return text;
}

} // namespace tribogel
