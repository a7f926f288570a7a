"""Which runs of tribogel the report needs, and how they are started.

Each transient case runs three times: on the mesh that is shown, on the mesh that it is the halved edges of,
and there with a quarter of the step tolerance. Steady states of the scene of Fig. 6 run on more meshes;
selected ones in space.
"""
import concurrent.futures
import dataclasses
import json

from .. import program as starter
from ..command_line import progress
from ..program import OPTIONS, RunFailed

CASES = ("fig05", "fig06", "table2_case1", "table2_case2", "table2_case3", "fig12_ve_ve", "fig12_he_ve",
         "fig12_he_he", "fig04_four_rates", "table1_as_printed", "table1_reading_c")
APPROACH = 0.79  # mm, that of options/paper/fig06.opts
RATES = (0.01, 0.1, 1.0)  # rad/s, the paper's
TWISTS = (0.0, 0.05, 0.1, 0.2)  # rad: the torsion of Fig. 5's gel, at its approach
FIG5_APPROACH, APPROACH_STEP = 0.414, 0.01  # mm
FIT_RATES = (0.01, 0.0316, 0.1, 0.316, 1.0)  # rad/s, "measured"
FURTHER_RATE = 10.0  # rad/s, where the fitted laws are asked for what was not measured
HIDDEN_LAW = "table2_case3"  # whose T/N the fits of section 5 see
FORMS = {"b1": (1,), "b2": (2,), "b0_b1": (0, 1), "b0_b2": (0, 2), "b0_b1_b2": (0, 1, 2)}  # assumed exponents
SOLID_CASES = ("fig06", "table2_case2", "fig12_ve_ve")


@dataclasses.dataclass(frozen=True)
class Detail:
    """How fine. Transients are shown on the mesh of `elements` along the top radius with its edges halved
    once."""
    elements: int = 6
    levels: int = 3  # of halvings in the study of meshes
    tolerance: float = 0.1  # per cent, -time_tolerance
    first_step: float = 3e-5  # s, of each phase: follows the rise of T after a jump, which takes milliseconds
    solid_elements: tuple = (2, 3)  # in space, order 2; empty: no runs in space
    parameters: tuple | None = None  # whose sensitivities are sought; None: of all


FULL = Detail()
QUICK = Detail(elements=2, tolerance=1.0, first_step=0.05, solid_elements=(), parameters=("top height", "K"))


@dataclasses.dataclass(frozen=True)
class Run:
    name: str  # its directory below runs/
    files: tuple  # options files below options/
    words: tuple


def listed(values):
    return ",".join(f"{value:.12g}" for value in values)


def steady_rates(rates):
    """Steady states at these rates."""
    ends = [100 * (k + 1) for k in range(len(rates))]
    return ("-schedule_kind", "steady", "-schedule_end_times", listed(ends), "-schedule_approach",
            listed([APPROACH] * len(rates)), "-schedule_rates", listed(rates))


def mesh_words(detail, halvings):
    return ("-elements_radial", str(detail.elements), "-mesh_refinements", str(halvings))


def transients(detail):
    for case in CASES:
        for variant, halvings, tolerance in (("shown", 1, detail.tolerance), ("coarse", 0, detail.tolerance),
                                             ("coarse_short_steps", 0, detail.tolerance / 4)):
            yield Run(f"{case}/{variant}", (f"paper/{case}.opts",),
                      (*mesh_words(detail, halvings), "-time_tolerance", f"{tolerance:.12g}", "-ts_dt",
                       f"{detail.first_step:.12g}"))


def meshes(detail):
    for halvings in range(detail.levels):
        yield Run(f"meshes/{halvings}", ("paper/fig06.opts",),
                  ("-schedule_kind", "steady", *mesh_words(detail, halvings)))


def own_estimate(detail):
    """The program's own word about the errors of Fig. 6."""
    return Run("estimate", ("paper/fig06.opts",),
               (*mesh_words(detail, 1), "-time_tolerance", f"{detail.tolerance:.12g}", "-error_estimate",
                "true"))


def frictionless(detail):
    for halvings in (1, 0):
        yield Run(f"frictionless/{halvings}", ("paper/fig06.opts",),
                  ("-schedule_kind", "steady", "-friction_law", "none", *mesh_words(detail, halvings)))


def torsion(detail):
    """Fig. 5's gel, relaxed: twisted by several angles, and by one at neighbouring approaches."""
    twists = (*TWISTS, TWISTS[2], TWISTS[2])
    approach = (*[FIG5_APPROACH] * len(TWISTS), FIG5_APPROACH + APPROACH_STEP, FIG5_APPROACH - APPROACH_STEP)
    ends = [100 * (k + 1) for k in range(len(twists))]
    for halvings in (1, 0):
        yield Run(f"torsion/{halvings}", ("paper/fig05.opts",),
                  ("-schedule_kind", "steady", "-schedule_end_times", listed(ends), "-schedule_approach",
                   listed(approach), "-schedule_twists", listed(twists), *mesh_words(detail, halvings)))


def in_space(detail):
    """The steady states, order 2, uniform meshes, side walls at the plates as in the axisymmetric model;
    beside them that model on the same radii and heights."""
    for case in SOLID_CASES:
        for elements in detail.solid_elements:
            mesh = ("-element_order", "2", "-elements_radial", str(elements), "-mesh_grading", "1")
            yield Run(f"space/{case}_{elements}", (f"paper/{case}.opts",),
                      (*steady_rates(RATES), *mesh, "-model", "solid"))
            yield Run(f"space/{case}_{elements}_axisymmetric", (f"paper/{case}.opts",),
                      (*steady_rates(RATES), *mesh))


def hidden_law(detail):
    return Run("fit/hidden", (f"paper/{HIDDEN_LAW}.opts",),
               (*steady_rates((*FIT_RATES, FURTHER_RATE)), *mesh_words(detail, 1)))


def fitted_law(form, coefficients, detail):
    return Run(f"fit/{form}", ("paper/fig06.opts",),
               (*steady_rates((*FIT_RATES, FURTHER_RATE)), *mesh_words(detail, 1), "-friction_exponents",
                listed(FORMS[form]), "-friction_coefficients", listed(coefficients)))


def first_stage(detail):
    """All but the fitted laws, the dearest first so that the last ones to end are short."""
    return [*in_space(detail), own_estimate(detail), *reversed([*meshes(detail)]), *transients(detail),
            *frictionless(detail), *torsion(detail), hidden_law(detail)]


def execute(run, program, output):
    words = [*starter.options_files(OPTIONS / file for file in run.files), *run.words]
    ended = starter.run(program, words, output / "runs" / run.name, log="program.log")
    return f"{run.name}: status {ended.status}: {ended.failure}" if ended.status else ""


def execute_all(runs, program, output, jobs):
    """Runs them all, `jobs` at a time. Raises RunFailed after the last when one did not complete."""
    failures = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        pending = {pool.submit(execute, run, program, output): run for run in runs}
        for count, done in enumerate(concurrent.futures.as_completed(pending), 1):
            failure = done.result()
            failures += [failure] if failure else []
            progress(f"{count}/{len(runs)} {failure or pending[done].name}")
    if failures:
        raise RunFailed("\n".join(failures))


def cost_of(output):
    """CPU seconds and steps of all runs."""
    summaries = [json.loads(path.read_text(encoding="utf-8"))
                 for path in (output / "runs").rglob("summary.json")]
    return (len(summaries), sum(s["cost"]["cpu_s"] for s in summaries),
            sum(s["counts"]["accepted_steps"] for s in summaries))
