#!/usr/bin/python3
"""tools/scaling: powers that are known, the model's terms by hand, efficiencies of made-up runs, a study on
tiny meshes.

  test_scaling.py TRIBOGEL [--mpirun MPIRUN]
"""
import contextlib
import csv
import io
import math
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools.cost import cost_model, logged_run, scaling, scaling_report  # noqa: E402

PROGRAM, MPIRUN = None, "mpirun"


def made_up(ranks, dofs, newton, seconds, solves=None, linear=0.0, memory=100.0):
    """A run whose Newton iterations take these seconds altogether, of them the linear solver this many."""
    run = types.SimpleNamespace(ranks=ranks,
                                counts={"unknowns": dofs, "linear_iterations": 63, "newton_iterations": 9},
                                cost={"peak_memory_MB": memory}, cpu=3.0 * seconds,
                                summary={"options": {"model": "solid"}})
    run.events = {"SNESSolve": logged_run.Event(2, seconds, 1e6, 60.0, 9000.0, 30.0),
                  "KSPSolve": logged_run.Event(solves or newton, 0.75 * linear, 0, 0, 0, 0),
                  "SNESLineSearch": logged_run.Event(newton, 0, 0, 0, 0, 0),
                  "PCSetUp": logged_run.Event(newton, 0.25 * linear, 0, 0, 0, 0)}
    for name in ("event", "seconds"):
        setattr(run, name, getattr(logged_run.LoggedRun, name).__get__(run))
    for name in ("newton", "newton_seconds", "linear_seconds", "rest_of_newton"):
        setattr(run, name, getattr(logged_run.LoggedRun, name).fget(run))
    return run


class Fits(unittest.TestCase):
    def test_a_power_is_found_exactly(self):
        x = [900, 2500, 30000, 110000]
        power = cost_model.fit(x, [3e-5 * n ** 1.17 for n in x])
        self.assertAlmostEqual(power.exponent, 1.17, delta=1e-12)
        self.assertAlmostEqual(power.factor, 3e-5, delta=1e-16)
        self.assertLess(power.error, 1e-12)
        self.assertAlmostEqual(cost_model.at(power, 777), 3e-5 * 777 ** 1.17, delta=1e-12)

    def test_the_error_is_that_of_a_least_squares_slope(self):
        power = cost_model.fit([math.exp(k) for k in (0, 1, 2)], [math.exp(y) for y in (0.0, 1.3, 2.0)])
        self.assertAlmostEqual(power.exponent, 1.0, delta=1e-12)  # residuals -0.1, 0.2, -0.1
        self.assertAlmostEqual(power.error, math.sqrt(0.06 / 1 / 2), delta=1e-12)

    def test_too_little_gives_nothing(self):
        self.assertTrue(math.isnan(cost_model.fit([5, 7], [2, 3]).error))
        self.assertTrue(math.isnan(cost_model.fit([5], [2]).exponent))
        self.assertTrue(math.isnan(cost_model.fit([5, 7], [0, 3]).exponent))

    def test_memory_is_an_offset_and_a_slope(self):
        offset, slope = cost_model.line([1000, 3000, 9000], [50 + 6e-3 * n for n in (1000, 3000, 9000)])
        self.assertAlmostEqual(offset, 50, delta=1e-9)
        self.assertAlmostEqual(slope, 6e-3, delta=1e-12)


class TheModel(unittest.TestCase):
    machine = cost_model.Machine(latency=3e-6, bandwidth=2e9, neighbours=5)

    def model(self, traffic):
        return cost_model.Model(cost_model.Power(4e-5, 1.1, 0), cost_model.Power(6, 0.05, 0), traffic,
                                self.machine, 3)

    def test_terms_by_hand(self):
        model = self.model(cost_model.Traffic(ranks=2, dofs=1000, iterations=8, messages=20, bytes=4e5,
                                              reductions=30))
        more = (64000 / 1000) ** 0.05
        compute, latency, moved = model.parts(64000, 16)
        self.assertAlmostEqual(compute, 4e-5 * 64000 ** 1.1 / 16, delta=1e-12)
        # one neighbour measured, five here
        self.assertAlmostEqual(latency, 3e-6 * (10 * 5 + 2 * 4 * 30) * more, delta=1e-15)
        self.assertAlmostEqual(moved, 2e5 * 5 * (4000 / 500) ** (2 / 3) * more / 2e9, delta=1e-15)
        self.assertAlmostEqual(model.seconds(64000, 16), compute + latency + moved, delta=1e-15)
        self.assertEqual(model.parts(64000, 1)[1:], (0, 0))

    def test_the_measured_run_is_met(self):
        traffic = cost_model.Traffic(ranks=3, dofs=5000, iterations=8, messages=60, bytes=9e5, reductions=30)
        _, latency, moved = self.model(traffic).parts(5000, 3)
        self.assertAlmostEqual(latency, 3e-6 * (20 + 2 * math.log2(3) * 30), delta=1e-15)
        self.assertAlmostEqual(moved, 3e5 / 2e9, delta=1e-15)

    def test_without_messages_it_is_perfect(self):
        self.assertAlmostEqual(self.model(None).efficiency(1e6, 64), 1, delta=1e-12)


class Report(unittest.TestCase):
    one, two = made_up(1, 8000, 10, 20.0), made_up(2, 8000, 12, 15.0)  # 2 s and 1.25 s an iteration

    def test_strong_efficiency_is_per_iteration(self):
        self.assertAlmostEqual(scaling_report.efficiency(self.one, self.two), 2 / (2 * 1.25), delta=1e-14)

    def test_weak_efficiency_is_per_dof(self):
        self.assertAlmostEqual(scaling_report.weak_efficiency(self.one, made_up(2, 17000, 10, 25.0)),
                               2 / 8000 / (5 / 17000), delta=1e-14)

    def test_solves_outside_newton_do_not_count(self):
        run = made_up(1, 8000, 10, 20.0, solves=12, linear=6.0)
        self.assertAlmostEqual(run.rest_of_newton, 1 - 6 * 10 / 12 / 20, delta=1e-14)

    def test_each_event_has_an_efficiency_of_its_own(self):
        one, two = made_up(1, 8000, 10, 20.0), made_up(2, 8000, 10, 12.5)  # 2 s and 1.25 s an iteration
        one.events["GelBulkJacobian"] = logged_run.Event(10, 6.0, 0, 0, 0, 0)
        two.events["GelBulkJacobian"] = logged_run.Event(10, 3.3, 0, 4.0, 7e6, 0)
        text = scaling_report.strong_tables({(1, 4): one, (2, 4): two}, {})
        self.assertIn("| SNESSolve | 2 | 2 | 1.25 | 0.80 | 6 | 0.0009 |", text)
        self.assertIn(f"| GelBulkJacobian | 10 | 0.6 | 0.33 | {6 / (2 * 3.3):.2f} | 0.4 | 0.7 |", text)

    def test_what_is_residual_and_jacobian_is_not_the_solver(self):
        run = made_up(1, 8000, 10, 20.0, linear=17.0)  # an inner set-up counted twice
        run.events |= {"SNESFunctionEval": logged_run.Event(12, 1.5, 0, 0, 0, 0),
                       "SNESJacobianEval": logged_run.Event(10, 6.5, 0, 0, 0, 0)}
        self.assertAlmostEqual(logged_run.LoggedRun.linear_seconds.fget(run), 12, delta=1e-12)

    def test_what_it_must_state(self):
        runs = {(1, k): made_up(1, n, 10, 1e-3 * n ** 1.25, linear=5e-4 * n ** 1.25, memory=40 + 5e-3 * n)
                for k, n in ((4, 1000), (8, 8000), (16, 64000))}
        text = scaling_report.report(runs, [], {1: 2e10}, TheModel.machine, [10 ** 6], [1, 8])
        self.assertIn("Cost of a Newton iteration ~ dofs^1.25 from 1000 to 64000 dofs", text)
        self.assertIn("40 MB + 5 kB/dof", text)
        self.assertIn("not the linear solver: 50 %", text)
        self.assertIn("Extrapolated, not measured", text)
        self.assertIn(f"| 1000000 | 8 | 7.0 | {1e-4 * 1e6 ** 1.25 / 8:.3g} |", text)
        self.assertIn("nothing is known of messages", text)


class Study(unittest.TestCase):
    def test_the_cheapest_of_those_repeated_counts(self):
        runs = [types.SimpleNamespace(status=status, cpu=cpu, failure="", newton_seconds=1.0, counts={})
                for status, cpu in ((3, 0.5), (0, 2.5), (0, 1.5), (0, 3.5))]
        a = scaling.parse(["--repeats", "4"])
        study = scaling.Study(a, "program")
        with unittest.mock.patch.object(scaling, "LoggedRun",
                                        side_effect=runs), contextlib.redirect_stderr(io.StringIO()):
            study.run(1, 6)
        self.assertIs(study.runs[1, 6], runs[2])

    def scaling(self, *words):
        return subprocess.run([REPOSITORY / "tools" / "scaling", "--program", PROGRAM, "--mpirun", MPIRUN,
                               *map(str, words)],
                              capture_output=True, text=True, check=False)

    def test_a_tiny_study(self):
        with tempfile.TemporaryDirectory() as directory:
            out = pathlib.Path(directory) / "study"
            triad = pathlib.Path(directory) / "triad"
            triad.write_text('#!/bin/sh\necho \'{"benchmarks": [{"B/s": 8e9}]}\'\n', encoding="utf-8")
            triad.chmod(0o755)
            done = self.scaling(REPOSITORY / "options" / "quick.opts", "--elements", "2,3", "--weak",
                                "1:2,2:3", "--triad", triad, "--output", out, "--", "-schedule_kind",
                                "steady", "-element_order", "1")
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(out / "scaling.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            text = (out / "scaling.md").read_text(encoding="utf-8")
            for kind in ("png", "pdf"):
                self.assertGreater((out / f"scaling.{kind}").stat().st_size, 1000)
        self.assertEqual({(row["elements"], row["ranks"]) for row in rows},
                         {("2", "1"), ("2", "2"), ("3", "1"), ("3", "2")})
        solves = {row["ranks"]: row for row in rows if row["event"] == "SNESSolve" and row["elements"] == "3"}
        self.assertEqual(solves["1"]["newton"], solves["2"]["newton"])
        self.assertEqual(float(solves["1"]["messages"]), 0)
        self.assertGreater(float(solves["2"]["messages"]), 0)
        self.assertGreater(int(rows[-1]["dofs"]), int(rows[0]["dofs"]))
        self.assertIn("2 at once 16.0 GB/s, 2.00 times one core's", text)
        for part in ("Strong scaling", "Weak scaling", "GelBulkJacobian", "memory bandwidth",
                     "Cost of a Newton iteration ~ dofs^"):
            self.assertIn(part, text)

    def test_runs_that_fail_are_said_and_nonsense_is_refused(self):
        with tempfile.TemporaryDirectory() as directory:
            done = self.scaling("--no-triad", "--elements", "2", "--ranks", "1", "--output", directory, "--",
                                "-pc_type", "nosuch")
            self.assertEqual(done.returncode, 1)
            self.assertIn("nosuch", done.stderr)
        for words in (["--elements", "0"], ["nosuch.opts"], ["--weak", "1"], ["--neighbours", "0"]):
            done = self.scaling(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn("error: ", done.stderr)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if sys.argv[1:2] == ["--mpirun"]:
        MPIRUN = sys.argv.pop(2)
        sys.argv.pop(1)
    unittest.main()
