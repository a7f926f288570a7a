"""The meshes of `-model solid -mesh_grading 1`, made again for other programs: the grid of
src/mesh/cylinder.hpp on the edges of src/mesh/meridian.cpp, which for uniform edges are few rules. Lengths in
mm."""
import itertools
import math

import numpy

SQUARE_OVER_RADIUS = 0.5  # half the inner square's edge over the radius


def cut(start, end, unit):
    """Places from start to end in edges of about one unit, at least one; without the first."""
    count = max(1, math.floor((end - start) / unit + 0.5))
    return [start + (end - start) * k / count for k in range(1, count)] + [end]


def chain(unit, *stops):
    return list(itertools.accumulate(([stops[0]], *(cut(a, b, unit) for a, b in itertools.pairwise(stops))),
                                     lambda a, b: a + b))[-1]


class Body:
    """A disc of quadrilaterals, extruded: nodes (n, 3), cells (m, 8 or 27) with their nodes in lexicographic
    order."""

    def __init__(self, radii, heights, order):
        self.order, outer = order, radii[-1]
        k, vertices, quads = disc(radii)
        corners = [(q, layer) for layer in range(len(heights) - 1) for q in quads]
        grid = {}
        self.cells = []
        steps = range(order + 1)
        for quad, layer in corners:
            square = vertices[list(quad)].reshape(2, 2, 2)
            cell = []
            for c, b, a in itertools.product(steps, repeat=3):
                s, t, u = a / order, b / order, c / order
                place = ((1 - t) * ((1 - s) * square[0, 0] + s * square[0, 1])
                         + t * ((1 - s) * square[1, 0] + s * square[1, 1]))
                key = (*(round(x * 1e9) for x in place), layer * order + c)
                if key not in grid:
                    z = (1 - u) * heights[layer] + u * heights[layer + 1]
                    grid[key] = (len(grid), (*(outer * x for x in disc_point(place, radii[k] / outer)), z))
                cell.append(grid[key][0])
            self.cells.append(cell)
        self.nodes = numpy.array([place for _, place in grid.values()])
        self.cells = numpy.array(self.cells)

    def at(self, height):
        """Nodes of a face."""
        return numpy.flatnonzero(numpy.abs(self.nodes[:, 2] - height) < 1e-9)


def disc(radii):
    """Number of edges from the axis to the square, vertices (n, 2) in the grid's plane and quadrilaterals,
    lexicographic."""
    outer, count = radii[-1], len(radii)
    last = count - (2 if count > 2 else 1)
    k = next((i for i in range(1, last) if radii[i] >= SQUARE_OVER_RADIUS * outer), last)
    n = 2 * k
    t = [-radii[k - i] / radii[k] if i < k else radii[i - k] / radii[k] for i in range(n + 1)]
    c = radii[k] / outer
    vertices = [(c * x, c * y) for y in t for x in t]
    quads = [(i + j * (n + 1), i + 1 + j * (n + 1), i + (j + 1) * (n + 1), i + 1 + (j + 1) * (n + 1))
             for j in range(n) for i in range(n)]

    def centre(i, j):
        return i + j * (n + 1)

    ring = ([centre(n, i) for i in range(n)] + [centre(n - i, n) for i in range(n)]
            + [centre(0, n - i) for i in range(n)] + [centre(i, 0) for i in range(n)])
    for radius in radii[k + 1:]:
        following = []
        for p in range(4 * n):
            following.append(len(vertices))
            vertices.append(turned((radius / outer, radius / outer * t[p % n]), p // n))
        quads += [(ring[p], following[p], ring[(p + 1) % (4 * n)], following[(p + 1) % (4 * n)])
                  for p in range(4 * n)]
        ring = following
    return k, numpy.array(vertices), quads


def turned(x, quarters):
    for _ in range(quarters):
        x = (-x[1], x[0])
    return x


def disc_point(x, c):
    """From the grid's plane to the unit disc; c is half the edge of the inner square."""
    s = max(abs(x[0]), abs(x[1]))
    if s <= c + 1e-12:
        return x[0] * math.sqrt(1 - x[1] ** 2 / 2), x[1] * math.sqrt(1 - x[0] ** 2 / 2)
    quarters = 0
    while x[0] < abs(x[1]) - 1e-12:
        x, quarters = turned(x, 3), quarters + 1
    tau, part = x[1] / s, (s - c) / (1 - c)
    inner = (c * math.sqrt(1 - (c * tau) ** 2 / 2), c * tau * math.sqrt(1 - c ** 2 / 2))
    rim = (math.cos(tau * math.pi / 4), math.sin(tau * math.pi / 4))
    return turned(tuple((1 - part) * a + part * b for a, b in zip(inner, rim)), quarters)


def two_cylinders(scene, elements, order):
    """Bottom and top body of a scene with the keys top_radius, top_height, bottom_radius, bottom_height,
    approach; the faces that meet are at height 0."""
    rim, outer, unit = scene["top_radius"], scene["bottom_radius"], scene["top_radius"] / elements
    end = min(rim + scene["approach"], (rim + outer) / 2)
    radii = chain(unit, 0, rim, end, (end + outer) / 2, outer)
    low, high = scene["bottom_height"], scene["top_height"]
    return (Body(radii, chain(unit, -low, -low / 2, 0), order),
            Body(chain(unit, 0, rim), chain(unit, 0, high / 2, high), order))
