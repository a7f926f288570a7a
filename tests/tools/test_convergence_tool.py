#!/usr/bin/python3
"""tools/convergence finds limits and orders that are known, does not trust those that it cannot know, reads
what runs leave, and goes through a study on tiny meshes.

  test_convergence_tool.py TRIBOGEL
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools import extrapolate as ex  # noqa: E402
from tribogel_tools.command_line import BadInput  # noqa: E402
from tribogel_tools.convergence import refinement  # noqa: E402

CASES = REPOSITORY / "tests" / "extrapolation_cases.txt"
PROGRAM = None


def power(elements, limit, slope, order):
    h = 1 / np.array(elements, float)
    return h, limit + slope * h**order


class Extrapolation(unittest.TestCase):
    def recovers(self, elements, limit, slope, order):
        h, v = power(elements, limit, slope, order)
        found = ex.extrapolate(h, v, ex.believed(4))
        self.assertEqual(found.verdict, "confirmed")
        self.assertAlmostEqual(found.order, order, delta=1e-8)
        self.assertAlmostEqual(found.value, limit, delta=1e-11 * abs(limit))
        expected = ex.CONFIRMED_FACTOR * abs(v[-1] - limit)
        self.assertAlmostEqual(found.uncertainty, expected, delta=1e-6 * expected + 1e-11 * abs(limit))

    def test_limit_and_order_of_three_levels(self):
        self.recovers((8, 16, 32), 3.7, 2.1, 2)
        self.recovers((8, 12, 16), 290.3, -75, 1.37)
        self.recovers((5, 11, 13), -0.42, 0.9, 0.61)

    def test_limit_and_order_of_more_levels(self):
        self.recovers((8, 12, 16, 24), 290.3, 75, 1.37)
        self.recovers((3, 5, 7, 13, 17), -11.3, 4.3, 2.9)

    def test_levels_in_any_order(self):
        h, v = power((8, 12, 16), 290.3, -75, 1.37)
        self.assertEqual(ex.extrapolate(h[[1, 2, 0]], v[[1, 2, 0]]), ex.extrapolate(h, v))

    def test_noise_widens_the_uncertainty_and_covers_the_limit(self):
        for noise in (0.004, -0.004):
            h, v = power((8, 12, 16, 24, 32), 7.3, 5.1, 1.6)
            v += noise * np.array([1, -1, 1, -1, 1])
            noisy = ex.extrapolate(h, v)
            self.assertEqual(noisy.verdict, "confirmed")
            self.assertGreater(noisy.uncertainty, 1.25 * abs(v[-1] - noisy.value) + 0.5 * abs(noise))
            self.assertLess(abs(noisy.value - 7.3), noisy.uncertainty)

    def test_what_does_not_converge_in_order_is_not_extrapolated(self):
        for values, verdict in (((5.0, 5.4, 5.3), "oscillates"), ((5.0, 5.1, 5.2), "slow"),
                                ((5.0, 5.1, 5.3), "slow")):
            found = ex.extrapolate(1 / 2.0 ** np.arange(len(values)), values)
            self.assertEqual((found.verdict, found.value), (verdict, values[-1]))
            self.assertGreaterEqual(found.uncertainty, 3 * (max(values) - min(values)) * (1 - 1e-12))

    def test_an_order_is_believed_up_to_what_theory_allows_and_a_fifth_more(self):
        for order, verdict in ((2.3, "confirmed"), (2.5, "fast")):
            self.assertEqual(ex.extrapolate(*power((8, 16, 32), 5, 7, order), ex.believed(2)).verdict,
                             verdict)

    def test_the_rule_is_that_of_the_program(self):
        lines = [line for line in CASES.read_text(encoding="utf-8").splitlines() if line
                 and not line.startswith("#")]
        self.assertEqual(len(lines), 16)
        for line in lines:
            sizes, values, scale, verdict, *expected = (cell.strip() for cell in line.split("|"))
            sizes, values = ([float(word) for word in text.split(",")] for text in (sizes, values))
            found = ex.extrapolate(sizes, values, scale=float(scale))
            self.assertEqual(found.verdict, verdict, line)
            for number, text in zip((found.value, found.uncertainty, found.order), expected, strict=True):
                np.testing.assert_allclose(number, float(text), 1e-6, 1e-6, err_msg=line)

    def test_mesh_and_steps_add_up(self):
        mesh, steps = ex.Limit(10.3, 0.02, 2, "confirmed"), ex.Limit(9.6, 0.05, 1, "confirmed")
        both = ex.combine(mesh, steps, 9.9)
        self.assertAlmostEqual(both.value, 10.0, delta=1e-12)
        self.assertAlmostEqual(both.uncertainty, 0.07, delta=1e-12)

    def test_agreement(self):
        a, b, c = (ex.Limit(value, u, 2, "confirmed")
                   for value, u in ((10.0, 0.1), (10.25, 0.2), (10.6, 0.2)))
        unknown = ex.Limit(10.0, float("nan"), 2, "unknown")
        self.assertTrue(a.agrees(b) and b.agrees(a) and b.agrees(c))
        self.assertFalse(a.agrees(c))
        self.assertTrue(ex.all_agree([a, b]))
        self.assertFalse(ex.all_agree([a, b, c]))
        self.assertFalse(a.agrees(unknown))
        self.assertIs(ex.best([b, unknown, a, c]), a)
        self.assertIsNone(ex.best([unknown]))

    def test_self_similarity(self):
        n = np.array([8, 12, 16, 24])
        self.assertLess(ex.family_irregularity(n, (7.3 * n - 2.2) ** 2), 1e-12)
        self.assertGreater(ex.family_irregularity(n, (7.3 * n - 2.2) ** 2 * [1, 1.1, 1, 1]), 0.01)

    def test_curves(self):
        x, at = np.array([0, 0.3, 0.9, 2, 4.5]), np.linspace(0, 4.5, 50)
        self.assertLess(np.max(np.abs(ex.interpolate(x, 2 - 3 * x, at) - (2 - 3 * at))), 1e-13)
        step = ex.interpolate(x, np.array([0, 0, 1, 1, 1.0]), at)
        self.assertTrue(np.all(np.diff(step) >= 0) and step.min() == 0 and step.max() == 1)
        fine, coarse = np.linspace(0, 2, 401), np.linspace(0, 2, 37)
        difference, bound = ex.curve_difference(coarse, np.exp(-coarse) + 0.01 * coarse, fine, np.exp(-fine))
        self.assertAlmostEqual(difference, 0.02, delta=2e-5)
        self.assertLess(bound, 2e-5)
        self.assertLess(ex.curve_difference(coarse, np.exp(-coarse), fine, np.exp(-fine))[0], bound)


def fake_run(folder, family, elements, tolerance, force, steps):
    """The files of a run with one phase, as the program writes them."""
    case = refinement.Case(family, elements, tolerance)
    directory = pathlib.Path(folder, case.name())
    directory.mkdir()
    end = dict.fromkeys(refinement.QUANTITIES.values())  # null where nothing is known
    end |= {"phase": 1, "time_s": 27.0, "normal_force_N": force, "contact_radius_mm": 10.9}
    summary = {"phases": [end], "cost": {"cpu_s": 1.5, "peak_memory_MB": 48},
               "counts": {"unknowns": elements**2, "accepted_steps": steps, "rejected_steps": 3,
                          "newton_iterations": 99}}
    (directory / "summary.json").write_text(json.dumps(summary))
    (directory / "profile.csv").write_text("phase,surface,reference_r_mm,reference_z_mm,z_mm,status\n"
                                           "1,top,4,0.5,0.2,slip\n1,top,0,0.5,0.1,slip\n"
                                           "1,top,9,0.5,0.375,open\n"
                                           "1,bottom,0,0,-0.4,nan\n")
    return refinement.read_result(case, directory)


class Reading(unittest.TestCase):
    def test_run_directory_and_limits_of_a_family(self):
        family = refinement.Family(2, "4", (8, 12, 16))
        settings = types.SimpleNamespace(tolerances=["0.01", "0.0025", "0.000625"], mesh_tolerance="0.01",
                                         step_elements={family: 8}, step_size="tolerance", time_order=1,
                                         targets=(1e-4, 1e-3))

        def force(n, tolerance):  # orders 1.5 and 1 (in the root of the tolerance)
            return 290 + 40 * n**-1.5 - 7 * float(tolerance) ** 0.5

        with tempfile.TemporaryDirectory() as folder:
            cases = [(n, "0.01") for n in family.elements] + [(8, t) for t in settings.tolerances[1:]]
            results = [fake_run(folder, family, n, t, force(n, t), 100) for n, t in cases]
            with self.assertRaisesRegex(BadInput, "cannot read"):
                refinement.read_result(results[0].case, folder)
        self.assertEqual(results[0].counts["cpu_s"], 1.5)
        self.assertAlmostEqual(results[0].value(1, "top_centre"), 0.4, delta=1e-15)
        self.assertAlmostEqual(results[0].value(1, "top_rim"), 0.125, delta=1e-15)
        self.assertTrue(np.isnan(results[0].value(1, "T")) and np.isnan(results[0].value(2, "N")))
        study = refinement.Study([family], results, settings)
        key = (family, 1, "N")
        self.assertAlmostEqual(study.mesh[key].order, 1.5, delta=1e-6)
        self.assertAlmostEqual(study.steps[key].order, 1, delta=1e-6)
        self.assertAlmostEqual(study.limits[key].value, 290, delta=1e-7)
        finest = results[2]
        self.assertAlmostEqual(study.error(finest, "N")[0], abs(force(16, "0.01") - 290) / 290, delta=1e-9)
        self.assertNotIn((family, 1, "T"), study.limits)
        results[1].failure = "status 3"
        self.assertEqual(refinement.Study([family], results, settings).mesh[key].verdict, "few levels")


class Meshes(unittest.TestCase):
    def options(self, levels, elements):
        words = refinement.Case(refinement.Family(2, "30", levels), elements, "1e-3").options("ts_atol")
        return [words[words.index(name) + 1] for name in ("-elements_radial", "-mesh_refinements")]

    def test_doublings_are_nested(self):
        self.assertEqual([self.options((6, 12, 48), n) for n in (6, 12, 48)],
                         [["6", "0"], ["6", "1"], ["6", "3"]])

    def test_others_are_not(self):
        for levels in ((8, 12, 16), (8, 16, 24), (8,)):
            self.assertEqual([self.options(levels, n) for n in levels], [[str(n), "0"] for n in levels])


class EndToEnd(unittest.TestCase):
    def study(self, folder, *words):
        return subprocess.run([REPOSITORY / "tools" / "convergence", *words], capture_output=True, text=True,
                              cwd=folder,
                              check=False)

    def refuses(self, folder, *words, because):
        done = self.study(folder, *words)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
        self.assertIn(because, done.stderr)

    def test_tiny_study(self):
        quick = str(REPOSITORY / "options" / "quick.opts")
        words = [quick, "--program", PROGRAM, "--family", "1:2:2,3,4", "--family", "2:1:1,2,4",
                 "--tolerances", "4e-2", "--output", "study"]
        schedule = ["--", "-schedule_end_times", "9,30", "-schedule_approach", "0.3,0.3", "-schedule_rates",
                    "0,0.1"]
        with tempfile.TemporaryDirectory() as folder:
            done = self.study(folder, *words, *schedule)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count(" done "), 10, done.stderr)
            out = pathlib.Path(folder, "study")
            self.assertTrue((out / "convergence.png").read_bytes().startswith(b"\x89PNG"))
            self.assertTrue((out / "convergence.pdf").read_bytes().startswith(b"%PDF"))
            with open(out / "runs.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), 20)  # 10 runs, 2 phases
            for row in rows:
                name = "order{order}_grading{grading}_n{elements}_tolerance{tolerance}".format_map(row)
                with open(out / "runs" / name / "history.csv", newline="", encoding="utf-8") as file:
                    ends = {step["phase"]: step for step in csv.DictReader(file)}
                for column in ("normal_force_N", "torque_Nmm", "contact_radius_mm", "time_s"):
                    self.assertEqual(float(row[column]), float(ends[row["phase"]][column]))
            table = (out / "convergence.md").read_text(encoding="utf-8")
            nested = json.loads((out / "runs" / "order2_grading1_n4_tolerance0.04"
                                 / "summary.json").read_text())
            self.assertEqual((nested["options"]["elements_radial"], nested["options"]["mesh_refinements"]),
                             ("1", "2"))
            for heading in ("## Runs", "order 1 grading 2", "order 2 uniform", "## Do the limits agree",
                            "mesh order"):
                self.assertIn(heading, table)
            self.refuses(folder, *words, *schedule, because="--resume")
            (out / "runs" / "order1_grading2_n3_tolerance0.04" / "study.json").unlink()
            again = self.study(folder, *words, "--resume", *schedule)
            self.assertEqual((again.stderr.count(" kept "), again.stderr.count(" done ")), (9, 1),
                             again.stderr)
            schedule[-1] = "0,0.2"
            changed = self.study(folder, *words, "--resume", *schedule)
            self.assertEqual(changed.stderr.count(" done "), 10, changed.stderr)

    def test_failed_runs_are_reported_in_the_programs_words(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.study(folder, str(REPOSITORY / "options" / "quick.opts"), "--program", PROGRAM,
                              "--family", "1:2:2,3,4", "--", "-top_radius", "-3")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("FAILED"), 5)
        self.assertRegex(done.stdout,
                         "FAILED order1_grading2_n2_tolerance0.001: status 2: tribogel: error: .*-top_radius")

    def test_bad_input_is_refused_in_one_line(self):
        quick = str(REPOSITORY / "options" / "quick.opts")
        with tempfile.TemporaryDirectory() as folder:
            for words, because in ((["nowhere.opts"], "nowhere.opts"), ([], "OPTIONS_FILE"),
                                   ([quick, "--family", "3:4:8,12,16"], "element order"),
                                   ([quick, "--elements", "2", "--ratio", "1.1"], "a mesh twice"),
                                   ([quick, "--", "-element_order", "1"],
                                    "-element_order is set by the study"),
                                   ([quick, "--mesh-tolerance", "0.5"], "--mesh-tolerance"),
                                   ([quick, "--levels", "2"], "--levels"),
                                   ([quick, "--program", "none"], "none")):
                self.refuses(folder, *words, because=because)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: test_convergence_tool.py TRIBOGEL")
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
