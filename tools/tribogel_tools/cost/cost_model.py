"""Powers fitted to measured costs, and what they say about larger problems on more processes. A model, not a
measurement."""
import collections
import math

import numpy

# y = factor x^exponent; error: standard error of the exponent
Power = collections.namedtuple("Power", "factor exponent error")
# s, B/s of one process, blocks that a block touches
Machine = collections.namedtuple("Machine", "latency bandwidth neighbours")

# Per Newton iteration, of all processes together except reductions, which each makes; iterations: linear.
Traffic = collections.namedtuple("Traffic", "ranks dofs iterations messages bytes reductions")


def fit(x, y):
    """Least squares in logarithms. The error is nan with two points, everything is nan with fewer or where y
    is not positive."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    if len(set(x)) < 2 or min(y) <= 0:
        return Power(math.nan, math.nan, math.nan)
    X, Y = numpy.log(x) - numpy.log(x).mean(), numpy.log(y)
    slope = (X * (Y - Y.mean())).sum() / (X * X).sum()
    left = Y - Y.mean() - slope * X
    error = math.sqrt((left * left).sum() / (len(x) - 2) / (X * X).sum()) if len(x) > 2 else math.nan
    return Power(math.exp(Y.mean() - slope * numpy.log(x).mean()), slope, error)


def at(power, x):
    return power.factor * x ** power.exponent


def line(x, y):
    """Offset and slope, which are not negative, of y = a + b x."""
    x, y = numpy.asarray(x, float), numpy.asarray(y, float)
    if len(set(x)) < 2:
        return 0.0, float(y[-1] / x[-1])
    slope, offset = numpy.polyfit(x, y, 1)
    if offset < 0:
        return 0.0, float((x * y).sum() / (x * x).sum())
    return (float(offset), float(slope)) if slope > 0 else (float(y.mean()), 0.0)


class Model:
    """Seconds of one Newton iteration with n dofs on p processes that each have a core and its memory to
    themselves:

        C(n)/p + latency (messages + 2 log2(p) reductions) + bytes / bandwidth

    C: the power fitted on one process. Messages and bytes are those of one process, from the largest measured
    run on several (traffic), per linear iteration; messages grow with the number of neighbours, at most
    machine.neighbours; bytes also with a block's surface, (n/p)^(2/3), or its square root in the half plane
    (dimension 2); all with the linear iterations, whose power in n is fitted too. p does not change the
    number of iterations, and the work is shared evenly."""

    def __init__(self, cost, iterations, traffic, machine, dimension):
        self.cost, self.iterations, self.traffic = cost, iterations, traffic
        self.machine, self.dimension = machine, dimension

    def linear_iterations(self, dofs):
        return at(self.iterations, dofs)

    def parts(self, dofs, ranks):
        """Seconds computing, waiting for latency, and moving bytes; the last two are 0 without measured
        traffic."""
        compute = at(self.cost, dofs) / ranks
        t = self.traffic
        if ranks == 1 or not t:
            return compute, 0.0, 0.0
        more = self.linear_iterations(dofs) / self.linear_iterations(t.dofs)
        crowd = min(ranks - 1, self.machine.neighbours) / min(t.ranks - 1, self.machine.neighbours)
        surface = (dofs / ranks / (t.dofs / t.ranks)) ** (1 - 1 / self.dimension)
        messages = t.messages / t.ranks * crowd * more
        bytes_moved = t.bytes / t.ranks * crowd * surface * more
        waits = messages + 2 * math.log2(ranks) * t.reductions * more
        return compute, self.machine.latency * waits, bytes_moved / self.machine.bandwidth

    def seconds(self, dofs, ranks):
        return sum(self.parts(dofs, ranks))

    def efficiency(self, dofs, ranks):
        return self.seconds(dofs, 1) / (ranks * self.seconds(dofs, ranks))
