"""Limits and uncertainties of refinement series, for tools/convergence. Numbers only: no files, no runs.

A series is a value at several sizes h (mesh or time step). Its limit is v of the fit value(h) = v + C h^p: exact for three
levels of any ratio, least squares in v, C and p for more. The uncertainty is that of the grid convergence index:
P. J. Roache, J. Fluids Eng. 116 (1994) 405-413; the choice of factors follows L. Eca, M. Hoekstra, J. Comput. Phys. 262
(2014) 104-130: 1.25 times the distance of the finest value from the limit when the observed order is credible, 3 when it is
not, and then of the spread of the values unless they converge too fast.
"""
import dataclasses
import math

import numpy as np

LOWEST_ORDER = 0.3
CREDIBLE = 1.2  # times the order theory allows; more is chance
CONFIRMED_FACTOR, DOUBTFUL_FACTOR = 1.25, 3.0
ROUND_OFF = 1e-9  # of the value: Newton's tolerance
VERDICTS = {
    "confirmed": "orders in the asymptotic range: limit of the fit, 1.25 |finest - limit|",
    "fast": "observed order above what theory allows: limit with the order of theory, 3 |finest - limit|",
    "slow": "NOT in the asymptotic range (monotone, order below 0.3): finest value, 3 times spread or distance to the fit",
    "oscillates": "NOT in the asymptotic range (not monotone): finest value, 3 times the spread",
    "few levels": "fewer than three levels, no order: finest value, 3 times the spread",
    "settled": "no change but round-off: finest value, 3 times the spread",
    "one level": "nothing to compare with: no uncertainty",
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


def order_of_three(h, v):
    """p of v + C h^p through three monotone values, h falling: the ratio of differences rises with p."""
    a, b = math.log(h[0] / h[1]), math.log(h[1] / h[2])
    wanted = (v[0] - v[1]) / (v[1] - v[2])

    def ratio(p):  # (h0^p - h1^p) / (h1^p - h2^p)
        return math.expm1(a * p) / -math.expm1(-b * p) if p else a / b

    low, high = -20.0, 20.0
    for _ in range(200):
        p = 0.5 * (low + high)
        low, high = (p, high) if ratio(p) < wanted else (low, p)
    return 0.5 * (low + high)


def fit_with_order(h, v, p):
    """Least squares of v + C h^p for a given p: limit, fitted values, sum of squares. h^p is written (x^p - 1) / p, which
    has no trouble at p = 0, with x = h / h_finest."""
    x = np.log(h / h[-1])
    basis = np.column_stack((np.ones_like(x), np.expm1(p * x) / p if p else x))
    centre = v[-1]  # differences keep the digits that the values lose
    (at_finest, slope), *_ = np.linalg.lstsq(basis, v - centre, rcond=None)
    fitted = basis @ (at_finest, slope)
    limit = at_finest - slope / p if p else math.nan
    return centre + limit, centre + fitted, float(np.sum((v - centre - fitted) ** 2))


def order_of_many(h, v):
    """p of the least squares fit: the best of a scan, then golden sections around it."""
    scan = np.arange(-4, 12.001, 0.05)
    best = scan[np.argmin([fit_with_order(h, v, p)[2] for p in scan])]
    low, high, golden = best - 0.05, best + 0.05, (math.sqrt(5) - 1) / 2
    while high - low > 1e-12:
        left, right = high - golden * (high - low), low + golden * (high - low)
        if fit_with_order(h, v, left)[2] <= fit_with_order(h, v, right)[2]:
            high = right
        else:
            low = left
    return 0.5 * (low + high)


def extrapolate(sizes, values, theory, scale=0.0):
    """Limit of a series in any order of levels. theory: the highest order possible; scale: size below whose 1e-10 a
    difference is round-off whatever the value (a torque before any rotation)."""
    order = np.argsort(sizes)[::-1]
    h, v = np.asarray(sizes, float)[order], np.asarray(values, float)[order]
    finest, spread = float(v[-1]), float(np.ptp(v))
    if len(v) < 2:
        return Limit(finest, math.nan, math.nan, "one level")
    if spread <= ROUND_OFF * np.abs(v).max() + 1e-10 * scale:
        return Limit(finest, DOUBTFUL_FACTOR * spread, math.nan, "settled")
    if len(v) < 3:
        return Limit(finest, DOUBTFUL_FACTOR * spread, math.nan, "few levels")
    steps = np.diff(v)
    if not (np.all(steps > 0) or np.all(steps < 0)):
        return Limit(finest, DOUBTFUL_FACTOR * spread, math.nan, "oscillates")
    p = order_of_three(h, v) if len(v) == 3 else order_of_many(h, v)
    fast = p > CREDIBLE * theory
    limit, fitted, squares = fit_with_order(h, v, theory if fast else p)
    if p < LOWEST_ORDER:
        reach = abs(finest - limit) if p > 0 else 0.0
        return Limit(finest, DOUBTFUL_FACTOR * max(spread, reach), p, "slow")
    scatter = math.sqrt(squares / (len(v) - 3)) if len(v) > 3 else 0.0
    misfit = scatter + abs(finest - fitted[-1])
    factor = DOUBTFUL_FACTOR if fast else CONFIRMED_FACTOR
    return Limit(limit, factor * abs(finest - limit) + misfit, p, "fast" if fast else "confirmed")


def combine(mesh, steps, common):
    """Limit of mesh and step: the mesh's limit, at one step tolerance, moved by what the steps' limit, on one mesh,
    differs from `common`, the value of the run that both series share. Errors may add up, so the uncertainties do."""
    return Limit(mesh.value + (steps.value - common), mesh.uncertainty + steps.uncertainty, math.nan,
                 f"{mesh.verdict}/{steps.verdict}")


def best(limits):
    """The one with the smallest known uncertainty."""
    known = [limit for limit in limits if math.isfinite(limit.uncertainty)]
    return min(known, key=lambda limit: limit.uncertainty) if known else None


def all_agree(limits):
    return all(a.agrees(b) for k, a in enumerate(limits) for b in limits[k + 1:])


def family_irregularity(elements, unknowns):
    """How far a family is from self-similar: sqrt(unknowns) is linear in elements_radial when the mesh only scales.
    Largest relative deviation from the straight line."""
    n, root = np.asarray(elements, float), np.sqrt(np.asarray(unknowns, float))
    if len(n) < 3:
        return 0.0
    return float(np.max(np.abs(np.polyval(np.polyfit(n, root, 1), n) - root) / root))


def interpolate(x, y, at):
    """Piecewise cubic that keeps monotone data monotone (Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246, with
    the harmonic mean of Fritsch and Butland 1984); one-sided differences at the ends."""
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
    return y[k] + s**2 * (3 - 2 * s) * (y[k + 1] - y[k]) + s * (1 - s) * h[k] * ((1 - s) * d[k] - s * d[k + 1])


def curve_difference(times, values, fine_times, fine_values):
    """Largest difference of two curves of one phase at the first one's own times, with what interpolating the second may
    add: its own error when every other step is left out, measured at those steps."""
    difference = float(np.max(np.abs(values - interpolate(fine_times, fine_values, times))))
    kept = np.unique(np.concatenate((np.arange(0, len(fine_times), 2), [len(fine_times) - 1])))
    coarse = interpolate(fine_times[kept], fine_values[kept], fine_times)
    return difference, float(np.max(np.abs(coarse - fine_values)))
