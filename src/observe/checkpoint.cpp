#include "observe/checkpoint.hpp"

#include "observe/record_numbers.hpp"
#include "support/first_process.hpp"
#include "support/stop_signals.hpp"
#include "support/version.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <utility>

namespace tribogel
{

namespace
{

const std::string kind = std::string("checkpoint of tribogel ") + version;

constexpr const char *mesh_name = "mesh"; ///< of its digest in the file

template <class AnyCounts, class Visitor> PetscErrorCode VisitCounts(AnyCounts &counts, Visitor &visit)
{
  PetscFunctionBeginUser;
  PetscCall(visit("accepted_steps", counts.accepted_steps));
  PetscCall(visit("rejected_steps", counts.rejected_steps));
  PetscCall(visit("failed_solves", counts.failed_solves));
  PetscCall(visit("newton_iterations", counts.newton_iterations));
  PetscCall(visit("linear_iterations", counts.linear_iterations));
  PetscCall(visit("pattern_rebuilds", counts.pattern_rebuilds));
  for (int k = 0; k < failure_kinds; ++k)
    PetscCall(
        visit(std::string("failures_") + failure_names[k], counts.failures[static_cast<std::size_t>(k)]));
  PetscFunctionReturn(0);
}

template <class Visitor> PetscErrorCode VisitCost(RunCost &cost, Visitor &visit)
{
  PetscFunctionBeginUser;
  PetscCall(visit("cpu_seconds", cost.cpu_seconds));
  PetscCall(visit("wall_seconds", cost.wall_seconds));
  PetscCall(visit("restarts", cost.restarts));
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode ReadStoredRun(MPI_Comm comm, const std::string &directory, StoredRun &stored)
{
  PetscFunctionBeginUser;
  stored.directory = directory;
  PetscCall(OnFirstProcess(comm, [&] {
    const std::string why = read_data_file(checkpoint_in(stored.directory), kind, stored.data);
    if (why.empty()) stored.options = stored.data.texts["options"];
    return why.empty()
               ? why
               : "-restart = " + stored.directory + ": " + why +
                     "; allowed: the directory of a run of this version that has written a checkpoint";
  }));
  PetscCall(Broadcast(comm, stored.options));
  PetscFunctionReturn(0);
}

PetscErrorCode ExpectSameMesh(MPI_Comm comm, const StoredRun &stored, const std::string &digest,
                              const std::string &option)
{
  PetscFunctionBeginUser;
  PetscCall(OnFirstProcess(comm, [&]() -> std::string {
    const auto before = stored.data.texts.find(mesh_name);
    if (before == stored.data.texts.end())
      return "-restart = " + stored.directory +
             ": the checkpoint tells nothing of its mesh; allowed: one of this version";
    if (before->second == digest) return {};
    return option + ": the mesh is not that of the run in " + stored.directory +
           " (other nodes, cells or groups, or in another order); allowed: to continue it, the same mesh";
  }));
  PetscFunctionReturn(0);
}

Checkpoint::Checkpoint(Recorder &record, OutputParameters where, std::string all_options, std::string of_mesh,
                       double start)
    : recorder(record), output(std::move(where)), options(std::move(all_options)), mesh(std::move(of_mesh)),
      wall_start(start)
{
}

PetscErrorCode Checkpoint::Orders(const Problem &problem)
{
  PetscFunctionBeginUser;
  if (orders) PetscFunctionReturn(0);
  PetscCall(orders.emplace().SetUp(problem));
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Restore(const StoredRun &stored, Problem &problem)
{
  std::vector<double> rows, phases, bytes;
  PetscFunctionBeginUser;
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  PetscCall(Orders(problem));
  Loader load(*orders, comm, stored.data);
  PetscCall(VisitState(problem.stepper.state, load));
  PetscCall(VisitCounts(problem.stepper.counts, load));
  PetscCall(VisitCost(earlier, load));
  PetscCall(load.Table("rows", rows));
  PetscCall(load.Table("phases", phases));
  PetscCall(load.Table("bytes", bytes));
  const bool whole = rows_of(rows, recorder.rows) && !recorder.rows.empty() &&
                     rows_of(phases, recorder.phases) && bytes.size() == recorder.bytes.size();
  PetscCall(OnFirstProcess(comm, [&]() -> std::string {
    const std::string place = "-restart = " + stored.directory + ": ";
    if (!load.complaint.empty() || !whole)
      return place + "the checkpoint's " + (load.complaint.empty() ? "record" : load.complaint) +
             " does not fit; allowed: a checkpoint of this version and scene";
    std::copy(bytes.begin(), bytes.end(), recorder.bytes.begin());
    std::istringstream notices(stored.data.texts.at("notices"));
    for (std::string line; std::getline(notices, line);) recorder.notices.push_back(line);
    const std::string lost = recorder.objection_to_resume();
    return lost.empty() ? lost : place + lost + "; allowed: the files as the run left them";
  }));
  ++earlier.restarts;
  restored = true;
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Start(const Problem &problem)
{
  PetscFunctionBeginUser;
  last_step = last_written = MPI_Wtime();
  if (!restored) PetscCall(Write(problem));
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Step(const Problem &problem, const StepReport &report)
{
  PetscFunctionBeginUser;
  const double now = MPI_Wtime();
  longest_step = std::max(longest_step, now - last_step);
  last_step = now;
  // Signals and clocks differ between the ranks.
  enum { signal, time_over, due, wishes };
  int wish[wishes] = {caught_stop_signal(), now - wall_start + longest_step > output.wall_time,
                      now - last_written >= output.checkpoint_every};
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, wish, wishes, MPI_INT, MPI_MAX, comm));
  const bool over = problem.stepper.state.time == problem.system.scene.schedule.back().end_time;
  const bool ends = !over && (wish[signal] || wish[time_over]);
  if (ends || wish[due] || report.ends_phase) PetscCall(Write(problem));
  if (ends) {
    char when[64];
    std::snprintf(when, sizeof when, " at t = %.10g s, to be continued with -restart ",
                  problem.stepper.state.time);
    stop.request(std::string("stopped by ") + (wish[signal] ? stop_signal_name(wish[signal]) : "-wall_time") +
                 when + output.directory);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Write(const Problem &problem)
{
  DataFile data;
  RunCost cost;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  if (!recorder.complaint.empty()) PetscFunctionReturn(0); // the last one fits what is in the files
  PetscCall(events.Register());
  PetscCall(PetscLogEventBegin(events.checkpoint, 0, 0, 0, 0));
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(Orders(problem));
  Saver save(*orders, comm, data);
  PetscCall(VisitState(problem.stepper.state, save));
  PetscCall(VisitCounts(problem.stepper.counts, save));
  PetscCall(Cost(comm, cost));
  PetscCall(VisitCost(cost, save));
  std::string complaint;
  const auto write = [&] {
    if (std::string failed = recorder.bring_to_disk(); !failed.empty())
      return failed + recorder.way_out(problem);
    data.numbers["rows"] = numbers_of(recorder.rows);
    data.numbers["phases"] = numbers_of(recorder.phases);
    data.numbers["bytes"].assign(recorder.bytes.begin(), recorder.bytes.end());
    data.texts["options"] = options;
    data.texts[mesh_name] = mesh;
    std::string &notices = data.texts["notices"];
    for (const std::string &line : recorder.notices) notices += line + "\n";
    const std::string failed = write_data_file(checkpoint_in(output.directory), kind, data);
    return failed.empty() ? failed : failed + recorder.way_out(problem);
  };
  PetscCall(OnFirstProcess(comm, write, complaint)); // PETSc calls this: nothing may be thrown
  if (!complaint.empty()) stop.give_up(complaint);
  last_written = MPI_Wtime();
  PetscCall(PetscLogEventEnd(events.checkpoint, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Cost(MPI_Comm comm, RunCost &cost) const
{
  PetscFunctionBeginUser;
  PetscCall(MeasureCost(comm, wall_start, cost));
  cost.cpu_seconds += earlier.cpu_seconds;
  cost.wall_seconds += earlier.wall_seconds;
  cost.restarts = earlier.restarts;
  PetscFunctionReturn(0);
}

} // namespace tribogel
