"""Refines mesh and time steps of a scene, and says what the results tend to and how sure that is.

  tools/convergence OPTIONS_FILE ... [--elements 8 --ratio 2 --levels 3] [...] [-- -option value ...]
  tools/convergence options/paper/fig06.opts --family 2:30:8,16,32 --family 1:1:16,32,64 --output study
  tools/convergence options/paper/fig06.opts --output study -- -plate_contact false

A family is one element order and one grading (1: uniform) on meshes that differ in the number of elements
along the radius. If these are the coarsest times powers of two, each mesh is the one before with its edges
halved (-mesh_refinements); any other numbers are -elements_radial. Its mesh series refines the mesh at one
step tolerance, its step series the tolerance on one mesh; the limit is that of the mesh series moved by the
step series, which takes the step's error to be that of the other mesh too (--step-elements chooses it).
Meshes of one grading that are not nested are self-similar only approximately, since element counts along
heights are whole numbers; the table says how well sqrt(unknowns) follows elements_radial.

Orders, limits and uncertainties: the fit v + C h^p, with h = 1/elements for meshes, for steps the root of the
tolerance (steps follow it where the estimate is of order step^2: SDIRK2's of the error, --time-order 2, and
backward Euler's of that of a step, --time-order 1) or 1/(accepted steps). Uncertainty as in the grid
convergence index (P. J. Roache, J. Fluids Eng. 116 (1994) 405; factors as in L. Eca, M. Hoekstra, J. Comput.
Phys. 262 (2014) 104), by the rule of -error_estimate: 1.25 |finest - limit| and the scatter about the fit
where the observed order is from 0.5 to 1.2 times what theory allows (2k for elements of order k, --time-order
in time). An order outside is replaced by the nearer end; of three levels whose order is outside, or that are
not monotone, nothing is extrapolated: the finest value and 3 times the spread. Those of mesh and step add up.

Writes runs.csv, limits.csv, convergence.md, convergence.png and .pdf into the output directory, the runs
below it.
Status: 0, 2 bad input, 3 some run failed (it is reported, the rest goes on), 130 interrupted (go on with
--resume).
"""
import concurrent.futures
import hashlib
import json
import pathlib

from ..command_line import INTERRUPTED, BadInput, Parser, need_files, positive, progress
from ..program import options_files, program_of, run
from . import report
from .refinement import Case, Family, Study, read_result


def numbers(text, kind, what, lowest):
    """A list separated by commas."""
    try:
        values = tuple(kind(word) for word in text.split(","))
    except ValueError:
        raise BadInput(f"{what}: '{text}' is not a list of numbers separated by commas") from None
    if not all(lowest <= value < float("inf") for value in values):
        raise BadInput(f"{what}: '{text}': allowed: at least {lowest:g}")
    if len(set(values)) < len(values):
        raise BadInput(f"{what}: '{text}' has a value twice")
    return values


def mesh_levels(text, ratio, levels):
    """--elements: one number is refined by the ratio, several are the levels; coarse to fine."""
    given = numbers(text, int, "--elements", 1)
    if len(given) > 1:
        return tuple(sorted(given))
    refined = tuple(round(given[0] * ratio**k) for k in range(levels))
    if len(set(refined)) < levels:
        raise BadInput(f"--elements {given[0]} --ratio {ratio:g} gives a mesh twice: {refined}")
    return refined


def families_of(arguments):
    texts = [text.split(":") for text in arguments.family]
    if any(len(text) != 3 for text in texts):
        raise BadInput("--family: allowed: ORDER:GRADING:ELEMENTS, for example 2:30:8,16,32")
    texts = texts or [(order, grading, arguments.elements)
                      for order in arguments.orders.split(",") for grading in arguments.gradings.split(",")]
    families = []
    for order, grading, elements in texts:
        order = numbers(order, int, "element order", 1)[0]
        graded = numbers(grading, float, "grading", 1)[0] > 1
        if order > 2:
            raise BadInput(f"element order: {order}; allowed: 1 or 2")
        levels = mesh_levels(elements, arguments.ratio, arguments.levels)
        families.append(Family(order, grading, levels, best=order == 2 and graded))
    if len({(f.order, f.grading) for f in families}) < len(families):
        raise BadInput("the same family twice")
    return families


def parse(words):
    parser = Parser("convergence", __doc__)
    add = parser.add_argument
    add("options_files", metavar="OPTIONS_FILE", nargs="+", help="files compose, what comes later wins")
    add("--orders", default="2,1", help="element orders (default: %(default)s)")
    add("--gradings", default="30,1", help="values of -mesh_grading, 1 is uniform (default: %(default)s)")
    add("--elements", default="8",
        help="coarsest mesh, along the radius, or all levels: 8,16,32 (default: %(default)s)")
    add("--ratio", type=float, default=2, help="refinement between levels (default: %(default)s)")
    add("--levels", type=int, default=3, help="of meshes and of steps, at least 3 (default: %(default)s)")
    add("--family", action="append", default=[], metavar="ORDER:GRADING:ELEMENTS",
        help="one family with meshes of its own; repeatable, replaces --orders, --gradings and --elements")
    add("--tolerances", default="1e-3", help="coarsest step tolerance, or all levels (default: %(default)s)")
    add("--tolerance-factor", type=float, default=4, help="between levels (default: %(default)s)")
    add("--tolerance-option", default="ts_atol", help="the program's option for it (default: %(default)s)")
    add("--mesh-tolerance",
        help="the tolerance of the mesh series, one of the levels (default: the coarsest)")
    add("--step-elements", type=int,
        help="the mesh of the step series, one of the levels (default: the coarsest)")
    add("--step-size", choices=("tolerance", "steps"), default="tolerance",
        help="h of the step series: root of the tolerance, or 1/(accepted steps) (default: %(default)s)")
    add("--time-order", type=positive, default=2,
        help="order of the program's time rule (default: %(default)s)")
    add("--targets", default="1e-4,1e-3",
        help="relative uncertainties to reach: order 2 graded, the others (default: %(default)s)")
    parser.add_jobs()
    parser.add_program()
    parser.add_output("tribogel-convergence")
    add("--resume", action="store_true",
        help="keep runs there that completed with the same program and options")
    add("--overwrite", action="store_true", help="replace the runs of a study that is there")
    return parser.parse(words)


def settle(arguments):
    """Checks what was asked for and completes it."""
    a = arguments
    if a.levels < 3:
        raise BadInput(f"--levels {a.levels}; allowed: at least 3")
    for name, value in (("--ratio", a.ratio), ("--tolerance-factor", a.tolerance_factor)):
        if not 1 < value < 1e6:
            raise BadInput(f"{name} {value:g}; allowed: more than 1")
    given = sorted(numbers(a.tolerances, float, "--tolerances", 1e-300), reverse=True)
    given = given if len(given) > 1 else [given[0] / a.tolerance_factor**k for k in range(a.levels)]
    a.tolerances = [f"{t:.12g}" for t in given]
    wanted = a.tolerances[0]
    if a.mesh_tolerance:
        wanted = f"{numbers(a.mesh_tolerance, float, '--mesh-tolerance', 0)[0]:.12g}"
    if wanted not in a.tolerances:
        raise BadInput(f"--mesh-tolerance {wanted}; allowed: {', '.join(a.tolerances)}")
    a.mesh_tolerance = wanted
    a.tolerance_option = a.tolerance_option.lstrip("-")
    a.targets = numbers(a.targets + ("" if "," in a.targets else ",1e-3"), float, "--targets", 0)
    a.families = families_of(a)
    a.step_elements = {f: a.step_elements or f.elements[0] for f in a.families}
    for family, elements in a.step_elements.items():
        if elements not in family.elements:
            raise BadInput(f"--step-elements {elements} is no mesh of {family.label()}")
    own = {"-element_order", "-mesh_grading", "-elements_radial", "-mesh_refinements", "-output_directory",
           "-overwrite", f"-{a.tolerance_option}"}
    for word in a.further:
        if word in own:
            raise BadInput(f"{word} is set by the study itself")
    need_files(a.options_files)
    if (a.output / "runs").exists() and not (a.resume or a.overwrite):
        raise BadInput(f"{a.output} holds a study; --resume continues it, --overwrite replaces it")
    return a


def cases_of(arguments):
    """Every run once, the dearest first so that the last ones to end are short."""
    cases = {Case(f, n, arguments.mesh_tolerance): None for f in arguments.families for n in f.elements}
    cases |= {Case(f, arguments.step_elements[f], t): None for f in arguments.families
              for t in arguments.tolerances}
    return sorted(cases, key=lambda c: -((c.family.order * c.elements) ** 2 / float(c.tolerance) ** 0.5))


def execute(case, arguments, program, identity):
    """One run, or what it left before."""
    directory = arguments.output / "runs" / case.name()
    options = [*options_files(arguments.options_files), *arguments.further,
               *case.options(arguments.tolerance_option)]
    record = directory / "study.json"
    wanted = json.dumps({"identity": identity, "options": options}, indent=1)
    if arguments.resume and record.is_file() and record.read_text(encoding="utf-8") == wanted:
        return read_result(case, directory), "kept"
    record.unlink(missing_ok=True)
    ended = run(program, options, directory, log="program.log")
    if ended.status:
        return read_result(case, directory, f"status {ended.status}: {ended.failure}"), "FAILED"
    result = read_result(case, directory)
    record.write_text(wanted, encoding="utf-8")  # last: it says that the run is whole
    return result, "done"


def run_all(arguments):
    program = program_of(arguments.program)
    digest = [hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
              for path in [program, *arguments.options_files]]
    cases = cases_of(arguments)
    results = []
    pool = concurrent.futures.ThreadPoolExecutor(arguments.jobs)
    try:
        pending = [pool.submit(execute, case, arguments, program, digest) for case in cases]
        for count, done in enumerate(concurrent.futures.as_completed(pending), 1):
            result, how = done.result()
            results.append(result)
            cost = f"{result.counts['cpu_s']:.1f} CPU s" if result.counts else ""
            progress(*filter(None, (f"{count}/{len(cases)}", how, result.case.name(), cost, result.failure)))
    finally:
        pool.shutdown(cancel_futures=True)
    return sorted(results, key=lambda r: (arguments.families.index(r.case.family), r.case.elements,
                                          -float(r.case.tolerance)))


def main(words):
    arguments = settle(parse(words))
    try:
        results = run_all(arguments)
    except KeyboardInterrupt:
        progress("convergence: interrupted; --resume goes on")
        return INTERRUPTED
    report.write(Study(arguments.families, results, arguments), arguments.output)
    return 3 if any(result.failure for result in results) else 0
