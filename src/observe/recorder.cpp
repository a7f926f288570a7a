#include "observe/recorder.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

constexpr const char *history_header =
    "time_s,phase,approach_mm,rotation_rad,rate_rad_per_s,normal_force_N,torque_Nmm,contact_radius_mm,mu_apparent,"
    "mu_gong,mu_mean,mu_area_weighted,mu_pressure_weighted,newton_iterations,linear_iterations,step_s,contact_force_N,"
    "contact_torque_Nmm,force_mismatch_N,torque_mismatch_Nmm,work_of_plates_Nmm,stored_energy_Nmm,"
    "viscous_dissipation_Nmm,frictional_dissipation_Nmm";
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

/// How far the bottom surface has gone down at the current radius r, between its nodes.
double displacement_at(const std::vector<ProfileRow> &profile, double r)
{
  const ProfileRow *before = nullptr;
  for (const ProfileRow &row : profile) {
    if (row.surface != std::string("bottom")) continue;
    const double down = row.reference_z - row.z;
    if (row.r >= r) {
      if (!before) return down;
      const double s = (r - before->r) / (row.r - before->r);
      return (1 - s) * (before->reference_z - before->z) + s * down;
    }
    before = &row;
  }
  return undefined;
}

} // namespace

PetscErrorCode Recorder::Start(Problem &problem)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(problem.mesh.dm))), &rank));
  if (rank == 0 && !directory.empty()) {
    history.open(directory + "/history.csv");
    profile.open(directory + "/profile.csv");
    history << history_header << std::endl;
    profile << profile_header << std::endl;
  }
  PetscCall(Record(problem, {}));
  PetscFunctionReturn(0);
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
                             e.work, e.stored, e.viscous, e.friction)
          << std::endl;
}

void Recorder::write_profile(double time, int phase)
{
  if (!profile.is_open()) return;
  for (const ProfileRow &row : last_profile)
    profile << comma_separated(time, phase, row.surface, row.reference_r, 0.0, row.reference_z, row.r, row.theta, row.z,
                               row.pressure, row.traction_radial, row.traction_circumferential, row.sliding_velocity,
                               row.mu, row.status)
            << '\n';
  profile.flush();
}

} // namespace tribogel
