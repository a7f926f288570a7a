"""What a refinement study runs and what it reads from the runs, for tools/convergence: cases, results,
families, limits."""
import dataclasses
import functools
import json
import math
import pathlib

import numpy as np

from .. import extrapolate
from ..command_line import BadInput
from ..run_data import History
from ..tables import read_csv

QUANTITIES = {  # short name: column. Displacements are positive downwards, as in summary.json
    "N": "normal_force_N",
    "T": "torque_Nmm",
    "radius": "contact_radius_mm",
    "top_centre": "top_surface_centre_displacement_mm",  # of the top gel's lower face, at the axis
    "top_rim": "top_surface_rim_displacement_mm",  # of the same at its edge
    "bottom_centre": "bottom_surface_centre_displacement_mm",  # Fig. 8 of the paper: at the axis
    "bottom_rim": "bottom_surface_rim_displacement_mm",  # Fig. 8: at the contact radius
}
FROM_PROFILE = ("top_centre", "top_rim")  # the others are in summary.json
CURVES = {name: QUANTITIES[name] for name in ("N", "T")}  # in history.csv too
COUNTS = {"unknowns": ("counts", "unknowns"), "steps": ("counts", "accepted_steps"),
          "rejected": ("counts", "rejected_steps"), "newton": ("counts", "newton_iterations"),
          "cpu_s": ("cost", "cpu_s"), "peak_MB": ("cost", "peak_memory_MB")}


@dataclasses.dataclass(frozen=True)
class Family:
    """Meshes that differ in elements_radial only. Texts stay as they were given, for the program."""
    order: int
    grading: str
    elements: tuple
    best: bool = False  # order 2 graded: the tighter target

    def label(self):
        return f"order {self.order} " + ("uniform" if float(self.grading) == 1 else f"grading {self.grading}")

    def nested(self):
        """Are all meshes the coarsest one, halved? Then they differ in nothing else, not even in whole
        numbers."""
        return len(self.elements) > 1 and all(self.halvings(n) is not None for n in self.elements)

    def halvings(self, elements):
        """How often the coarsest mesh is halved to give this one; None if it is not."""
        ratio = elements // self.elements[0]
        halved = ratio & (ratio - 1) == 0 and ratio * self.elements[0] == elements
        return ratio.bit_length() - 1 if halved else None


@dataclasses.dataclass(frozen=True)
class Case:
    family: Family
    elements: int
    tolerance: str

    def name(self):
        family = self.family
        return f"order{family.order}_grading{family.grading}_n{self.elements}_tolerance{self.tolerance}"

    def options(self, tolerance_option):
        halvings = self.family.halvings(self.elements) if self.family.nested() else 0
        return ["-element_order", str(self.family.order), "-mesh_grading", self.family.grading,
                "-elements_radial", str(self.elements >> halvings), "-mesh_refinements", str(halvings),
                f"-{tolerance_option}", self.tolerance]


@dataclasses.dataclass
class Result:
    case: Case
    directory: pathlib.Path
    failure: str = ""  # the program's own line; empty when it completed
    counts: dict = dataclasses.field(default_factory=dict)
    times: dict = dataclasses.field(default_factory=dict)  # of phase ends
    phases: dict = dataclasses.field(default_factory=dict)  # phase: {quantity: value}

    @functools.cached_property
    def run(self):
        return History(self.directory)

    def value(self, phase, quantity):
        return self.phases.get(phase, {}).get(quantity, math.nan)


def finite(value):
    return float(value) if value is not None else math.nan


def read_result(case, directory, failure=""):
    """What a run left: all of it for one that completed, what there is for one that failed."""
    result = Result(case, pathlib.Path(directory), failure)
    path = result.directory / "summary.json"
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
        result.counts = {name: summary[a][b] for name, (a, b) in COUNTS.items()}
        for end in summary["phases"]:
            result.times[end["phase"]] = end["time_s"]
            result.phases[end["phase"]] = {name: finite(end[column]) for name, column in QUANTITIES.items()
                                           if name not in FROM_PROFILE}
        for phase, values in read_top_face(result.directory / "profile.csv").items():
            result.phases[phase].update(values)
    except (OSError, ValueError, KeyError, TypeError) as error:
        if not failure:
            what = f"{type(error).__name__} {error}"
            raise BadInput(f"cannot read the results in {result.directory}: {what}") from None
    return result


def read_top_face(path):
    """Displacements of the top gel's lower face at its centre and rim by phase, from profile.csv. The rim is
    the first of the nodes farthest out; the wall's come after it."""
    ends = {}
    for row in read_csv(path):
        if row["surface"] == "top":
            point = (float(row["reference_r_mm"]), float(row["reference_z_mm"]) - float(row["z_mm"]))
            ends.setdefault(int(row["phase"]), []).append(point)
    return {
        phase: dict(zip(FROM_PROFILE,
                        (choose(points, key=lambda point: point[0])[1] for choose in (min, max))))
        for phase, points in ends.items()
    }


class Study:
    """Families of results and their limits."""

    def __init__(self, families, results, settings):
        """settings: tolerances (texts), mesh_tolerance (the one of the mesh series), step_elements (family ->
        the mesh of the step series), step_size ("tolerance" or "steps"), time_order, targets (order 2 graded,
        others)."""
        self.families, self.results, self.settings = families, results, settings
        self.by_case = {result.case: result for result in results}
        done = self.completed()
        self.phases = sorted({phase for result in done for phase in result.phases})
        self.scale = {name: max((abs(v) for r in done for p in self.phases
                                 if math.isfinite(v := r.value(p, name))),
                                default=0.0) for name in QUANTITIES}
        self.mesh, self.steps, self.limits = {}, {}, {}
        for family in families:
            for phase in self.phases:
                for name in QUANTITIES:
                    self.set_limits(family, phase, name)

    def completed(self):
        return [result for result in self.results if not result.failure]

    def target(self, family):
        return self.settings.targets[0 if family.best else 1]

    def reaches_target(self, family, limit):
        return limit.relative() <= self.target(family)

    def series(self, family, phase=None, name=None, steps=False):
        """Completed runs of a family in which only the mesh (or the step) differs and that know the
        quantity."""
        s = self.settings
        cases = ([Case(family, s.step_elements[family], t) for t in s.tolerances] if steps
                 else [Case(family, n, s.mesh_tolerance) for n in family.elements])
        return [r for r in (self.by_case.get(case) for case in cases)
                if r and not r.failure and (name is None or math.isfinite(r.value(phase, name)))]

    def step_size(self, result):
        """Backward Euler's error in a step is of order step^2, so that steps follow the root of the
        tolerance."""
        if self.settings.step_size == "steps":
            return 1 / result.counts["steps"]
        return float(result.case.tolerance) ** (1 / (self.settings.time_order + 1))

    def set_limits(self, family, phase, name):
        meshes, steps = self.series(family, phase, name), self.series(family, phase, name, steps=True)
        values = [r.value(phase, name) for r in meshes]
        if not meshes or max(map(abs, values)) <= 1e-10 * self.scale[name]:
            return  # never there, or zero but for round-off
        key = (family, phase, name)
        self.mesh[key] = extrapolate.extrapolate([1 / r.case.elements for r in meshes], values,
                                                 extrapolate.believed(2 * family.order), self.scale[name])
        shared = [r.value(phase, name) for r in steps if r.case.tolerance == self.settings.mesh_tolerance]
        if shared:
            self.steps[key] = extrapolate.extrapolate([self.step_size(r) for r in steps],
                                                      [r.value(phase, name) for r in steps],
                                                      extrapolate.believed(self.settings.time_order),
                                                      self.scale[name])
            self.limits[key] = extrapolate.combine(self.mesh[key], self.steps[key], shared[0])

    def of_families(self, phase, name):
        """Limits by family; the runs of those that have none all failed."""
        return {f: self.limits[f, phase, name] for f in self.families if (f, phase, name) in self.limits}

    def error(self, result, name):
        """Largest error at a phase's end, relative to the limit that is known best of all families, and what
        that limit may be off by there."""
        worst = (math.nan, math.nan)
        for phase in self.phases:
            limit = extrapolate.best(self.of_families(phase, name).values())
            value = result.value(phase, name)
            if limit and limit.value and math.isfinite(value):
                error = abs(value - limit.value) / abs(limit.value)
                if not error <= worst[0]:
                    worst = (error, limit.relative())
        return worst

    def series_error(self, family, result, name, steps):
        """Largest error at a phase's end from the mesh (the step) alone: against the limit of its series."""
        limits = self.steps if steps else self.mesh
        errors = [abs(result.value(p, name) - limits[family, p, name].value)
                  / abs(limits[family, p, name].value)
                  for p in self.phases if (family, p, name) in limits and limits[family, p, name].value]
        return max(errors, default=math.nan)

    def curves(self, family, name, steps):
        """For each but the finest run of a series: {phase: (largest |difference| to the finest run over the
        phase, what interpolating that may add)}, both relative to the curve's largest value in the phase."""
        runs = self.series(family, steps=steps)
        if len(runs) < 2:
            return []
        finest = runs[-1].run
        rows = []
        for result in runs[:-1]:
            found = {}
            for index, phase in enumerate(finest.phases):
                fine, own = finest.rows[index], result.run.rows[index]
                reference, column = finest.history, CURVES[name]
                size = np.max(np.abs(reference[column][fine]))
                if size > 1e-10 * self.scale[name]:
                    difference = extrapolate.curve_difference(
                        result.run.history["time_s"][own], result.run.history[column][own],
                        reference["time_s"][fine], reference[column][fine])
                    found[phase] = tuple(d / size for d in difference)
            rows.append((result, found))
        return rows
