#include "observe/checkpoint.hpp"

#include "observe/record.hpp"
#include "support/first_process.hpp"
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

/// A record's numbers, and their names; older checkpoints have no names and call the numbers something else.
struct RecordName {
  const char *numbers, *names, *before;
};
constexpr RecordName steps_name{"history_rows", "history_columns", "rows"};
constexpr RecordName phase_ends_name{"phase_end_rows", "phase_end_columns", "phases"};

PetscErrorCode Load(Loader &load, const RecordName &place, const std::string &unwritten_names, Record &record)
{
  PetscFunctionBeginUser;
  PetscCall(load.Text(place.names, record.names));
  const bool named = !record.names.empty();
  if (!named) record.names = unwritten_names;
  PetscCall(load.Table(named ? place.numbers : place.before, record.numbers));
  PetscFunctionReturn(0);
}

void put(const Record &record, const RecordName &place, DataFile &data)
{
  data.numbers[place.numbers] = record.numbers;
  data.texts[place.names] = record.names;
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

Checkpoint::Checkpoint(Recorder &record, OutputSettings where, std::string all_options, std::string of_mesh,
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
  Record rows, phases;
  std::vector<double> bytes;
  PetscFunctionBeginUser;
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  PetscCall(Orders(problem));
  Loader load(*orders, comm, stored.data);
  PetscCall(VisitState(problem.stepper.state, load));
  PetscCall(VisitCounts(problem.stepper.counts, load));
  PetscCall(VisitCost(earlier, load));
  PetscCall(Load(load, steps_name, unwritten_row_names(), rows));
  PetscCall(Load(load, phase_ends_name, unwritten_phase_end_names(), phases));
  PetscCall(load.Table("bytes", bytes));
  const bool whole = read_record(rows, recorder.rows) && !recorder.rows.empty() &&
                     read_record(phases, recorder.rows, recorder.phases) &&
                     bytes.size() == recorder.bytes.size();
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
  ask = ask_signals_and_clock(wall_start, output.wall_time);
  last_written = MPI_Wtime();
  if (!restored) PetscCall(Write(problem));
  PetscFunctionReturn(0);
}

PetscErrorCode Checkpoint::Step(const Problem &problem, const StepReport &report)
{
  PetscFunctionBeginUser;
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  std::string why;
  PetscCall(ask(comm, why));
  int due = MPI_Wtime() - last_written >= output.checkpoint_every; // clocks differ between the ranks
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &due, 1, MPI_INT, MPI_MAX, comm));
  const bool over = problem.stepper.state.time == problem.system.scene.schedule.back().end_time;
  const bool ends = !over && !why.empty();
  if (ends || due || report.ends_phase) PetscCall(Write(problem));
  if (ends) {
    char when[64];
    std::snprintf(when, sizeof when, " at t = %.10g s, to be continued with -restart ",
                  problem.stepper.state.time);
    stop.request(why + when + output.directory);
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
    put(record_of(recorder.rows), steps_name, data);
    put(record_of(recorder.phases), phase_ends_name, data);
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
