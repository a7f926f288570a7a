"""What tools/speed-against-error reads of runs, and how it compares them."""
import math

import numpy

from ..tables import read_csv

FORCE, TORQUE = "normal_force_N", "torque_Nmm"


def course_of(directory):
    """Of each phase: times, and columns N and T."""
    phases = {}
    for row in read_csv(directory / "history.csv"):
        phases.setdefault(row["phase"], []).append([float(row[name]) for name in ("time_s", FORCE, TORQUE)])
    return {phase: numpy.array(rows).T for phase, rows in phases.items()}


def interpolated(at, times, values):
    """By the cubic through the four of the given times about each one asked for: between the steps of a
    reference a line errs by half a hundredth of a per cent. Fewer given times, a lower polynomial."""
    count = min(4, len(times))
    first = numpy.clip(numpy.searchsorted(times, at) - 2, 0, len(times) - count)
    result = numpy.zeros(len(at))
    for i in range(count):
        weight = numpy.ones(len(at))
        for j in range(count):
            if j != i:
                weight *= (at - times[first + j]) / (times[first + i] - times[first + j])
        result += weight * values[first + i]
    return result


def largest_difference(course, reference, name):
    """Of a run's values from the reference's at the same times, over the largest value of the reference.
    Before a phase's first accepted step the reference is what it was at the end of the phase before, where T
    may jump: those times are left out."""
    k = 1 if name == FORCE else 2
    scale = max(abs(rows[k]).max() for rows in reference.values())
    worst = 0.0
    for phase, rows in course.items():
        exact = reference[phase]
        inside = rows[0] >= exact[0][0]
        worst = max(worst, abs(rows[k][inside]
                               - interpolated(rows[0][inside], exact[0], exact[k])).max(initial=0.0))
    return worst / scale


def error_of(row):
    """The larger of the errors of N and T at the ends; for a picture and for the front."""
    values = [float(row[f"error_{letter}_ends_per_cent"]) for letter in "NT"
              if row[f"error_{letter}_ends_per_cent"]]
    return max(values) if values else math.nan


def front(rows):
    """Rows that no other beats in both cost and error, by model, cheapest first."""
    best = []
    for model in dict.fromkeys(row["model"] for row in rows):
        least = math.inf
        for row in sorted((r for r in rows if r["model"] == model and not r["failure"]),
                          key=lambda r: float(r["cpu_s"])):
            error = error_of(row)
            if error < least:
                least = error
                best.append(row)
    return best
