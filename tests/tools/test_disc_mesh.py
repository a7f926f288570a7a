#!/usr/bin/python3
"""The tools' disc_mesh makes the meshes of `-model solid -mesh_grading 1`: as many unknowns as the program,
right-handed cells, faces on their planes, rims on their circles, the volumes of what the elements can
represent."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
from tribogel_tools.peers import disc_mesh  # noqa: E402

PROGRAM = sys.argv.pop(1)
SCENE = {"top_radius": 10.0, "top_height": 3.0, "bottom_radius": 12.5, "bottom_height": 3.0, "approach": 0.6}
GAUSS = numpy.polynomial.legendre.leggauss(3)


def volume(body):
    """Of the elements themselves, by Gauss's rule."""
    order, total = body.order, 0.0
    nodes = numpy.linspace(-1, 1, order + 1)
    shapes = []
    for x in GAUSS[0]:
        N = [numpy.prod([(x - nodes[j]) / (nodes[i] - nodes[j]) for j in range(order + 1) if j != i])
             for i in range(order + 1)]
        D = [sum(numpy.prod([(x - nodes[j]) / (nodes[i] - nodes[j]) for j in range(order + 1)
                             if j not in (i, k)])
                 / (nodes[i] - nodes[k]) for k in range(order + 1) if k != i) for i in range(order + 1)]
        shapes.append((numpy.array(N), numpy.array(D)))
    X = body.nodes[body.cells]
    smallest = math.inf
    for c, (Nc, Dc) in enumerate(shapes):
        for b, (Nb, Db) in enumerate(shapes):
            for a, (Na, Da) in enumerate(shapes):
                gradient = [numpy.einsum("k,j,i->kji", *three).ravel()
                            for three in ((Nc, Nb, Da), (Nc, Db, Na), (Dc, Nb, Na))]
                J = numpy.linalg.det(numpy.stack([numpy.einsum("n,mni->mi", g, X) for g in gradient], 1))
                smallest = min(smallest, J.min())
                total += GAUSS[1][a] * GAUSS[1][b] * GAUSS[1][c] * J.sum()
    return total, smallest


class DiscMesh(unittest.TestCase):
    def test_as_many_unknowns_as_the_program(self):
        for order, elements in ((1, 2), (1, 4), (1, 5), (2, 2), (2, 3)):
            with self.subTest(order=order, elements=elements), tempfile.TemporaryDirectory() as directory:
                subprocess.run([PROGRAM, "-options_file", ROOT / "options" / "solid" / "two_cylinders.opts",
                                "-model", "solid",
                                "-element_order", str(order), "-elements_radial", str(elements),
                                "-friction_law", "none", "-schedule_end_times", "1", "-schedule_approach",
                                "0.6", "-schedule_twists", "0", "-output_directory", directory, "-overwrite",
                                "-ts_max_steps", "1"],
                               check=False, capture_output=True)
                summary = json.loads((pathlib.Path(directory) / "summary.json").read_text(encoding="utf-8"))
                bottom, top = disc_mesh.two_cylinders(SCENE, elements, order)
                fixed = len(bottom.at(-3)) + len(top.at(3))
                self.assertEqual(summary["counts"]["unknowns"],
                                 3 * (len(bottom.nodes) + len(top.nodes) - fixed + len(top.at(0))))

    def test_cells_are_right_handed_and_fill_the_cylinders(self):
        for order, share in ((1, 3e-2), (2, 2e-4)):
            for body, radius in zip(disc_mesh.two_cylinders(SCENE, 4, order), (12.5, 10)):
                whole, smallest = volume(body)
                self.assertGreater(smallest, 0)
                self.assertLess(abs(whole / (3 * math.pi * radius**2) - 1), share)
                self.assertAlmostEqual(numpy.hypot(*body.nodes[:, :2].T).max(), radius, places=12)


if __name__ == "__main__":
    unittest.main()
