/// tribogel: two gels in a rheometer. Options in; force, torque and friction out; see -help.
#include "gmsh/mesh_file.hpp"
#include "mesh/digest.hpp"
#include "observe/checkpoint.hpp"
#include "observe/columns.hpp"
#include "observe/output_directory.hpp"
#include "observe/progress.hpp"
#include "options/help.hpp"
#include "options/option_table.hpp"
#include "options/petsc_options.hpp"
#include "options/report.hpp"
#include "options/stored_options.hpp"
#include "support/console.hpp"
#include "support/exit_status.hpp"
#include "support/parse.hpp"
#include "support/petsc_session.hpp"
#include "support/stop_signals.hpp"
#include "support/version.hpp"

#include <cstdio>
#include <functional>

namespace tribogel
{

namespace
{

bool is_first_process()
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == 0;
}

/// Prints all that was asked for. Returns the exit status.
int answer(const std::string &text)
{
  const std::string why = is_first_process() ? print_whole(text) : "";
  if (!why.empty()) print_error("standard output: " + why);
  return why.empty() ? exit_status::completed : exit_status::cannot_go_on;
}

std::string version_text()
{
  char petsc[256];
  PetscGetVersion(petsc, sizeof petsc);
  return std::string("tribogel ") + version + " (" + petsc + ")\n";
}

/// Whatever the outcome of a run and what is known of it so far, into summary.json.
using SummaryWriter = std::function<PetscErrorCode(const ErrorEstimate *estimate)>;

/// What -error_estimate asks for. The run has been recorded, so that nothing is lost when companions are
/// killed.
PetscErrorCode ReportErrors(MPI_Comm comm, const SceneInput &input, const SerialMesh &from_file, double start,
                            const Recorder &recorder, bool completed, const Progress &progress,
                            const SummaryWriter &write)
{
  ErrorEstimate estimate;
  const Scene &scene = input.scene;
  PetscFunctionBeginUser;
  if (!input.output.error_estimate) PetscFunctionReturn(0);
  if (completed)
    PetscCall(EstimateErrors(
        comm, scene, input.mesh_file.empty() ? nullptr : &from_file, recorder,
        ask_signals_and_clock(start, input.output.wall_time),
        [&progress](const Companion &companion) { progress.show(companion); }, estimate));
  else
    estimate.notes.emplace_back("the run is not complete");
  PetscCall(write(&estimate));
  progress.show(estimate, recorder);
  PetscFunctionReturn(0);
}

/// What the mesh file's groups were warned of, which may be why its gels do not meet: in brackets, or
/// nothing.
std::string perhaps_because(const SceneInput &input)
{
  const std::string file = "-mesh_file = " + input.mesh_file + ": ";
  for (const std::string &warning : input.warnings)
    if (!input.mesh_file.empty() && warning.starts_with(file))
      return " (perhaps because " + warning.substr(file.size()) + ")";
  return {};
}

/// Gels off the axis, or of a mesh file, that cannot stand on one another; what is odd about it becomes
/// warnings.
PetscErrorCode RefuseImpossibleStart(Problem &problem, SceneInput &input)
{
  std::string objection;
  std::vector<std::string> doubts;
  PetscFunctionBeginUser;
  const auto &offset = input.scene.misalignment.offset;
  const bool shifted = offset[0] != 0 || offset[1] != 0;
  if (!shifted && input.mesh_file.empty()) PetscFunctionReturn(0);
  PetscCall(problem.system.JudgeStart(problem.stepper.plates(0, 0), objection, doubts));
  const std::string option =
      shifted ? "-top_offset = " + input.given.at("-top_offset") : "-mesh_file = " + input.mesh_file;
  const std::string room = to_text(input.scene.bottom.radius - input.scene.top.radius);
  for (const std::string &doubt : doubts) input.warnings.push_back(option + ": " + doubt);
  if (!objection.empty())
    throw UserError{
        option + ": before the gels are pressed, " + objection +
        " (beyond the bottom gel's edge); allowed: a top gel whose face lies above the bottom gel's" +
        (input.scene.round ? ", here an offset of up to " + room + " mm" : "") + perhaps_because(input)};
  PetscFunctionReturn(0);
}

int status_of(const Problem &problem, bool completed)
{
  if (completed) return exit_status::completed;
  return problem.stepper.stop.is_request() ? exit_status::stopped_on_request : exit_status::cannot_go_on;
}

/// What a run is made of before it begins.
struct Prepared {
  std::string old_directory; ///< that is continued; empty: none
  StoredRun stored;
  SceneInput input;
  SerialMesh from_file; ///< for companions; without -mesh_file empty
  std::string digest;   ///< of the mesh
  Problem problem;
};

/// Options -> scene -> mesh, bulk, contact.
PetscErrorCode Prepare(MPI_Comm comm, HelpRequest help, const OptionSources &sources, Prepared &run)
{
  SerialMesh mesh;
  SceneInput &input = run.input;
  PetscFunctionBeginUser;
  PetscCall(ReadRestart(run.old_directory));
  const bool continues = !run.old_directory.empty();
  if (continues) {
    PetscCall(ReadStoredRun(comm, run.old_directory, run.stored));
    PetscCall(AdoptOptions(run.stored.options));
  }
  PetscCall(ReadScene(sources, input));
  if (help == HelpRequest::none) PetscCall(CheckOutputDirectory(comm, input.output));
  PetscCall(MakeMesh(comm, input, mesh));
  const bool from_file = !input.mesh_file.empty();
  if (from_file) run.from_file = mesh;
  run.digest = digest_of(mesh, from_file);
  if (continues) {
    expect_unchanged(input, run.stored.options);
    PetscCall(
        ExpectSameMesh(comm, run.stored, run.digest,
                       from_file ? "-mesh_file = " + input.mesh_file : "-restart = " + run.old_directory));
  }
  PetscCall(run.problem.SetUp(comm, input.scene, std::move(mesh)));
  PetscCall(run.problem.stepper.ProbeSolver());
  PetscCall(RefuseImpossibleStart(run.problem, input));
  PetscFunctionReturn(0);
}

/// Options -> scene -> mesh, bulk, contact -> TS -> observers -> files.
PetscErrorCode Run(HelpRequest help, const OptionSources &sources, int &status)
{
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const double start = MPI_Wtime();
  Prepared prepared;
  RunOutcome outcome;
  RunCost cost;
  std::string petsc_help;
  bool completed;
  PetscFunctionBeginUser;
  PetscCall(Prepare(comm, help, sources, prepared));
  SceneInput &input = prepared.input;
  Problem &problem = prepared.problem;
  PetscCall(TakePetscHelp(petsc_help));
  if (help == HelpRequest::petsc) {
    status = answer(help_text() + "\nPETSc\n" + petsc_help);
    PetscFunctionReturn(0);
  }
  PetscCall(CheckUnusedOptions(sources, petsc_help, input.warnings));
  const std::string &directory = input.output.directory;
  Recorder recorder(directory);
  Checkpoint checkpoint(recorder, input.output, text_of_options(input), prepared.digest, start);
  if (!prepared.old_directory.empty()) PetscCall(checkpoint.Restore(prepared.stored, problem));
  PetscCall(PrepareOutputDirectory(comm, input.output));
  catch_stop_signals();
  if (is_first_process()) std::fputs(scene_report(input).c_str(), stdout);

  set_error_status(exit_status::cannot_go_on);
  Progress progress(input.scene.schedule, is_first_process());
  recorder.on_row = [&progress](const HistoryRow &row) { progress.show(row); };
  recorder.on_first_failure = [&progress](const StepFailure &failure) { progress.show(failure); };
  recorder.on_notice = [&progress](const std::string &text) { progress.show("note: " + text); };
  PetscCall(problem.Run({&recorder, &checkpoint}, completed, outcome.reason));
  outcome.status = status_of(problem, completed);
  if (completed) PetscCall(recorder.Conclude(problem));
  if (outcome.status == exit_status::cannot_go_on) {
    PetscCall(checkpoint.Write(problem));
    StopWish all = problem.stepper.stop;
    all.add(checkpoint.stop);
    outcome.reason = all.reason();
  }
  PetscCall(checkpoint.Cost(comm, cost));
  const auto write = [&](const ErrorEstimate *estimate) -> PetscErrorCode {
    std::string complaint;
    PetscFunctionBeginUser;
    PetscCall(WriteSummary(comm, directory, problem, recorder, outcome, cost, resolved_options(input),
                           input.warnings, estimate, complaint));
    if (!complaint.empty())
      outcome.fail(complaint + (completed ? "; the run's other files are whole, and -restart " + directory +
                                                " writes it again"
                                          : ""));
    PetscFunctionReturn(0);
  };
  PetscCall(write(nullptr));
  progress.finish(recorder, problem.stepper.counts, outcome, cost, directory);
  PetscCall(ReportErrors(comm, input, prepared.from_file, start, recorder,
                         outcome.status == exit_status::completed, progress, write));
  status = outcome.status;
  if (output_was_lost())
    print_warning("standard output was closed or full: not all was printed that is in " + directory);
  if (status == exit_status::cannot_go_on) print_error(outcome.reason);
  PetscFunctionReturn(0);
}

int run(const std::vector<std::string> &words)
{
  const CommandLine line = read_command_line(words);
  if (line.help == HelpRequest::version) return answer(version_text());
  if (line.help == HelpRequest::table) return answer(help_text());
  if (line.help == HelpRequest::markdown) return answer(help_markdown() + columns_markdown());
  if (line.help == HelpRequest::columns) return answer(columns_text());
  const OptionSources sources = read_sources(line);
  std::vector<std::string> for_petsc = sources.words(words[0]);
  if (line.help == HelpRequest::petsc) for_petsc.emplace_back("-help");
  const PetscSession petsc(for_petsc, option_names());
  if (!petsc.started()) return error_status();
  int status = exit_status::completed;
  try {
    return Run(line.help, sources, status) == 0 ? status : error_status();
  } catch (const UserError &error) {
    throw located(error, sources);
  }
}

} // namespace

} // namespace tribogel

int main(int argc, char **argv)
{
  tribogel::occupy_standard_streams();
  MPI_Init(&argc, &argv);
  int status = tribogel::exit_status::bad_input;
  try {
    status = tribogel::run({argv, argv + argc});
  } catch (const tribogel::UserError &error) {
    tribogel::print_error(error.text);
  }
  MPI_Finalize();
  return status;
}
