#!/usr/bin/python3
"""tools/run: where its run goes, what it overwrites, and that it continues one.

  test_run_tool.py TRIBOGEL [unittest's arguments]
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "run"
# One gel, two phases, a handful of steps.
SCENE = """-specimens bottom
-element_order 1
-elements_radial 2
-schedule_end_times 1,2
-schedule_approach 0.05
-schedule_rates 0,0.1
-ts_adapt_type none
-ts_dt 0.5
"""
ARGUMENTS = None


class RunTool(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.directory = pathlib.Path(place.name)
        (self.directory / "scene.opts").write_text(SCENE)

    def start(self, *words, status=0, **variables):
        environment = {name: value for name, value in os.environ.items() if name != "PETSC_OPTIONS"}
        environment.update(variables, HOME=str(self.directory), OMPI_MCA_ess_singleton_isolated="1")
        done = subprocess.run([TOOL, "--program", ARGUMENTS.tribogel, *words], cwd=self.directory,
                              env=environment,
                              capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, status, f"{words}\n{done.stdout}\n{done.stderr}")
        return done

    def rows(self, name):
        return (self.directory / name / "history.csv").read_text().splitlines()[1:]

    def test_a_run_that_was_stopped_goes_on(self):
        stopped = subprocess.run([ARGUMENTS.tribogel, "-options_file", "scene.opts", "-ts_max_steps", "1",
                                  "-output_directory",
                                  "mine"], cwd=self.directory, capture_output=True, timeout=300, check=False)
        self.assertEqual(stopped.returncode, 3)
        done = self.start("-restart", "mine", "-ts_max_steps", "9")
        self.assertEqual(len(self.rows("mine")), 1 + 4)  # the initial state, then 0.5, 1, 1.5 and 2 s
        self.assertTrue((self.directory / "mine" / "picture.png").exists())
        self.assertIn("\n       2            2", done.stdout)
        self.assertFalse((self.directory / "tribogel-output").exists())

    def test_only_the_default_directory_is_overwritten_unasked(self):
        """Wherever another one is named: the program then refuses what is there."""
        (self.directory / "mine").mkdir()
        (self.directory / "mine" / "history.csv").write_text("an older run\n")
        (self.directory / "place.opts").write_text("# here\r-output_directory mine # mine\r")
        (self.directory / "outer.opts").write_text("-options_file scene.opts\n-options_file place.opts\n")
        for words, variables in ((["scene.opts", "-output_directory", "mine"], {}),
                                 (["scene.opts", "-options_file", "place.opts"], {}), (["outer.opts"], {}),
                                 (["scene.opts"], {"PETSC_OPTIONS": "-output_directory mine"})):
            self.assertIn("-output_directory = mine: holds a run",
                          self.start(*words, status=2, **variables).stderr)
        self.assertEqual((self.directory / "mine" / "history.csv").read_text(), "an older run\n")
        (self.directory / "tribogel-output").mkdir()
        (self.directory / "tribogel-output" / "history.csv").write_text("an older run\n")
        self.start("scene.opts", "-ts_max_steps", "1", status=3)
        self.assertEqual(len(self.rows("tribogel-output")), 2)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    ARGUMENTS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
