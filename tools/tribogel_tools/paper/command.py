"""Runs every numerical experiment of the paper and writes one report that puts each figure and table beside
its words.

  tools/reproduce-paper [--output tribogel-paper] [--jobs 2]
  tools/reproduce-paper --redraw --output tribogel-paper     from the runs that are there

Into the output directory: report.html (nothing outside it is needed to read it), report.pdf, figures/*.png,
and all runs below runs/. The axisymmetric model runs everything, three cases also run in space. Each number
comes with its errors of mesh and step. A few minutes on two cores. --quick is for tests: meshes so coarse
that numbers and verdicts mean little, nothing in space.
Status: 0, 1 when a run failed, 2 bad input.
"""
import resource
import time

from ..command_line import BadInput, Parser, progress
from ..program import RunFailed, program_of
from . import report, runs, sensitivity
from .values import Results


def parse(words):
    parser = Parser("reproduce-paper", __doc__)
    add = parser.add_argument
    parser.add_output("tribogel-paper")
    parser.add_jobs(most=2)
    parser.add_program()
    add("--quick", action="store_true", help="coarse meshes, nothing in space")
    add("--redraw", action="store_true", help="start no run")
    add("--overwrite", action="store_true", help="replace the runs of a report that is there")
    arguments = parser.parse_args(words)
    there = (arguments.output / "runs").exists()
    if there and not (arguments.overwrite or arguments.redraw):
        raise BadInput(f"{arguments.output} holds a report; --overwrite replaces it, --redraw draws it again")
    return arguments


def run_everything(arguments, detail):
    """The runs, and then those whose friction law was fitted to them."""
    program = program_of(arguments.program)
    runs.execute_all(runs.first_stage(detail), program, arguments.output, arguments.jobs)
    sensitivity.run(program, arguments.output, detail, arguments.jobs)
    results = Results(arguments.output, detail)
    fitted = [runs.fitted_law(form, b, detail) for form, b in report.fitted_coefficients(results).items()]
    runs.execute_all(fitted, program, arguments.output, arguments.jobs)


def cpu_seconds():
    return sum(usage.ru_utime + usage.ru_stime
               for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def main(words):
    arguments = parse(words)
    detail = runs.QUICK if arguments.quick else runs.FULL
    start = time.monotonic()
    try:
        if not arguments.redraw:
            run_everything(arguments, detail)
    except RunFailed as error:
        progress(f"reproduce-paper: {error}")
        return 1
    report.write(Results(arguments.output, detail))
    print(f"report: {arguments.output / 'report.html'} (and .pdf)")
    print(f"{time.monotonic() - start:.0f} s, {cpu_seconds():.0f} CPU seconds")
    return 0
