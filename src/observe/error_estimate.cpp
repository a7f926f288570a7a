#include "observe/error_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

bool follows_tolerance()
{
  PetscBool given = PETSC_FALSE, none = PETSC_FALSE;
  char type[64] = "";
  PetscOptionsGetString(nullptr, nullptr, "-ts_adapt_type", type, sizeof type, &given);
  PetscStrcmp(type, TSADAPTNONE, &none);
  return !given || !none;
}

/// Which companions there are, and which not and why.
void plan(const Scene &scene, ErrorEstimate &estimate)
{
  estimate.companions = mesh_companions(scene);
  if (estimate.companions.empty())
    estimate.notes.push_back(scene.round ? "mesh: there is no coarser one; use more -elements_radial"
                                         : "mesh: there is no other one than that of -mesh_file");
  if (scene.schedule_kind == ScheduleKind::steady) return; // nothing is integrated
  if (!follows_tolerance()) {
    estimate.notes.emplace_back("time: with -ts_adapt_type none the steps follow no tolerance");
    return;
  }
  for (Companion &companion : time_companions(scene)) estimate.companions.push_back(companion);
}

std::vector<Level> series(const std::vector<Companion> &companions, bool in_time, std::size_t phase,
                          std::size_t load, double value)
{
  std::vector<Level> levels;
  for (const Companion &companion : companions) {
    const double size = in_time ? companion.tolerance_over : companion.size;
    if (size != 1 && companion.failure.empty()) levels.push_back({size, companion.ends[phase][load]});
  }
  levels.push_back({1, value});
  return levels;
}

} // namespace

void judge(const Scene &scene, const std::vector<PlateLoads> &ends, ErrorEstimate &estimate)
{
  PlateLoads largest{};
  for (const PlateLoads &end : ends)
    for (std::size_t load = 0; load < 2; ++load) largest[load] = std::max(largest[load], std::abs(end[load]));
  const double length = scene.twist_length();
  const PlateLoads scale{std::max(largest[0], largest[1] / length),
                         std::max(largest[1], largest[0] * length)};
  // Of the tolerance's power that the error goes with: THEORY 4.2, 4.4.
  const double time_order = scene.time.rule == TimeRule::sdirk2 ? 1 : 0.5;
  double newton = 0; // what is solved no better than that has no smaller error
  for (const Companion &companion : estimate.companions)
    newton = std::max(newton, companion.newton_tolerance);
  for (std::size_t phase = 0; phase < ends.size(); ++phase) {
    std::array<LoadErrors, 2> errors;
    for (std::size_t load = 0; load < 2; ++load) {
      const double value = ends[phase][load];
      errors[load].mesh = extrapolate(series(estimate.companions, false, phase, load, value), scale[load]);
      const std::vector<Level> steps = series(estimate.companions, true, phase, load, value);
      if (steps.size() == 2)
        errors[load].time = extrapolate_with(time_order, steps[1], steps[0], scale[load]);
      if (scene.schedule_kind == ScheduleKind::steady) errors[load].time = {Convergence::settled, value, 0};
      errors[load].time.error += newton * std::abs(value);
    }
    estimate.phases.push_back(errors);
  }
}

PetscErrorCode EstimateErrors(MPI_Comm comm, const Scene &scene, const SerialMesh *serial,
                              const Recorder &run, const StopQuestion &ask,
                              const std::function<void(const Companion &)> &told, ErrorEstimate &estimate)
{
  std::string why;
  bool stopped = false;
  PetscFunctionBeginUser;
  plan(scene, estimate);
  for (Companion &companion : estimate.companions) {
    PetscCall(ask(comm, why));
    if (why.empty()) PetscCall(RunCompanion(comm, scene, serial, ask, companion, stopped));
    if (stopped) why = companion.failure;
    if (!why.empty()) {
      estimate.notes.push_back(why);
      break;
    }
    estimate.cpu_seconds += companion.cpu_seconds;
    if (!companion.failure.empty())
      estimate.notes.push_back(companion.name + ": failed: " + companion.failure);
    told(companion);
  }
  if (!why.empty()) PetscFunctionReturn(0); // half an estimate would be taken for a whole one
  std::vector<PlateLoads> ends;
  for (const PhaseEnd &end : run.phases)
    ends.push_back({end.measurement.normal_force, end.measurement.torque});
  judge(scene, ends, estimate);
  PetscFunctionReturn(0);
}

} // namespace tribogel
