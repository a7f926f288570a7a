"""Sensitivities of N and T to the parameters of a scene, for tools/sensitivity and other tools:

    study = Study(program, options_files, further_options, output_directory)
    study.run()                      # runs the program many times
    study.write()                    # sensitivity.csv, sensitivity.md
    study.rows, study.markdown()

A parameter p is moved to p (1 + s) and p (1 - s) for two sizes of s; the relative sensitivity (dv/v)/(dp/p),
in per cent per per cent, is the central difference over s, extrapolated from both sizes (error of order s^2),
and its error is what the two differ by. Lengths, which move the mesh, are moved less than the others, so that
no number of edges changes: where the number of unknowns does, both sizes are halved, twice at most.
Coefficients of friction that are 0 have no relative change: see `Term`.
"""
import concurrent.futures
import dataclasses
import math
import pathlib
import re

from ..command_line import BadInput
from ..program import options_files, run
from ..tables import markdown, write_csv
from .parameters import Scaled, SceneOptions, Term, parameters_of

QUANTITIES = {"N": "normal_force_N", "T": "torque_Nmm"}
NEWTON = 1e-7  # relative: below that differences of two runs mean nothing
NOTHING = 1e-9  # a torque below this part of the largest N R is none
HALVINGS = 2  # of the step, to keep the mesh


@dataclasses.dataclass
class Row:
    parameter: str
    meaning: str
    unit: str
    phase: int
    time_s: float
    rate_rad_per_s: float
    quantity: str
    sensitivity: float  # extrapolated from both steps
    error: float  # difference of the two
    absolute: float  # of a term of friction: N or N mm per unit of mu at the mean speed of the phase
    coarse_step: float
    fine_step: float
    mesh_kept: bool  # all runs have the same number of unknowns


def differences(step, values, central):
    """Derivative at 0 from values at +-step and +-step/2, or at 0, step/2 and step, and its error. `values`
    maps multiples of the step to numbers."""
    if central:
        coarse, fine = (values[1] - values[-1]) / (2 * step), (values[0.5] - values[-0.5]) / step
        return fine + (fine - coarse) / 3, abs(fine - coarse)
    coarse, fine = (values[1] - values[0]) / step, (values[0.5] - values[0]) / (step / 2)
    return 2 * fine - coarse, abs(fine - coarse)


class Study:
    """All runs of one scene, and what follows from them."""

    def __init__(self, program, files, further, output, step=0.04, length_step=0.004, jobs=1, only=None,
                 said=print):
        self.program, self.words, self.output = program, [*options_files(files),
                                                          *further], pathlib.Path(output)
        self.step, self.length_step, self.jobs, self.only, self.said = step, length_step, jobs, only, said
        self.rows, self.failures, self.cpu_seconds, self.runs = [], [], 0.0, 0

    def solve(self, name, words):
        """The summary, or none and why."""
        directory = self.output / "runs" / re.sub(r"[^A-Za-z0-9.+-]+", "_", name)
        ended = run(self.program, [*self.words, *words], directory)
        return (None, ended.failure) if ended.status else (ended.summary(), "")

    def run(self):
        base, failure = self.solve("base", [])
        if not base:
            raise BadInput(failure)
        scene = SceneOptions(base)
        parameters = parameters_of(scene)
        if self.only:
            unknown = set(self.only) - {p.name for p in parameters}
            if unknown:
                raise BadInput(f"no parameter {', '.join(sorted(unknown))}; allowed: "
                               + ", ".join(p.name for p in parameters))
            parameters = [p for p in parameters if p.name in self.only]
        self.cpu_seconds, self.runs, self.base = base["cost"]["cpu_s"], 1, base
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            for number, rows in enumerate(pool.map(lambda p: self.vary(p, scene, base), parameters), 1):
                self.rows += rows
                if rows:
                    said = ", ".join(f"{row.quantity} {row.sensitivity:+.4f}" for row in rows
                                     if row.phase == len(scene.phases))
                    self.said(f"{number}/{len(parameters)} {rows[0].parameter}: at the end {said}")
        for line in self.failures:
            self.said(line)

    def moved(self, parameter, scene, change, known):
        """The summary of a run with the parameter changed; each change is run once."""
        if change not in known:
            summary, failure = self.solve(f"{parameter.name} {100 * change:+g} %",
                                          parameter.moved(scene, change))
            if not summary:
                raise BadInput(failure)
            known[change] = summary
            self.cpu_seconds += summary["cost"]["cpu_s"]
            self.runs += 1
        return known[change]

    def vary(self, parameter, scene, base):
        multiples = (1, -1, 0.5, -0.5) if parameter.central else (1, 0.5)
        known = {0.0: base}
        try:
            for halvings in range(HALVINGS + 1):
                step = (self.length_step if parameter.length else self.step) / 2**halvings
                found = {k: self.moved(parameter, scene, k * step, known) for k in (0, *multiples)}
                kept = len({summary["counts"]["unknowns"] for summary in found.values()}) == 1
                if kept:
                    break
        except BadInput as failure:
            self.failures.append(f"{parameter.name}: no number: {failure}")
            return []
        return [self.row(parameter, scene, found, step, kept, phase, quantity)
                for quantity in QUANTITIES for phase in range(len(scene.phases))]

    def row(self, parameter, scene, found, step, kept, phase, quantity):
        at, column = scene.phases[phase], QUANTITIES[quantity]
        values = {k: summary["phases"][phase][column] for k, summary in found.items()}
        radius = float(scene.options["top_radius" if scene.both else "bottom_radius"])
        force = max(abs(p["normal_force_N"]) for p in scene.phases)
        rate, size = at["rate_rad_per_s"], abs(values[0])
        weight = parameter.weight(scene, rate)
        sensitivity = error = absolute = math.nan
        if size > NOTHING * force * (radius if quantity == "T" else 1) and weight == weight:
            sensitivity, error = differences(step, values, parameter.central)
            sensitivity /= values[0] * weight
            error = (error / size + NEWTON / step) / abs(weight)
            if isinstance(parameter, Term):
                absolute = sensitivity * values[0] / scene.friction(scene.mean_speed(rate))
        return Row(parameter.name, parameter.meaning, parameter.unit, phase + 1, at["time_s"], rate,
                   quantity, sensitivity, error, absolute, step, step / 2, kept)

    def write(self):
        write_csv(self.output / "sensitivity.csv", [field.name for field in dataclasses.fields(Row)],
                  map(dataclasses.astuple, self.rows))
        (self.output / "sensitivity.md").write_text(self.markdown(), encoding="utf-8")

    def columns(self):
        """(quantity, first phase, last phase): neighbours that do not differ by more than their errors are
        one."""
        table = {}
        for row in self.rows:
            table.setdefault((row.quantity, row.phase), []).append(row)
        columns = []
        for (quantity, phase), rows in sorted(table.items()):
            if all(math.isnan(row.sensitivity) for row in rows):
                continue
            known = columns and columns[-1][0] == quantity
            if known and all(map(alike, table[quantity, columns[-1][2]], rows)):
                columns[-1][2] = phase
            else:
                columns.append([quantity, phase, phase])
        return columns

    def markdown(self):
        columns = self.columns()
        by_place = {(row.parameter, row.quantity, row.phase): row for row in self.rows}
        names = list({row.parameter: row for row in self.rows})
        heads = [f"{q}, phase {a}" if a == b else f"{q}, phases {a} to {b}" for q, a, b in columns]
        table, notes = [], []
        for name in names:
            rows = [by_place[name, quantity, last] for quantity, _, last in columns]
            table.append([f"{name}: {rows[0].meaning}", *(shown(r.sensitivity, r.error) for r in rows)])
            if not rows[0].mesh_kept:
                notes.append(f"{name}: the number of elements changes with it.")
            if rows[0].unit != Scaled.unit:
                notes.append(f"{name}: {rows[-1].unit}; T by {rows[-1].absolute:.4g} N mm per unit of mu "
                             "there.")
        lines = [markdown(["parameter", *heads], table), "",
                 "Per cent per per cent, at the phases' ends; in brackets the error of the last digits, from "
                 f"changes of the parameter by two sizes, +-{100 * self.step:g} % and half of that (lengths: "
                 f"{100 * self.length_step:g} %).",
                 *notes, *self.failures, f"{self.runs} runs, {self.cpu_seconds:.0f} CPU s."]
        return "\n".join(lines) + "\n"


def alike(a, b):
    """Two numbers agree within their errors and what is shown, or one is missing."""
    return not abs(a.sensitivity - b.sensitivity) > a.error + b.error + 2e-4


def shown(value, error):
    """Value with the error in units of its last digit, in brackets: 2.713(4)."""
    if value != value:
        return "-"
    digits = min(4, max(0, -math.floor(math.log10(max(error, 1e-4)))))
    value = round(value, digits) + 0.0  # no -0
    return f"{value:.{digits}f}({max(1, math.ceil(error * 10**digits - 1e-9)):d})"
