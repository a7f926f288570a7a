#!/usr/bin/python3
"""-error_estimate: companions run after the run and leave its files alone; what has no companion, is stopped
or fails is said, and the run's own status stays.

  test_error_option.py TRIBOGEL --mpirun MPIRUN [unittest's arguments]
"""
import argparse
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SCENE = ["-element_order", "1", "-elements_radial", "8", "-mesh_grading", "2", "-schedule_end_times", "9,30",
         "-schedule_approach", "0.3,0.3", "-schedule_rates", "0,0.1", "-time_tolerance", "1"]
ASKED = ["-error_estimate", "true"]
LOADS = ("normal_force_N", "torque_Nmm")
ARGUMENTS = None


class ErrorOption(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def command(self, name, words, ranks=1):
        launcher = [ARGUMENTS.mpirun, "-q", "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, ARGUMENTS.tribogel, "-skip_petscrc", *words, "-output_directory",
                str(self.folder / name)]

    def run_program(self, name, words, ranks=1, status=0):
        done = subprocess.run(self.command(name, words, ranks), cwd=self.folder, capture_output=True,
                              text=True,
                              timeout=300, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def summary(self, name):
        return json.loads((self.folder / name / "summary.json").read_text(encoding="utf-8"))

    def errors(self, name):
        return [[phase[load][kind]["error"] for load in LOADS for kind in ("mesh", "time")]
                for phase in self.summary(name)["error_estimate"]["phases"]]

    def test_the_run_is_the_one_without_it(self):
        self.run_program("plain", SCENE)
        done = self.run_program("asked", SCENE + ASKED)
        for file in ("history.csv", "profile.csv"):
            self.assertEqual((self.folder / "plain" / file).read_bytes(),
                             (self.folder / "asked" / file).read_bytes())
        self.assertEqual({path.name for path in (self.folder / "plain").iterdir()},
                         {path.name for path in (self.folder / "asked").iterdir()})
        plain, asked = self.summary("plain"), self.summary("asked")
        self.assertNotIn("error_estimate", plain)
        self.assertEqual(plain["phases"], asked["phases"])
        self.assertEqual(plain["counts"], asked["counts"])
        estimate = asked["error_estimate"]
        self.assertEqual(estimate["notes"], [])
        self.assertGreaterEqual(len(estimate["companions"]), 3)
        self.assertAlmostEqual(estimate["cpu_s"], sum(c["cpu_s"] for c in estimate["companions"]), delta=1e-9)
        self.assertEqual([phase[LOADS[0]]["value"] for phase in estimate["phases"]],
                         [phase[LOADS[0]] for phase in asked["phases"]])
        pressed, turned = self.errors("asked")
        for error in pressed[:2] + turned:  # no torque while pressed
            self.assertGreater(error, 0)
        self.assertLess(pressed[2] + pressed[3], 1e-6 * asked["phases"][1][LOADS[1]])
        for word in ("+- mesh", "+- time", "CPU s"):
            self.assertIn(word, done.stdout)
        self.assertEqual(done.stderr, "")

    def test_on_two_ranks_it_is_the_same(self):
        self.run_program("one", SCENE + ASKED)
        self.run_program("two", SCENE + ASKED, ranks=2)
        for one, two in zip(self.errors("one"), self.errors("two")):
            for a, b in zip(one, two):
                self.assertAlmostEqual(a, b, delta=1e-3 * abs(a) + 1e-6)

    def test_a_steady_run_has_no_error_in_time(self):
        self.run_program("steady", SCENE + ASKED + ["-schedule_kind", "steady"])
        for error in self.errors("steady"):
            self.assertGreater(error[0], 0)
            self.assertLess(error[1], 1e-3 * error[0])  # Newton's tolerance

    def test_solids_from_a_mesh_file_have_one_in_time_only(self):
        words = ["-model", "solid", "-mesh_file", str(REPOSITORY / "options" / "solid" / "square.msh"),
                 "-element_order", "1", "-schedule_end_times", "9", "-schedule_approach", "0.2",
                 "-schedule_rates", "0", "-time_tolerance", "1"]
        self.run_program("file", words + ASKED)
        estimate = self.summary("file")["error_estimate"]
        self.assertIn("-mesh_file", " ".join(estimate["notes"]))
        self.assertIsNone(self.errors("file")[0][0])
        self.assertGreater(self.errors("file")[0][1], 0)

    def test_solids_have_both(self):
        self.run_program("solid",
                         ["-model", "solid", "-element_order", "1", "-elements_radial", "4",
                          "-schedule_end_times", "9", "-schedule_approach", "0.2", "-schedule_rates", "0",
                          "-time_tolerance", "1"] + ASKED)
        self.assertGreater(min(self.errors("solid")[0][:2]), 0)

    def test_steps_without_tolerance_are_named(self):
        self.run_program("fixed", SCENE + ASKED + ["-ts_adapt_type", "none", "-ts_dt", "3"])
        self.assertIn("-ts_adapt_type", " ".join(self.summary("fixed")["error_estimate"]["notes"]))
        self.assertGreater(self.errors("fixed")[0][0], 0)
        self.assertIsNone(self.errors("fixed")[0][1])

    def test_a_companion_that_fails_is_named_and_the_run_is_well(self):
        self.run_program("plain", SCENE)
        steps = str(self.summary("plain")["counts"]["accepted_steps"])
        self.run_program("limited", SCENE + ASKED + ["-ts_max_steps", steps])  # too few for the shorter ones
        estimate = self.summary("limited")["error_estimate"]
        self.assertEqual([c["tolerance_over_run"] < 1 for c in estimate["companions"]],
                         ["-ts_max_steps" in c["failure"] for c in estimate["companions"]])
        self.assertEqual(len(estimate["notes"]), 1)
        self.assertIn("failed: -ts_max_steps", estimate["notes"][0])
        self.assertGreater(self.errors("limited")[0][0], 0)
        self.assertIsNone(self.errors("limited")[0][1])

    def test_a_run_that_is_complete_gets_it_by_restart(self):
        self.run_program("asked", SCENE + ASKED)
        self.run_program("late", SCENE)
        history = (self.folder / "late" / "history.csv").read_bytes()
        done = subprocess.run([ARGUMENTS.tribogel, "-skip_petscrc", "-restart", "late", *ASKED],
                              cwd=self.folder,
                              capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "late" / "history.csv").read_bytes(), history)
        self.assertEqual(self.errors("late"), self.errors("asked"))

    def test_a_signal_ends_the_companions_and_not_the_status(self):
        words = ["-options_file", str(REPOSITORY / "options" / "quick.opts"), "-elements_radial", "10",
                 *ASKED]
        program = subprocess.Popen(self.command("stopped", words), cwd=self.folder, stdout=subprocess.DEVNULL)
        path = self.folder / "stopped" / "summary.json"
        for _ in range(12000):
            if path.exists() or program.poll() is not None:
                break
            time.sleep(0.01)
        program.send_signal(signal.SIGTERM)
        self.assertEqual(program.wait(timeout=120), 0)
        estimate = self.summary("stopped")["error_estimate"]
        self.assertEqual(estimate["notes"], ["stopped by SIGTERM"])
        self.assertEqual(estimate["phases"], [])

    def test_a_run_that_is_stopped_has_none(self):
        done = self.run_program("short", SCENE + ASKED + ["-wall_time", "1e-3"], status=4)
        self.assertEqual(self.summary("short")["error_estimate"]["notes"], ["the run is not complete"])
        self.assertIn("the run is not complete", done.stdout)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("tribogel")
    parser.add_argument("--mpirun", default="mpirun")
    ARGUMENTS, rest = parser.parse_known_args()
    ARGUMENTS.tribogel = str(pathlib.Path(ARGUMENTS.tribogel).resolve())
    unittest.main(argv=[sys.argv[0], *rest])
