"""What each part of a run costs over dofs and over processes, beside the memory bandwidth of this machine;
exponents; a model.

  tools/scaling [OPTIONS_FILE ...] [--elements 4,6,8] [--ranks 1,2] [--weak 1:6,2:8] [--repeats 1]
                [-- -option value ...]

The scene is that of the OPTIONS_FILEs (default: the paper's rheometer in space, options/paper/fig06.opts and
options/solid/steady.opts) and of the options behind --. Every number of --elements (-elements_radial) is run
on every number of --ranks (mpirun -n): strong scaling. --weak RANKS:ELEMENTS,... are runs with about the same
number of dofs a process; their efficiency is the first one's cost per dof over theirs, so the numbers need
not be equal. One run after the other; of --repeats the one with the least CPU time counts.

Times are wall seconds of the slowest process per Newton iteration, from PETSc's log: other work on the
machine is in them. Efficiency: processes x time, of the fewest over of these. Beside it STREAM's triad, run
now, on one core and on as many at once as there are processes: what waits for memory cannot be more efficient
than that, unless it fits better into the caches (--no-triad leaves it out; it needs Google Benchmark, which
tools/benchmark installs).

The exponents are those of y = c dofs^a on the fewest processes, by least squares, with their standard error
from three meshes on. The model extrapolates them to --model-dofs and --model-ranks with a network's --latency
and --bandwidth: no more than that. Messages are those that PETSc sends itself, not those inside MUMPS or
hypre.

Writes scaling.csv (a line per run and event), scaling.md, .png and .pdf below --output.
Status: 0, 1 when a run did not complete (the others are reported), 2 bad input.
"""
import argparse
import pathlib

from ..command_line import BadInput, Parser, need_files, positive, positives, progress
from ..program import OPTIONS, options_files, program_of
from .cost_model import Machine
from .logged_run import LoggedRun, best_of
from .scaling_report import draw, report, write_events
from .triad import triad_rates


class Study:
    """Runs by (ranks, elements), the cheapest of those repeated."""

    def __init__(self, a, program):
        self.a, self.program, self.runs, self.failures = a, program, {}, []

    def run(self, ranks, elements):
        if (ranks, elements) in self.runs or (ranks, elements) in [key for key, _ in self.failures]:
            return
        words = [*options_files(self.a.options_files), *self.a.further, "-elements_radial", elements]
        directory = self.a.output / "runs" / f"{elements}-{ranks}"
        best = best_of(self.a.repeats, lambda: LoggedRun(self.program, words, directory, ranks, self.a.mpirun,
                                                         self.a.time_limit))
        if best.failure or not best.newton_seconds:
            self.failures.append(((ranks, elements), best.failure or "no log"))
        else:
            self.runs[ranks, elements] = best
        progress(f"{elements} elements, {ranks} ranks: {best.counts.get('unknowns', '')} dofs, "
                 f"{best.cpu:.1f} CPU s",
                 best.failure)


def pairs(text):
    found = [tuple(positives(word.replace(":", ","))) for word in text.split(",")]
    if any(len(pair) != 2 for pair in found):
        raise argparse.ArgumentTypeError(f"{text}; allowed: RANKS:ELEMENTS,RANKS:ELEMENTS,...")
    return found


def parse(words):
    parser = Parser("scaling", __doc__)
    add = parser.add_argument
    add("options_files", nargs="*", type=pathlib.Path, metavar="OPTIONS_FILE")
    add("--elements", type=positives, default=[4, 6, 8], help="-elements_radial (default: 4,6,8)")
    add("--ranks", type=positives, default=[1, 2], help="default: 1,2")
    add("--weak", type=pairs, default=[], metavar="RANKS:ELEMENTS,...")
    add("--repeats", type=positive, default=1)
    add("--time-limit", type=float, help="wall seconds of one run")
    add("--no-triad", action="store_true")
    add("--triad", metavar="PROGRAM", help="kernel_benchmarks (default: built in build-native)")
    add("--latency", type=float, default=2e-6, help="seconds a message, of the model (default: %(default)s)")
    add("--bandwidth", type=float, default=1e9,
        help="bytes a second of one process, of the model (default: %(default)s)")
    add("--neighbours", type=int, default=12,
        help="processes that one exchanges with, of the model (default: %(default)s)")
    add("--model-dofs", type=positives, default=[100_000, 1_000_000, 10_000_000],
        help="default: 1e5, 1e6, 1e7")
    add("--model-ranks", type=positives, default=[1, 2, 16, 128, 1024], help="default: 1,2,16,128,1024")
    add("--mpirun", default="mpirun")
    parser.add_program()
    parser.add_output("tribogel-scaling")
    a = parser.parse(words)
    a.options_files = a.options_files or [OPTIONS / "paper" / "fig06.opts", OPTIONS / "solid" / "steady.opts"]
    a.output = a.output.resolve()
    need_files(a.options_files)
    if min(a.neighbours, a.bandwidth) <= 0 or a.latency < 0:
        raise BadInput("--neighbours, --bandwidth; allowed: above 0; --latency: not negative")
    a.ranks = sorted(set(a.ranks))
    return a


def main(words):
    a = parse(words)
    program = program_of(a.program)
    a.output.mkdir(parents=True, exist_ok=True)
    most = {*a.ranks, *(ranks for ranks, _ in a.weak)}
    triad = {} if a.no_triad else triad_rates(sorted(most), a.triad)
    study = Study(a, program)
    for ranks, elements in [(ranks, elements) for elements in sorted(a.elements)
                            for ranks in a.ranks] + a.weak:
        study.run(ranks, elements)
    for (ranks, elements), failure in study.failures:
        progress(f"scaling: {elements} elements on {ranks} ranks: {failure}")
    if study.runs:
        write_events(a.output / "scaling.csv", study.runs)
        machine = Machine(a.latency, a.bandwidth, a.neighbours)
        text = report(study.runs, a.weak, triad, machine, a.model_dofs, a.model_ranks)
        (a.output / "scaling.md").write_text(text, encoding="utf-8")
        print(text)
        draw(a.output / "scaling", study.runs, triad)
    return int(bool(study.failures))
