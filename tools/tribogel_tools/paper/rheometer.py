"""Section 2 and eqs. (3.11), (3.13) of the paper for the tools: a planar contact of radius R [mm] under
uniform pressure.

include/tribogel/friction/torque.hpp has the same for the program, and says what the printed (3.11) lacks;
tests/tools/test_reproduce_paper.py holds both together through the columns mu_apparent and mu_gong.
"""
import numpy as np


def coefficient(b, m, speed):
    """mu = sum b_i v^m_i, eq. (3.12); v in mm/s."""
    return sum(bi * np.asarray(speed, float) ** mi for bi, mi in zip(b, m))


def force_ratio(b, m, radius, rate):
    """F/N, the area mean of mu, at the rate in rad/s."""
    return sum(2 * bi * (rate * radius) ** mi / (mi + 2) for bi, mi in zip(b, m))


def torque_basis(m, radius, rate):
    """T/N [mm] of v^m alone."""
    return 2 * radius * (np.asarray(rate, float) * radius) ** m / (m + 3)


def torque_ratio(b, m, radius, rate):
    """T/N [mm] of the law, of which (2.2) is the case m = 1."""
    return sum(bi * torque_basis(mi, radius, rate) for bi, mi in zip(b, m))


def apparent(b, m, radius, rate, torque, force):
    """mu_apparent, eq. (3.13)."""
    return force_ratio(b, m, radius, rate) / torque_ratio(b, m, radius, rate) * torque / force


def gong(radius, torque, force):
    """4 T / (3 R N), eq. (2.3)."""
    return 4 * torque / (3 * radius * force)


def fit(m, radius, rates, ratios):
    """Section 5: coefficients of the exponents m whose T/N is nearest to the measured ones in the sum of
    squares. None may be negative."""
    basis = np.column_stack([torque_basis(mi, radius, np.asarray(rates)) for mi in m])
    size = np.linalg.norm(basis, axis=0)
    return _non_negative(basis / size, np.asarray(ratios, float)) / size


def _non_negative(basis, values):
    """Least squares with x >= 0: the best of all choices of columns, which are few."""
    count = basis.shape[1]
    best, least = np.zeros(count), np.linalg.norm(values)
    for choice in range(1, 1 << count):
        columns = [k for k in range(count) if choice >> k & 1]
        x = np.linalg.lstsq(basis[:, columns], values, rcond=None)[0]
        misfit = np.linalg.norm(basis[:, columns] @ x - values)
        if (x >= 0).all() and misfit < least:
            least, best = misfit, np.zeros(count)
            best[columns] = x
    return best
