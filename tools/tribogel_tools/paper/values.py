"""Numbers of the runs with their errors of mesh and step.

A number is any function of a run. It is shown as it comes from the run on the shown mesh; its mesh error is
taken to be its difference from the same number on the mesh with edges twice as long, as if errors fell with
the edge (they do so for T and faster for N: the table of meshes shows it), its time error 4/3 of what a
quarter of the step tolerance changes there (the true error follows the tolerance,
tests/measurements/time-steps.md). In space there are two meshes, 2 and 3 elements.
"""
import dataclasses
import functools
import json
import math
import pathlib

import numpy as np

from .. import extrapolate
from ..run_data import History, surface_rows
from . import runs

THEORY = 4.0  # order of N and T that elements of order 2 allow
NEGLIGIBLE = 0.01  # a time error below this part of the mesh's is not shown


@dataclasses.dataclass(frozen=True)
class Value:
    value: float
    mesh: float = math.nan  # +- by the mesh
    time: float = math.nan  # +- by the steps; nan where there are none

    @property
    def error(self):
        return sum(e for e in (self.mesh, self.time) if math.isfinite(e))

    def decimals(self):
        """So many that the larger error shows two digits; five significant ones without an error."""
        error = max((e for e in (self.mesh, self.time) if e > 0), default=0.0)  # nan is not > 0
        if error > 0:
            return max(0, 1 - math.floor(math.log10(error * 1.0000001)))
        return max(0, 4 - math.floor(math.log10(abs(self.value)))) if self.value else 3

    def most_decimals(self):
        """Of six significant digits, which is what Newton's tolerance leaves."""
        return max(0, 5 - math.floor(math.log10(abs(self.value)))) if self.value else 12

    def text(self, unit="", scale=1.0, errors=True):
        """"290.54 +- 0.12 (mesh) +- 0.001 (time) N"; scale 1e3 prints thousandths."""
        v = Value(self.value * scale, abs(self.mesh * scale), abs(self.time * scale))
        decimals = min(v.decimals(), v.most_decimals())
        words = [f"{v.value:.{decimals}f}"]
        for error, name in ((v.mesh, "mesh"), (v.time, "time")):
            unseen = name == "time" and error < NEGLIGIBLE * v.mesh
            if errors and math.isfinite(error) and not unseen:
                words.append(f"± {short(error, decimals)} ({name})")
        return " ".join(words + ([unit] if unit else []))


def short(error, decimals):
    """An error in as many decimals as its number, or one digit if it is smaller than they show."""
    text = f"{error:.{decimals}f}"
    return text if float(text) > 0 or error == 0 else f"{error:.0e}"


class RunData:
    """One run: summary.json, and history.csv and profile.csv when they are asked for."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.summary = json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))
        self.phases = self.summary["phases"]

    @functools.cached_property
    def drawn(self):
        return History(self.directory)

    @property
    def history(self):
        return self.drawn.history

    def end(self, phase, column):
        """A number at the end of a phase, counted from 1, from the back if negative."""
        value = self.phases[phase - 1 if phase > 0 else phase][column]
        return math.nan if value is None else value

    def force(self, phase=-1):
        return self.end(phase, "normal_force_N")

    def torque(self, phase=-1):
        return self.end(phase, "torque_Nmm")

    @property
    def radius(self):
        """Rmin of the paper: the smaller cylinder's [mm]."""
        options = self.summary["options"]
        return float(options["top_radius" if options["specimens"] == "both" else "bottom_radius"])

    @property
    def law(self):
        """Coefficients and exponents of the friction law."""
        options = self.summary["options"]
        return [[float(word) for word in options[name].split(",")]
                for name in ("friction_coefficients", "friction_exponents")]

    def rates(self):
        return [phase["rate_rad_per_s"] for phase in self.phases]

    def torque_over_force(self, phase=-1):
        return self.torque(phase) / self.force(phase)

    def surface(self, name, phase):
        """Columns of profile.csv for a contact surface at a phase's end."""
        profile = self.drawn.profile
        rows = surface_rows(profile, name, phase)
        return {column: values[rows] for column, values in profile.items()}


class Results:
    """All runs of the report."""

    def __init__(self, output, detail):
        self.output, self.detail = pathlib.Path(output), detail
        self.of = functools.cache(lambda name: RunData(self.output / "runs" / name))

    def shown(self, case):
        return self.of(f"{case}/shown")

    def number(self, case, function):
        """A function of a transient run with both errors."""
        shown, coarse = self.shown(case), self.of(f"{case}/coarse")
        short_steps = self.of(f"{case}/coarse_short_steps")
        at_coarse = function(coarse)
        return Value(function(shown), abs(function(shown) - at_coarse),
                     abs(at_coarse - function(short_steps)) * 4 / 3)

    def steady(self, group, function):
        """A function of a steady run, which has no steps: frictionless, torsion."""
        value = function(self.of(f"{group}/1"))
        return Value(value, abs(value - function(self.of(f"{group}/0"))))

    def pair(self, function, first, second):
        """A function of two transient cases, such as a ratio, with both errors."""
        at = [function(self.of(f"{first}/{v}"), self.of(f"{second}/{v}"))
              for v in ("shown", "coarse", "coarse_short_steps")]
        return Value(at[0], abs(at[0] - at[1]), abs(at[1] - at[2]) * 4 / 3)

    def mesh_series(self, function):
        """The function on the meshes of the study, coarse to fine, and its extrapolated limit."""
        values = [function(self.of(f"meshes/{k}")) for k in range(self.detail.levels)]
        sizes = [0.5**k for k in range(self.detail.levels)]
        return values, extrapolate.extrapolate(sizes, values, extrapolate.believed(THEORY))

    def fits(self):
        """Form: its run."""
        return {form: self.of(f"fit/{form}") for form in runs.FORMS}


def peak(run):
    return float(np.max(run.history["normal_force_N"]))


def rise_time(run, phase, fraction=0.99):
    """Seconds after a phase's start from which on T stays within 1 - fraction of its value at the phase's
    end."""
    rows = run.drawn.rows[phase - 1]
    time, torque = run.history["time_s"][rows], run.history["torque_Nmm"][rows]
    off = np.flatnonzero(np.abs(torque / torque[-1] - 1) > 1 - fraction)
    return float(time[min(off[-1] + 1, len(time) - 1)] - time[0]) if len(off) else 0.0
