#include "observe/recorder.hpp"

#include "scene/first_process.hpp"
#include "support/data_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace tribogel
{

namespace
{

constexpr const char *history_header =
    "time_s,phase,approach_mm,rotation_rad,rate_rad_per_s,normal_force_N,torque_Nmm,contact_radius_mm,mu_apparent,"
    "mu_gong,mu_mean,mu_area_weighted,mu_pressure_weighted,newton_iterations,linear_iterations,step_s,contact_force_N,"
    "contact_torque_Nmm,force_mismatch_N,torque_mismatch_Nmm,work_of_plates_Nmm,stored_energy_Nmm,"
    "viscous_dissipation_Nmm,frictional_dissipation_Nmm,transverse_force_x_N,transverse_force_y_N,bending_moment_x_Nmm,"
    "bending_moment_y_Nmm";
constexpr const char *profile_header =
    "time_s,phase,surface,reference_r_mm,reference_theta_rad,reference_z_mm,r_mm,theta_rad,z_mm,pressure_MPa,"
    "traction_radial_MPa,traction_circumferential_MPa,sliding_velocity_mm_per_s,mu,status";

/// 17 significant digits: the number is read back bit for bit.
std::string text(double x)
{
  if (std::isnan(x)) return "nan";
  std::array<char, 40> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.17g", x);
  return buffer.data();
}

template <class... Cells> std::string comma_separated(const Cells &...cells)
{
  std::string line;
  const auto append = [&line](const auto &cell) {
    if (!line.empty()) line += ',';
    if constexpr (std::is_convertible_v<decltype(cell), std::string>)
      line += cell;
    else if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(cell)>>)
      line += text(cell);
    else
      line += std::to_string(cell);
  };
  (append(cells), ...);
  return line;
}

/// How far the bottom surface has gone down at the current radius r, between its nodes; a surface in space has them in
/// any order and more than one at a radius.
double displacement_at(const std::vector<ProfileRow> &profile, double r)
{
  const auto down = [](const ProfileRow *row) { return row->reference_z - row->z; };
  const ProfileRow *inner = nullptr, *outer = nullptr; // the nearest with a smaller radius, and with r or a larger one
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

PetscErrorCode Recorder::Start(Problem &problem)
{
  PetscFunctionBeginUser;
  const bool goes_on = !rows.empty();
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(problem.mesh.dm)));
  std::string complaint;
  if (!directory.empty())
    PetscCall(OnFirstProcess(
        comm, [&] { return open(goes_on); }, complaint));
  PetscCheck(complaint.empty(), comm, PETSC_ERR_FILE_WRITE, "%s", complaint.c_str());
  if (!goes_on) PetscCall(Record(problem, {}));
  PetscFunctionReturn(0);
}

std::array<std::string, 2> Recorder::paths() const
{
  return {directory + "/history.csv", directory + "/profile.csv"};
}

/// New files, or those that are there without what was written after the last checkpoint. Returns what went wrong.
std::string Recorder::open(bool goes_on)
{
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::error_code failed;
    if (goes_on) std::filesystem::resize_file(paths()[k], bytes[k], failed);
    std::ofstream &file = k == 0 ? history : profile;
    file.open(paths()[k], goes_on ? std::ios::app : std::ios::trunc);
    if (!goes_on) file << (k == 0 ? history_header : profile_header) << std::endl;
    if (failed || !file) return paths()[k] + " cannot be written";
  }
  return {};
}

void Recorder::bring_to_disk()
{
  if (!history.is_open()) return;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::error_code ignored;
    tribogel::bring_to_disk(paths()[k]);
    bytes[k] = std::filesystem::file_size(paths()[k], ignored);
  }
}

std::string Recorder::objection_to_resume() const
{
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(paths()[k], failed);
    if (failed) return paths()[k] + ": " + failed.message();
    if (size < bytes[k]) return paths()[k] + " is shorter than at the checkpoint";
  }
  return {};
}

PetscErrorCode Recorder::Step(Problem &problem, const StepReport &report)
{
  PetscFunctionBeginUser;
  PetscCall(Record(problem, report));
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Failed(Problem &problem, const StepFailure &failure)
{
  PetscFunctionBeginUser;
  if (on_first_failure && problem.counts.failures[static_cast<std::size_t>(failure.kind)] == 1)
    on_first_failure(failure);
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Notice(Problem &, const std::string &text)
{
  PetscFunctionBeginUser;
  notices.push_back(text);
  if (on_notice) on_notice(text);
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Conclude(Problem &problem)
{
  PetscFunctionBeginUser;
  const bool pressed = std::any_of(rows.begin(), rows.end(), [&problem](const HistoryRow &row) {
    return std::abs(row.measurement.normal_force) > problem.least_loads[0];
  });
  if (pressed || !problem.contact || !problem.contact->between_gels()) PetscFunctionReturn(0);
  double approach = 0;
  for (const Phase &phase : problem.scene.schedule) approach = std::max(approach, phase.end_approach);
  std::ostringstream text;
  text << "the gels have never been pressed together: N and T are zero throughout. The top plate comes down by "
       << approach << " mm at most, and the gels are " << problem.scene.initial_gap
       << " mm apart at the start: -schedule_approach has to be larger than -initial_gap";
  PetscCall(Notice(problem, text.str()));
  PetscFunctionReturn(0);
}

PetscErrorCode Recorder::Record(Problem &problem, const StepReport &report)
{
  HistoryRow row{};
  std::vector<ProfileRow> surfaces;
  PetscFunctionBeginUser;
  const State &state = problem.state;
  const Phase &phase = problem.phase();
  PetscCall(Measure(problem, row.measurement, report.ends_phase ? &surfaces : nullptr));
  row.time = state.time;
  row.phase = state.phase + 1;
  row.approach = phase.approach(state.time);
  row.rotation = phase.rotation(state.time);
  row.rate = phase.rate;
  row.step = state.step;
  row.report = report;
  PetscCall(AddEnergies(problem, rows.empty() ? nullptr : &rows.back().measurement, row.measurement,
                        rows.empty() ? EnergyBalance{} : rows.back().energy, row.energy));
  rows.push_back(row);
  write_row(row);
  if (report.ends_phase) {
    last_profile = std::move(surfaces);
    phases.push_back({row.phase, row.time, row.approach, row.rotation, row.rate, row.measurement,
                      displacement_at(last_profile, 0), displacement_at(last_profile, row.measurement.contact_radius)});
    write_profile(row.time, row.phase);
  }
  if (on_row) on_row(row);
  PetscFunctionReturn(0);
}

void Recorder::write_row(const HistoryRow &row)
{
  if (!history.is_open()) return;
  const Measurement &m = row.measurement;
  const EnergyBalance &e = row.energy;
  history << comma_separated(row.time, row.phase, row.approach, row.rotation, row.rate, m.normal_force, m.torque,
                             m.contact_radius, m.mu_apparent, m.mu_gong, m.mu_mean, m.mu_area_weighted,
                             m.mu_pressure_weighted, row.report.newton_iterations, row.report.linear_iterations,
                             row.step, m.contact_force, m.contact_torque, m.force_mismatch(), m.torque_mismatch(),
                             e.work, e.stored, e.viscous, e.friction, m.transverse_force[0], m.transverse_force[1],
                             m.bending_moment[0], m.bending_moment[1])
          << std::endl;
}

void Recorder::write_profile(double time, int phase)
{
  if (!profile.is_open()) return;
  for (const ProfileRow &row : last_profile)
    profile << comma_separated(time, phase, row.surface, row.reference_r, row.reference_theta, row.reference_z, row.r,
                               row.theta, row.z, row.pressure, row.traction_radial, row.traction_circumferential,
                               row.sliding_velocity, row.mu, row.status)
            << '\n';
  profile.flush();
}

} // namespace tribogel
