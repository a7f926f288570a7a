#!/usr/bin/python3
"""tools/sensitivity: differences of known functions; sums of sensitivities that dimensions prescribe, on a
tiny mesh; what is refused, what fails.

  test_sensitivity_tool.py TRIBOGEL
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools.sensitivity import study  # noqa: E402

PROGRAM = None
SMALL = ["-element_order", "1", "-elements_radial", "6", "-mesh_grading", "2", "-schedule_kind", "steady",
         "-schedule_end_times", "10,20", "-schedule_approach", "0.5,0.5", "-schedule_rates", "0.1,1"]


class Numbers(unittest.TestCase):
    def test_central_differences_are_exact_up_to_the_third_power(self):
        step, slope, cubic = 0.04, 1.7, -31.0
        values = {k: 5 + slope * k * step + 7 * (k * step)**2 + cubic * (k * step)**3
                  for k in (-1, -0.5, 0, 0.5, 1)}
        found, error = study.differences(step, values, True)
        self.assertAlmostEqual(found, slope, delta=1e-12)
        self.assertAlmostEqual(error, 0.75 * abs(cubic) * step**2, delta=1e-12)

    def test_one_sided_differences_are_exact_for_parabolas(self):
        step, slope = 0.03, -0.9
        values = {k: 2 + slope * k * step + 11 * (k * step)**2 for k in (0, 0.5, 1)}
        found, error = study.differences(step, values, False)
        self.assertAlmostEqual(found, slope, delta=1e-12)
        self.assertAlmostEqual(error, 11 * step / 2, delta=1e-12)

    def test_what_is_shown(self):
        self.assertEqual(study.shown(2.71348, 0.0038), "2.713(4)")
        self.assertEqual(study.shown(-0.00001, 0.00002), "0.0000(1)")
        self.assertEqual(study.shown(-1.26, 0.2), "-1.3(2)")
        self.assertEqual(study.shown(3.4, 7.0), "3(7)")
        self.assertEqual(study.shown(math.nan, math.nan), "-")


class Tool(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.empty = self.folder / "empty.opts"
        self.empty.write_text("")

    def tool(self, *words, further=SMALL, status=0):
        done = subprocess.run(["/usr/bin/python3", str(REPOSITORY / "tools" / "sensitivity"),
                               str(self.empty), "--program",
                               PROGRAM, "--output", str(self.folder / "study"), *words, "--", *further],
                              capture_output=True, text=True, timeout=500, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def numbers(self):
        with open(self.folder / "study" / "sensitivity.csv", newline="", encoding="utf-8") as file:
            return {(row["parameter"], row["quantity"], int(row["phase"])): (float(row["sensitivity"]),
                                                                             float(row["error"]))
                    for row in csv.DictReader(file)}

    def test_sums_that_dimensions_prescribe(self):
        """N = modulus x length^2, T = N x length x mu, in steady states."""
        lengths = ("top height", "bottom height", "top radius", "bottom radius", "approach")
        self.tool("--only", *lengths, "G equilibrium", "K", "b (v^1)", "b (v^0)", "b (v^2)", "--jobs", "2")
        found = self.numbers()

        def total(names, quantity):
            pairs = [found[name, quantity, 2] for name in names]
            return sum(value for value, _ in pairs), sum(error for _, error in pairs)

        for names, quantity, expected in ((lengths, "N", 2), (lengths, "T", 4),
                                          (("G equilibrium", "K"), "N", 1)):
            value, error = total(names, quantity)
            self.assertLess(abs(value - expected), 1e-4 + error, (names, quantity, value, error))
            self.assertLess(error, 0.01)
        self.assertLess(abs(found["b (v^1)", "T", 2][0] - 1), 2e-5)
        self.assertLess(abs(found["b (v^1)", "N", 2][0]), 1e-3)
        # 8/9 and 6/5 under uniform pressure on the undeformed face.
        for phase in (1, 2):
            self.assertTrue(0.85 < found["b (v^0)", "T", phase][0] < 1.05, found["b (v^0)", "T", phase])
            self.assertTrue(1.1 < found["b (v^2)", "T", phase][0] < 1.3, found["b (v^2)", "T", phase])
        table = (self.folder / "study" / "sensitivity.md").read_text(encoding="utf-8")
        self.assertIn("| K: bulk modulus of the equilibrium part |", table)
        self.assertIn("CPU s", table)

    def test_runs_that_fail_are_named(self):
        equal = SMALL + ["-bottom_radius", "10"]  # a larger top radius is refused
        done = self.tool("--only", "top radius", "K", further=equal, status=3)
        self.assertIn("top radius: no number", done.stdout)
        self.assertIn(("K", "N", 1), self.numbers())
        self.assertNotIn(("top radius", "N", 1), self.numbers())

    def test_bad_input_is_refused(self):
        for words, text in ((("--only", "colour"), "no parameter colour"), (("--step", "0.5"), "--step 0.5")):
            done = self.tool(*words, status=2)
            self.assertIn(text, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("-top_height", self.tool(further=["-top_height", "-1"], status=2).stderr)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
