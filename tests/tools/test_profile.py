#!/usr/bin/python3
"""profile.csv as a scientist reads it: who integrates the pressure of the face's rows over the deformed
radius gets N, and the surfaces do not pass through one another.

  test_profile.py TRIBOGEL [unittest's arguments]
"""
import argparse
import csv
import functools
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PRESSED = ["-elements_radial", "8", "-schedule_end_times", "27", "-schedule_approach", "0.79",
           "-schedule_rates", "0"]
ARGUMENTS = None


def simpson(r, p):
    """Integral of p 2 pi r dr: a parabola through the three nodes of each element."""
    f = [2 * math.pi * x * y for x, y in zip(r, p)]
    return sum((r[k + 2] - r[k]) / 6 * (f[k] + 4 * f[k + 1] + f[k + 2]) for k in range(0, len(r) - 2, 2))


def trapezoid(r, p):
    f = [2 * math.pi * x * y for x, y in zip(r, p)]
    return sum((r[k + 1] - r[k]) * (f[k] + f[k + 1]) / 2 for k in range(len(r) - 1))


@functools.cache
def run_program(*words):
    """Rows of profile.csv, and what summary.json says of the phase's end."""
    with tempfile.TemporaryDirectory() as folder:
        command = [ARGUMENTS.tribogel, "-skip_petscrc", *words, "-output_directory", "run"]
        subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=300)
        with open(pathlib.Path(folder, "run", "profile.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        end = json.loads(pathlib.Path(folder, "run",
                                      "summary.json").read_text(encoding="utf-8"))["phases"][-1]
    return rows, end


class Profile(unittest.TestCase):
    def numbers(self, rows, surface, column):
        return [float(row[column]) for row in rows if (row["surface"], row["part"]) == (surface, "face")]

    def test_pressure_adds_up_to_the_force(self):
        for order, rule, share in (("2", simpson, 5e-4), ("2", trapezoid, 2e-3), ("1", trapezoid, 1e-2)):
            with self.subTest(order=order, rule=rule.__name__):
                rows, end = run_program(*PRESSED, "-element_order", order)
                r, p = (self.numbers(rows, "top", column) for column in ("r_mm", "pressure_MPa"))
                self.assertTrue(all(inner < outer for inner, outer in zip(r, r[1:])))
                self.assertEqual(r[0], 0)
                force = rule(r, p)
                self.assertLess(abs(force / end["normal_force_N"] - 1), share, force)

    def test_parts(self):
        """The wall stands at the reference radius of the face's edge; it has a height, the face has none."""
        rows, _ = run_program(*PRESSED, "-element_order", "2")
        self.assertEqual(list(rows[0])[-1], "part")
        walls = [row for row in rows if row["part"] == "wall"]
        self.assertGreater(len(walls), 0)
        self.assertEqual({row["part"] for row in rows}, {"face", "wall"})
        for row in rows:
            self.assertEqual(row["part"] == "wall",
                             row["surface"] == "top" and float(row["reference_z_mm"]) > 0)
        self.assertEqual({float(row["reference_r_mm"]) for row in walls}, {10.0})

    def test_surfaces_meet_on_the_axis(self):
        """Elements of order 2 have no contact condition there, and the two gels' nodes pass through one
        another by 4 micrometres on this mesh, either as far. Order 1, which has one, says where the surfaces
        are."""
        rows, end = run_program(*PRESSED, "-element_order", "2")
        top, bottom = (self.numbers(rows, surface, "z_mm") for surface in ("top", "bottom"))
        self.assertLess(abs(top[0] - bottom[0]), 1e-4)
        self.assertEqual(end["bottom_surface_centre_displacement_mm"], -bottom[0])
        _, fine = run_program(*PRESSED, "-element_order", "1", "-elements_radial", "24")
        self.assertLess(abs(end["bottom_surface_centre_displacement_mm"]
                            - fine["bottom_surface_centre_displacement_mm"]),
                        2e-4)

    def test_in_space(self):
        rows, _ = run_program("-model", "solid", "-element_order", "1", "-elements_radial", "2",
                              "-schedule_end_times", "1", "-schedule_approach", "0.05", "-schedule_rates",
                              "0")
        self.assertEqual({row["part"] for row in rows if row["surface"] == "bottom"}, {"face"})
        for row in rows:
            if row["surface"] == "top":
                self.assertEqual(row["part"] == "wall", float(row["reference_z_mm"]) > 0)


def main():
    global ARGUMENTS
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    ARGUMENTS, rest = parser.parse_known_args()
    os.environ.pop("PETSC_OPTIONS", None)
    unittest.main(argv=sys.argv[:1] + rest)


if __name__ == "__main__":
    main()
