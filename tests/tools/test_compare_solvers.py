#!/usr/bin/python3
"""tools/compare-solvers: a log that is known, differences that are known, a comparison of solvers that
succeed, stop, and are refused.

  test_compare_solvers.py TRIBOGEL [--mpirun MPIRUN]
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools.cost import compare_solvers, logged_run  # noqa: E402

PROGRAM, MPIRUN = None, "mpirun"

LOG = """Stage Name,Event Name,Rank,Count,Time,Num Messages,Message Length,Num Reductions,FLOP,dof0,e0,2
Main Stage,summary,0,1,7.5,40.,8000.,11.,700.
Main Stage,summary,1,1,7.25,40.,8000.,11.,900.
Main Stage,KSPSolve,0,3,2.,10.,2000.,5.,100.,-1.,-1.
Main Stage,KSPSolve,1,3,2.5,14.,2400.,5.,150.,-1.,-1.
Main Stage,PCSetUp,0,0,0.,0.,0.,0.,0.
Main Stage,PCSetUp,1,0,0.,0.,0.,0.,0.
Other,KSPSolve,0,1,0.25,2.,20.,1.,7.
Other,KSPSolve,1,1,0.125,2.,20.,1.,8.
"""


class Log(unittest.TestCase):
    def test_stages_add_up_the_slowest_rank_counts_and_messages_are_counted_once(self):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory, "log.csv")
            path.write_text(LOG, encoding="utf-8")
            events = logged_run.read_log(path)
        self.assertEqual(set(events), {"summary", "KSPSolve"})
        self.assertEqual(events["KSPSolve"], (4, 2.75, 265.0, 14.0, 2220.0, 6.0))
        self.assertEqual(events["summary"], (1, 7.5, 1600.0, 40.0, 8000.0, 11.0))


class Difference(unittest.TestCase):
    def test_phases_in_both_over_the_largest_value_of_the_reference(self):
        reference = {1: {"N": 3.0}, 2: {"N": -5.0}, 3: {"N": 50.0}}
        phases = {1: {"N": 3.1}, 2: {"N": -5.0}}
        self.assertAlmostEqual(float(compare_solvers.difference(phases, reference, "N")), 100 * 0.1 / 5,
                               delta=1e-3)
        self.assertEqual(compare_solvers.difference({}, reference, "N"), "")


class Repeats(unittest.TestCase):
    def test_the_cheapest_of_those_that_got_farthest_counts(self):
        runs = [types.SimpleNamespace(status=status, cpu=cpu)
                for status, cpu in ((3, 0.5), (0, 2.5), (0, 1.5), (0, 3.5))]
        self.assertIs(logged_run.best_of(4, iter(runs).__next__), runs[2])


class Comparison(unittest.TestCase):
    def test_solvers_that_succeed_stop_and_are_refused_are_rows(self):
        with tempfile.TemporaryDirectory() as directory:
            out = pathlib.Path(directory)
            (out / "stops.opts").write_text("-ksp_type gmres\n-pc_type jacobi\n-ksp_max_it 3\n",
                                            encoding="utf-8")
            (out / "refused.opts").write_text("-pc_type nosuch\n", encoding="utf-8")
            presets = REPOSITORY / "options" / "solver"
            words = [REPOSITORY / "tools" / "compare-solvers", REPOSITORY / "options" / "quick.opts",
                     "--program", PROGRAM, "--mpirun", MPIRUN, "--ranks", "1,2", "--output", out / "study",
                     "--solvers", presets / "mumps.opts", presets / "umfpack.opts", out / "stops.opts",
                     out / "refused.opts", "--", "-elements_radial", "2", "-element_order", "1",
                     "-time_tolerance", "5", "-schedule_kind", "steady"]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            with open(out / "study" / "compare-solvers.csv", encoding="utf-8", newline="") as file:
                rows = {(row["solver"], row["ranks"]): row for row in csv.DictReader(file)}
            self.assertEqual(len(rows), 8)
            summary = json.loads((out / "study" / "runs" / "umfpack-1"
                                  / "summary.json").read_text(encoding="utf-8"))
            self.assertIn("| umfpack | 2 |",
                          (out / "study" / "compare-solvers.md").read_text(encoding="utf-8"))
        for key in (("mumps", "1"), ("umfpack", "1"), ("mumps", "2")):
            row = rows[key]
            self.assertEqual(row["status"], "0", row)
            self.assertEqual(row["linear_per_newton"], "1.0")
            self.assertLess(float(row["N_difference_per_cent"]), 1e-6)
            self.assertLess(float(row["T_difference_per_cent"]), 1e-6)
            self.assertGreater(float(row["numeric_s"]), 0)
            self.assertGreaterEqual(float(row["setup_s"]), 0.9 * float(row["numeric_s"]))
        row, last = rows["umfpack", "1"], summary["phases"][-1]
        self.assertAlmostEqual(float(row["N_N"]) / last["normal_force_N"], 1, delta=1e-5)
        self.assertAlmostEqual(float(row["T_Nmm"]) / last["torque_Nmm"], 1, delta=1e-5)
        counts = {"unknowns": "unknowns", "steps": "accepted_steps", "newton": "newton_iterations",
                  "linear": "linear_iterations"}
        self.assertEqual([int(row[name]) for name in counts],
                         [summary["counts"][name] for name in counts.values()])
        # small enough to be all solver on two ranks
        self.assertTrue(0 < float(rows["umfpack", "1"]["rest_per_cent"]) < 100)
        # another factorisation, not the same run
        self.assertGreater(float(rows["umfpack", "1"]["N_difference_per_cent"]), 0)
        self.assertEqual(rows["stops", "1"]["status"], "3")
        self.assertIn("3 iterations", rows["stops", "1"]["failure"])
        self.assertGreater(int(rows["stops", "1"]["cut_steps"]), 0)
        for key in (("refused", "1"), ("umfpack", "2")):
            self.assertEqual(rows[key]["status"], "2")
            self.assertIn("allowed", rows[key]["failure"])
            self.assertEqual(rows[key]["newton"], "")

    def test_a_run_that_takes_too_long_is_ended(self):
        with tempfile.TemporaryDirectory() as directory:
            run = logged_run.LoggedRun("/bin/sh", ["-c", "sleep 60"], pathlib.Path(directory), limit=0.2)
        self.assertEqual(run.failure, "stopped after 0.2 s")

    def test_nonsense_is_refused_in_one_line(self):
        for words in (["--ranks", "0"], ["nosuch.opts"]):
            done = subprocess.run([REPOSITORY / "tools" / "compare-solvers", "--program", PROGRAM, *words],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if sys.argv[1:2] == ["--mpirun"]:
        MPIRUN = sys.argv.pop(2)
        sys.argv.pop(1)
    unittest.main()
