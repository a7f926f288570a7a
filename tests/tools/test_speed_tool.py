#!/usr/bin/python3
"""tools/speed-against-error: errors of courses and ends that are known, the front of what none beats, a study
on tiny meshes.

  test_speed_tool.py TRIBOGEL
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools.cost import speed  # noqa: E402

PROGRAM = None


def row(model, cpu, N, T, failure=""):
    return {"model": model, "cpu_s": str(cpu), "error_N_ends_per_cent": str(N),
            "error_T_ends_per_cent": str(T),
            "failure": failure}


class Comparison(unittest.TestCase):
    def test_a_course_is_compared_at_its_own_times_and_scaled_by_the_largest_value(self):
        times = numpy.linspace(0, 1, 11)
        reference = {"1": numpy.array([times, 3 + times, 0 * times])}
        course = {"1": numpy.array([[0.05, 0.55], [3.05, 3.65], [0, 0]])}  # the second is 0.1 off, of 4
        self.assertAlmostEqual(speed.largest_difference(course, reference, speed.FORCE), 0.1 / 4, delta=1e-14)

    def test_between_steps_a_cubic_is_itself(self):
        times = numpy.array([0.1, 0.2, 0.5, 1.0, 2.5, 3.0])
        at = numpy.array([0.1, 0.15, 0.7, 1.4, 2.9, 3.0])
        cubic = numpy.polynomial.Polynomial([1.0, -2.0, 0.5, 0.25])
        self.assertLess(abs(speed.interpolated(at, times, cubic(times)) - cubic(at)).max(), 1e-14)
        self.assertAlmostEqual(speed.interpolated(numpy.array([0.4]), times[1:3], 3 * times[1:3])[0], 1.2,
                               delta=1e-15)

    def test_times_before_the_first_step_of_the_reference_do_not_count(self):
        reference = {"1": numpy.array([[1.0, 2.0], [0.0, 0.0], [5.0, 5.0]])}
        course = {"1": numpy.array([[0.5, 1.5], [0.0, 0.0], [77.0, 5.5]])}
        self.assertAlmostEqual(speed.largest_difference(course, reference, speed.TORQUE), 0.1, delta=1e-14)

    def test_the_front_is_what_none_of_the_same_model_beats(self):
        rows = [row("a", 1, 0.5, 0.1), row("a", 2, 0.1, 0.6), row("a", 3, 0.2, 0.1),
                row("a", 0.1, 0, 0, "no"),
                row("b", 5, 0.4, "")]
        self.assertEqual([r["cpu_s"] for r in speed.front(rows)], ["1", "3", "5"])

    def test_the_larger_error_counts(self):
        self.assertEqual(speed.error_of(row("a", 1, 0.2, 0.3)), 0.3)
        self.assertEqual(speed.error_of(row("a", 1, 0.2, "")), 0.2)


class Study(unittest.TestCase):
    def test_a_tiny_study_writes_its_files_and_errors_fall_with_the_mesh(self):
        with tempfile.TemporaryDirectory() as directory:
            out = pathlib.Path(directory) / "study"
            words = [REPOSITORY / "tools" / "speed-against-error", REPOSITORY / "options" / "quick.opts",
                     "--program", PROGRAM, "--orders", "1", "--elements", "2,4", "--tolerances", "1",
                     "--integrators", "sdirk2", "--solid", ":", "--reference-elements", "6",
                     "--reference-tolerance", "1", "--output", out]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(out / "speed-against-error.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([r["elements"] for r in rows], ["2", "4"])
            self.assertGreater(speed.error_of(rows[0]), 1.2 * speed.error_of(rows[1]))
            self.assertGreater(float(rows[1]["error_N_throughout_per_cent"]), 0)
            for kind in ("md", "png", "pdf"):
                self.assertGreater((out / f"speed-against-error.{kind}").stat().st_size, 100)

    def test_nonsense_is_refused_in_one_line(self):
        for words in (["--solid", "3:4"], ["--orders", "7"], ["--integrators", "bdf"]):
            done = subprocess.run([REPOSITORY / "tools" / "speed-against-error", "--program", PROGRAM,
                                   *words],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn("allowed: ", done.stderr)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
