"""Gmsh files of two gels for -mesh_file, without Gmsh.

  tools/specimen-mesh square --out square.msh
  tools/specimen-mesh ellipse --ratio 2 --elements 6 --order 2 --out ellipse.msh

The top specimen is a prism over a square, an ellipse or a circle with the area of a circle of the given
radius, the bottom one a cylinder below z = 0. Cylinders and ellipses are O-grids, squares are tensor grids.
Order 1 puts the vertices on a circle (an ellipse) so much larger that the polygon has the area; order 2
writes hexahedra of 27 nodes whose middles lie on the curved wall, while -element_order 2 takes straight edges
from a file of order 1.
"""
import argparse
import math
import sys

from .command_line import Parser, positive

SQUARE_OVER_RADIUS = 0.5  # half the edge of an O-grid's inner square over the radius

# Of a hexahedron in Gmsh's order of corners: its edges and faces, in Gmsh's order of nodes.
EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
QUAD_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0)]

GROUPS = ["top", "bottom", "top_plate", "bottom_plate", "top_contact", "bottom_contact"]  # numbered from 1


def turned(x, y, quarters):
    for _ in range(quarters):
        x, y = -y, x
    return x, y


def disc_point(x, y, c):
    """From the square [-1, 1]^2 to the unit disc; within max(|x|, |y|) <= c lies a tensor grid, around it
    rings."""
    def inside(a, b):
        return a * math.sqrt(1 - b * b / 2), b * math.sqrt(1 - a * a / 2)
    s = max(abs(x), abs(y))
    if s <= c:
        return inside(x, y)
    quarters = 0
    while x < abs(y):  # until the point is in the sector about the first axis
        x, y = turned(x, y, 3)
        quarters += 1
    tau, part = y / s, (s - c) / (1 - c)
    inner, outer = inside(c, c * tau), (math.cos(tau * math.pi / 4), math.sin(tau * math.pi / 4))
    return turned(*((1 - part) * i + part * o for i, o in zip(inner, outer)), quarters)


def o_grid(elements):
    """Vertices in [-1, 1]^2, cells counter-clockwise, and c."""
    k = max(1, math.ceil(elements * SQUARE_OVER_RADIUS))
    n, c = 2 * k, k / elements
    vertices = [(c * (i / k - 1), c * (j / k - 1)) for j in range(n + 1) for i in range(n + 1)]

    def centre(i, j):
        return i + j * (n + 1)
    cells = [(centre(i, j), centre(i + 1, j), centre(i + 1, j + 1), centre(i, j + 1)) for j in range(n)
             for i in range(n)]
    ring = ([centre(n, i) for i in range(n)] + [centre(n - i, n) for i in range(n)] +
            [centre(0, n - i) for i in range(n)] + [centre(i, 0) for i in range(n)])
    for level in range(k + 1, elements + 1):
        s = level / elements
        around = [turned(s, s * (p % n / k - 1), p // n) for p in range(4 * n)]
        outer = list(range(len(vertices), len(vertices) + 4 * n))
        vertices += around
        cells += [(ring[p], outer[p], outer[(p + 1) % (4 * n)], ring[(p + 1) % (4 * n)])
                  for p in range(4 * n)]
        ring = outer
    return vertices, cells, c


def widened(cells, order):
    """What makes the area of the O-grid that of the circle: 8 k edges around, equal angles."""
    if order == 2:
        return 1
    n = 8 * max(1, math.ceil(cells * SQUARE_OVER_RADIUS))
    return math.sqrt(2 * math.pi / n / math.sin(2 * math.pi / n))


def tensor_grid(elements):
    n = 2 * elements
    vertices = [(i / elements - 1, j / elements - 1) for j in range(n + 1) for i in range(n + 1)]
    cells = [(i + j * (n + 1), i + 1 + j * (n + 1), i + 1 + (j + 1) * (n + 1), i + (j + 1) * (n + 1))
             for j in range(n) for i in range(n)]
    return vertices, cells


class Mesh:
    """Nodes, numbered from 1, and elements: Gmsh's type, number of the group, nodes."""

    def __init__(self, order):
        self.order, self.nodes, self.elements = order, [], []

    def add(self, vertices, cells, place, levels, volume, lower, upper):
        """A prism over the plane grid; `place` takes (a, b) of the grid to (x, y)."""
        stride, layers, known = len(vertices), len(levels) - 1, {}
        grid = [(a, b, z) for z in levels for a, b in vertices]

        def node(*corners):
            key = tuple(sorted(corners))
            if key not in known:
                a, b, z = (sum(grid[v][j] for v in key) / len(key) for j in range(3))
                self.nodes.append((*place(a, b), z))
                known[key] = len(self.nodes)
            return known[key]

        for v in range(len(grid)):
            node(v)

        def element(kinds, group, corners, edges, faces):
            nodes = [node(v) for v in corners]
            if self.order == 2:
                nodes += [node(*(corners[v] for v in edge)) for edge in edges]
                nodes += [node(*(corners[v] for v in face)) for face in faces]
                nodes.append(node(*corners))
            self.elements.append((kinds[self.order - 1], GROUPS.index(group) + 1, nodes))

        for layer in range(layers):
            for cell in cells:
                corners = [v + layer * stride for v in cell] + [v + (layer + 1) * stride for v in cell]
                element((5, 12), volume, corners, EDGES, FACES)
                if layer == 0:
                    element((3, 10), lower, corners[3::-1], QUAD_EDGES, [])
                if layer == layers - 1:
                    element((3, 10), upper, corners[4:], QUAD_EDGES, [])

    def write(self, stream):
        """Format 2.2. The second tag, Gmsh's number of the geometric entity, is that of the group."""
        print("$MeshFormat\n2.2 0 8\n$EndMeshFormat", file=stream)
        used = sorted({group for _, group, _ in self.elements})
        print(f"$PhysicalNames\n{len(used)}", file=stream)
        for group in used:
            print(f'{3 if group < 3 else 2} {group} "{GROUPS[group - 1]}"', file=stream)
        print(f"$EndPhysicalNames\n$Nodes\n{len(self.nodes)}", file=stream)
        for number, X in enumerate(self.nodes, 1):
            print(number, *(f"{x:.12g}" for x in X), file=stream)
        print(f"$EndNodes\n$Elements\n{len(self.elements)}", file=stream)
        for number, (kind, group, nodes) in enumerate(self.elements, 1):
            print(number, kind, 2, group, group, *nodes, file=stream)
        print("$EndElements", file=stream)


def levels(low, high, layers):
    return [low + (high - low) * k / layers for k in range(layers + 1)]


def specimens(given):
    mesh, below = Mesh(given.order), max(1, round(given.elements * given.bottom_radius / given.radius))
    R = given.bottom_radius * widened(below, given.order)
    vertices, cells, c = o_grid(below)
    mesh.add(vertices, cells, lambda a, b: tuple(R * x for x in disc_point(a, b, c)),
             levels(-given.bottom_height, 0, given.layers), "bottom", "bottom_plate", "bottom_contact")
    if given.shape == "square":
        half = given.radius * math.sqrt(math.pi) / 2
        vertices, cells = tensor_grid(given.elements)

        def place(a, b):
            return half * a, half * b
    else:
        stretch, radius = math.sqrt(given.ratio if given.shape == "ellipse" else 1), given.radius
        radius *= widened(given.elements, given.order)
        vertices, cells, c_top = o_grid(given.elements)

        def place(a, b):
            x, y = disc_point(a, b, c_top)
            return radius * stretch * x, radius / stretch * y
    mesh.add(vertices, cells, place, levels(given.gap, given.gap + given.height, given.layers), "top",
             "top_contact", "top_plate")
    return mesh


def length(text):
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not > 0")
    return value


def main(words):
    parser = Parser("specimen-mesh", __doc__)
    parser.add_argument("shape", choices=["round", "square", "ellipse"], help="of the top specimen")
    parser.add_argument("--out", help="file to write; default: standard output")
    parser.add_argument("--radius", type=length, default=10,
                        help="of the circle with the top's area [mm], default 10")
    parser.add_argument("--height", type=length, default=4.4, help="of the top specimen [mm], default 4.4")
    parser.add_argument("--bottom-radius", type=length, default=16, help="[mm], default 16")
    parser.add_argument("--bottom-height", type=length, default=4, help="[mm], default 4")
    parser.add_argument("--gap", type=float, default=0, help="between the specimens [mm], default 0")
    parser.add_argument("--ratio", type=length, default=1.5, help="of the ellipse's axes, default 1.5")
    parser.add_argument("--elements", type=positive, default=4,
                        help="along the radius or half the edge, default 4")
    parser.add_argument("--layers", type=positive, default=2, help="of elements in each specimen, default 2")
    parser.add_argument("--order", type=int, choices=[1, 2], default=1, help="of the elements, default 1")
    given = parser.parse_args(words)
    mesh = specimens(given)
    if given.out:
        with open(given.out, "w", encoding="ascii") as stream:
            mesh.write(stream)
    else:
        mesh.write(sys.stdout)

    return 0
