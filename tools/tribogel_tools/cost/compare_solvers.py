"""One scene with every linear solver: iterations, times, memory, N and T, and how each fails.

  tools/compare-solvers [OPTIONS_FILE ...] [--solvers FILE ...] [--ranks 1,2] [--repeats 1] [--time-limit 600]
                        [-- -option value ...]

The scene is that of the OPTIONS_FILEs (default: the paper's, options/paper/fig06.opts) and of the options
behind --. Every run is made once for each file of --solvers (default: options/solver/*.opts), which comes
last, and each number of ranks, one after the other. A solver that is refused, stops or takes longer than
--time-limit is a row that says so. To shorten a scene give it fewer phases: -- -schedule_end_times ...

Of --repeats runs the one with the least CPU time counts. set-up and solve are PETSc's PCSetUp and KSPSolve,
wall seconds of the slowest rank (symbolic and numeric factorisation are within the set-up, applications of
the preconditioner within the solve); rest: the part of Newton's iterations that is neither; CPU: the whole
process, all ranks. The differences of N and T are the largest at any phase end that both runs reached, over
the largest |N| or |T| there, from the run with --reference (default mumps) on the first number of ranks.

Writes compare-solvers.csv and .md below --output.
Status: 0, 1 when a run did not complete, 2 bad input.
"""
import pathlib

from ..command_line import Parser, need_files, positive, positives, progress
from ..program import OPTIONS, options_files, program_of
from ..tables import markdown, write_csv
from .logged_run import LoggedRun, best_of
from .speed import FORCE, TORQUE

COLUMNS = ("solver", "ranks", "unknowns", "steps", "cut_steps", "newton", "linear", "linear_per_newton",
           "setup_s", "solve_s", "symbolic_s", "numeric_s", "apply_s", "rest_per_cent", "cpu_s", "wall_s",
           "memory_MB", "N_N", "T_Nmm", "N_difference_per_cent", "T_difference_per_cent", "status", "failure")


def difference(phases, reference, name):
    """Per cent; empty when there is no phase end in both."""
    common = [key for key in phases if key in reference]
    scale = max((abs(reference[key][name]) for key in common), default=0)
    if not scale:
        return ""
    return f"{100 * max(abs(phases[key][name] - reference[key][name]) for key in common) / scale:.2e}"


def row_of(solver, run, reference):
    row = dict.fromkeys(COLUMNS, "") | {"solver": solver, "ranks": run.ranks, "status": run.status,
                                        "failure": run.failure, "cpu_s": f"{run.cpu:.2f}"}
    if run.newton_seconds:
        row |= {key: f"{run.seconds(name):.3f}" for key, name in (
            ("setup_s", "PCSetUp"), ("solve_s", "KSPSolve"), ("symbolic_s", "MatLUFactorSym"),
            ("numeric_s", "MatLUFactorNum"), ("apply_s", "PCApply"), ("wall_s", "summary"))}
        row["rest_per_cent"] = f"{100 * run.rest_of_newton:.0f}"
    if run.counts:
        newton, linear = run.counts["newton_iterations"], run.counts["linear_iterations"]
        row |= {"unknowns": run.counts["unknowns"], "steps": run.counts["accepted_steps"], "newton": newton,
                "linear": linear, "cut_steps": run.counts["rejected_steps"] + run.counts["failed_solves"],
                "linear_per_newton": f"{linear / newton:.1f}" if newton else "",
                "memory_MB": f"{run.cost['peak_memory_MB']:.0f}"}
    if run.phases:
        last = run.phases[max(run.phases)]
        row |= {"N_N": f"{last[FORCE]:.6g}", "T_Nmm": f"{last[TORQUE]:.6g}",
                "N_difference_per_cent": difference(run.phases, reference, FORCE),
                "T_difference_per_cent": difference(run.phases, reference, TORQUE)}
    return row


def study(a, program):
    words = options_files(a.options_files) + a.further
    runs = []
    for ranks in a.ranks:
        for path in a.solvers:
            directory = a.output / "runs" / f"{path.stem}-{ranks}"

            def start(path=path, ranks=ranks, directory=directory):
                return LoggedRun(program, [*words, "-options_file", path], directory, ranks, a.mpirun,
                                 a.time_limit)
            run = best_of(a.repeats, start)
            runs.append((path.stem, run))
            progress(path.stem, ranks, f"{run.cpu:.2f} CPU s", run.failure)
    reference = next((run.phases for stem, run in runs if stem == a.reference and run.phases), {})
    return [row_of(stem, run, reference) for stem, run in runs]


def parse(words):
    parser = Parser("compare-solvers", __doc__)
    add = parser.add_argument
    add("options_files", nargs="*", type=pathlib.Path, metavar="OPTIONS_FILE")
    add("--solvers", nargs="+", type=pathlib.Path, metavar="FILE",
        default=sorted((OPTIONS / "solver").glob("*.opts")))
    add("--ranks", type=positives, default=[1], help="numbers of processes, such as 1,2 (default: 1)")
    add("--repeats", type=positive, default=1)
    add("--time-limit", type=float, default=600, help="wall seconds of one run (default: %(default)s)")
    add("--reference", default="mumps", help="solver that N and T are compared with (default: %(default)s)")
    add("--mpirun", default="mpirun")
    parser.add_program()
    parser.add_output("tribogel-solvers")
    a = parser.parse(words)
    a.options_files = a.options_files or [OPTIONS / "paper" / "fig06.opts"]
    a.output = a.output.resolve()
    need_files([*a.options_files, *a.solvers])
    return a


def main(words):
    a = parse(words)
    program = program_of(a.program)
    a.output.mkdir(parents=True, exist_ok=True)
    rows = study(a, program)
    write_csv(a.output / "compare-solvers.csv", COLUMNS, [[row[name] for name in COLUMNS] for row in rows])
    text = markdown([name.replace("_per_cent", " %").replace("_", " ") for name in COLUMNS],
                    [row.values() for row in rows])
    (a.output / "compare-solvers.md").write_text(text + "\n", encoding="utf-8")
    print(text)
    return int(any(row["status"] for row in rows))
