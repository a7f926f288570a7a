"""Limits and uncertainties of refinement series. Numbers only: no files, no runs.

A series is a value at several sizes h (mesh or time step). The rule is that of the program's -error_estimate,
include/tribogel/math/extrapolation.hpp, which says where it is from; tests/extrapolation_cases.txt holds both
to the same numbers. The fit is value(h) = v + C h^p, least squares in v, C and p; what differs is the highest
order that is believed, which is 2 in the program, whose meshes are few and coarse.
"""
import dataclasses
import math

import numpy as np

LOWEST_ORDER, HIGHEST_ORDER = 0.5, 2.0
CREDIBLE = 1.2  # times the order that theory allows; what is above is chance
CONFIRMED_FACTOR, DOUBTFUL_FACTOR = 1.25, 3.0
ROUND_OFF = 1e-9  # of the value: Newton's tolerance
ZERO = 1e-10  # of the scale of values that may be 0
ORDERS = (-4.0, 12.0, 0.05)  # scanned: lowest, highest, step
VERDICTS = {
    "confirmed": "order in the asymptotic range: limit of the fit, 1.25 |finest - limit| and the scatter "
                 "about the fit",
    "fast": "order above what is believed, which is taken instead; of three levels the finest value, 3 "
            "times the spread",
    "slow": "order below 0.5, which is taken instead; of three levels the finest value, 3 times the spread "
            "or more",
    "oscillates": "three levels, not monotone: finest value, 3 times the spread",
    "few levels": "two levels, no order: finest value, 3 times the spread",
    "settled": "no change but round-off: finest value, 3 times the spread",
    "unknown": "one level, nothing to compare with: no uncertainty",
}


@dataclasses.dataclass
class Limit:
    value: float
    uncertainty: float
    order: float  # observed; nan when there is none
    verdict: str  # of VERDICTS

    def distance(self, other):
        return abs(self.value - other.value)

    def agrees(self, other):
        """The intervals of both overlap. Unknown uncertainties agree with nothing."""
        return self.distance(other) <= self.uncertainty + other.uncertainty

    def relative(self):
        return self.uncertainty / abs(self.value) if self.value else math.nan


def fit_of_order(h, v, p):
    """Least squares of v + C h^p for a given p, h falling: limit, value at the finest h, sum of squares. h^p
    is written (x^p - 1)/p, which has no trouble at p = 0, with x = h/h_finest; differences from the finest
    value keep the digits that the values share."""
    x, y = np.log(h / h[-1]), v - v[-1]
    basis = np.expm1(p * x) / p if p else x
    slope = np.dot(basis - basis.mean(), y) / np.dot(basis - basis.mean(), basis)
    at_finest = y.mean() - slope * basis.mean()
    limit = at_finest - slope / p if p else math.nan
    return v[-1] + limit, v[-1] + at_finest, float(np.sum((y - at_finest - slope * basis) ** 2))


def best_order(h, v):
    """p of the best fit: the best of a scan, then golden sections around it. Three levels are met exactly."""
    lowest, highest, step = ORDERS
    scan = lowest + step * np.arange(round((highest - lowest) / step) + 1)
    best = scan[np.argmin([fit_of_order(h, v, p)[2] for p in scan])]
    low, high, golden = best - step, best + step, (math.sqrt(5) - 1) / 2
    while high - low > 1e-12:
        left, right = high - golden * (high - low), low + golden * (high - low)
        if fit_of_order(h, v, left)[2] <= fit_of_order(h, v, right)[2]:
            high = right
        else:
            low = left
    return 0.5 * (low + high)


def judge_by_fit(h, v, spread, highest):
    p = best_order(h, v)
    used = min(max(p, LOWEST_ORDER), highest)
    verdict = "confirmed" if abs(p - used) < 1e-6 else "fast" if p > used else "slow"
    limit, finest, squares = fit_of_order(h, v, used)
    distance, misfit = abs(finest - limit), abs(v[-1] - finest)
    if len(v) > 3:
        scatter = math.sqrt(squares / (len(v) - 3))
        return Limit(limit, CONFIRMED_FACTOR * distance + scatter + misfit, p, verdict)
    if verdict == "confirmed":
        return Limit(limit, CONFIRMED_FACTOR * distance + misfit, p, verdict)
    return Limit(float(v[-1]), DOUBTFUL_FACTOR * max(spread, distance), p, verdict)


def extrapolate(sizes, values, highest=HIGHEST_ORDER, scale=0.0):
    """Limit of a series in any order of levels. highest: order that is believed; scale: of values of this
    kind, below whose 1e-10 a difference is round-off whatever the value (a torque before any rotation)."""
    coarse_to_fine = np.argsort(sizes)[::-1]
    h, v = np.asarray(sizes, float)[coarse_to_fine], np.asarray(values, float)[coarse_to_fine]
    finest, spread = float(v[-1]), float(np.ptp(v))
    if len(v) < 2:
        return Limit(finest, math.nan, math.nan, "unknown")
    whole = DOUBTFUL_FACTOR * spread
    if spread <= ROUND_OFF * np.abs(v).max() + ZERO * scale:
        return Limit(finest, whole, math.nan, "settled")
    if len(v) < 3:
        return Limit(finest, whole, math.nan, "few levels")
    rises = np.diff(v) > 0
    if len(v) == 3 and rises.any() and not rises.all():
        return Limit(finest, whole, math.nan, "oscillates")
    return judge_by_fit(h, v, spread, highest)


def believed(theory):
    """The highest order that is believed where theory allows this one."""
    return CREDIBLE * theory


def combine(mesh, steps, common):
    """Limit of mesh and step: the mesh's limit, at one step tolerance, moved by what the steps' limit, on one
    mesh, differs from `common`, the value of the run that both series share. Errors may add up, so the
    uncertainties do."""
    return Limit(mesh.value + (steps.value - common), mesh.uncertainty + steps.uncertainty, math.nan,
                 f"{mesh.verdict}/{steps.verdict}")


def best(limits):
    """The one with the smallest known uncertainty."""
    known = [limit for limit in limits if math.isfinite(limit.uncertainty)]
    return min(known, key=lambda limit: limit.uncertainty) if known else None


def all_agree(limits):
    return all(a.agrees(b) for k, a in enumerate(limits) for b in limits[k + 1:])


def family_irregularity(elements, unknowns):
    """How far a family is from self-similar: sqrt(unknowns) is linear in elements_radial when the mesh only
    scales. Largest relative deviation from the straight line."""
    n, root = np.asarray(elements, float), np.sqrt(np.asarray(unknowns, float))
    if len(n) < 3:
        return 0.0
    return float(np.max(np.abs(np.polyval(np.polyfit(n, root, 1), n) - root) / root))


def interpolate(x, y, at):
    """Piecewise cubic that keeps monotone data monotone (Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980)
    238-246, with the harmonic mean of Fritsch and Butland 1984); one-sided differences at the ends."""
    if len(x) < 3:
        return np.interp(at, x, y)
    h = np.diff(x)
    slope = np.diff(y) / h
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    before, after = slope[:-1], slope[1:]
    same = before * after > 0
    inner = np.zeros_like(before)
    inner[same] = ((w1 + w2)[same] / (w1[same] / before[same] + w2[same] / after[same]))
    d = np.concatenate(([slope[0]], inner, [slope[-1]]))
    k = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(h) - 1)
    s = (at - x[k]) / h[k]
    return y[k] + s**2 * (3 - 2 * s) * (y[k + 1] - y[k]) + s * (1 - s) * h[k] * ((1 - s) * d[k] - s
                                                                                 * d[k + 1])


def curve_difference(times, values, fine_times, fine_values):
    """Largest difference of two curves of one phase at the first one's own times, with what interpolating the
    second may add: its own error when every other step is left out, measured at those steps."""
    difference = float(np.max(np.abs(values - interpolate(fine_times, fine_values, times))))
    kept = np.unique(np.concatenate((np.arange(0, len(fine_times), 2), [len(fine_times) - 1])))
    coarse = interpolate(fine_times[kept], fine_values[kept], fine_times)
    return difference, float(np.max(np.abs(coarse - fine_values)))
