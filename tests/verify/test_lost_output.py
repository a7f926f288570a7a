#!/usr/bin/python3
"""A run whose files cannot be written says so: exit status 3 and one line with the system's reason, whole
rows only, and -restart goes on from the last whole checkpoint to the history of the run that had room. Nor
does standard output that is full or closed lose a run.

  test_lost_output.py TRIBOGEL --mpirun MPIRUN [unittest's arguments]
"""
import argparse
import csv
import errno
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time
import unittest

# One gel, two phases of 10 and 890 rows: history.csv gets longer than checkpoint.h5 was at the end of the
# first.
LONG = ["-specimens", "bottom", "-element_order", "1", "-elements_radial", "2", "-schedule_end_times", "1,90",
        "-schedule_approach", "0.05,0.1", "-schedule_rates", "0,0", "-ts_adapt_type", "none", "-ts_dt", "0.1"]
BRIEF = LONG[:-1] + ["1"]
BETWEEN = 110000  # bytes: more than the checkpoint at the end of the first phase, less than the whole history
TOO_LARGE, NO_SPACE, NOT_THERE = (os.strerror(code) for code in (errno.EFBIG, errno.ENOSPC, errno.ENOENT))
ARGUMENTS = None


def rows_of(directory):
    """Of history.csv; all of them must be whole."""
    text = (directory / "history.csv").read_text()
    rows = list(csv.reader(text.splitlines()))
    if text and not text.endswith("\n") or any(len(row) != len(rows[0]) for row in rows):
        raise AssertionError(f"the last row is cut: {text[-200:]}")
    return rows[1:]


class LostOutput(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.run_program(LONG + ["-output_directory", "whole"])

    @classmethod
    def run_program(cls, words, limit=None, **streams):
        """`limit`: the most bytes that a file may have."""
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
        preparation = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                  (limit, limit))) if limit is not None else None
        return subprocess.run([ARGUMENTS.tribogel, "-skip_petscrc"] + words, cwd=cls.folder, text=True,
                              timeout=300,
                              errors="backslashreplace", preexec_fn=preparation, check=False, **streams)

    def fails(self, done, name, *parts):
        """Status 3, one line with these parts, nothing that claims to be complete."""
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tribogel: error: "), done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        if done.stdout:
            self.assertIn("NOT complete", done.stdout)
        self.assertEqual([path.name for path in (self.folder / name).glob("*.part")], [])
        summary = self.folder / name / "summary.json"
        if summary.exists():
            self.assertEqual(json.loads(summary.read_text())["status"], 3)

    def goes_on(self, name):
        """To the very history of the run that had room."""
        done = self.run_program(["-restart", name])
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in ("history.csv", "profile.csv"):
            self.assertEqual((self.folder / name / file).read_bytes(),
                             (self.folder / "whole" / file).read_bytes())
        self.assertEqual(json.loads((self.folder / name / "summary.json").read_text())["status"], 0)

    def test_history_that_cannot_grow(self):
        done = self.run_program(LONG + ["-output_directory", "run"], limit=BETWEEN)
        self.fails(done, "run", f"run/history.csv: {TOO_LARGE}", "-restart run")
        rows, whole = rows_of(self.folder / "run"), rows_of(self.folder / "whole")
        self.assertGreater(len(rows), 100)
        self.assertEqual(rows, whole[:len(rows)])
        self.goes_on("run")

    def test_any_limit(self):
        sizes = {path.name: path.stat().st_size for path in (self.folder / "whole").iterdir()}
        for limit, file in ((100, "history.csv"), (600, "checkpoint.h5.part"),
                            (sizes["summary.json"], "checkpoint.h5.part"),
                            (sizes["checkpoint.h5"] - 1, None)):
            with self.subTest(limit=limit):
                name = f"limit{limit}"
                done = self.run_program(LONG + ["-output_directory", name], limit=limit)
                self.fails(done, name, f"{name}/{file or 'history.csv'}: {TOO_LARGE}" if file else TOO_LARGE)
                rows_of(self.folder / name)
                if (self.folder / name / "checkpoint.h5").exists():
                    self.goes_on(name)
                else:
                    self.assertIn("there is no checkpoint", done.stderr)

    def start(self, name, command=()):
        words = LONG + ["-schedule_end_times", "1,300", "-output_directory", name]
        program = subprocess.Popen([*command, ARGUMENTS.tribogel, "-skip_petscrc"] + words, cwd=self.folder,
                                   text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(lambda: program.poll() is None and program.terminate())
        path = self.folder / name / "history.csv"
        for _ in range(6000):
            if path.exists() and path.read_bytes().count(b"\n") > 20:
                return program
            time.sleep(0.01)
        raise AssertionError(f"no rows in {path}")

    def end_of(self, program):
        stdout, stderr = program.communicate(timeout=300)
        return subprocess.CompletedProcess(program.args, program.returncode, stdout, stderr)

    def test_directory_that_goes(self):
        program = self.start("gone")
        (self.folder / "gone").rename(self.folder / "elsewhere")
        self.fails(self.end_of(program), "gone", f"gone/history.csv: {NOT_THERE}", "no checkpoint")
        rows_of(self.folder / "elsewhere")

    def test_two_processes_end_together(self):
        launcher = self.start("two", (ARGUMENTS.mpirun, "-q", "-n", "2"))
        children = pathlib.Path(f"/proc/{launcher.pid}/task/{launcher.pid}/children").read_text().split()
        name = pathlib.Path(ARGUMENTS.tribogel).name
        ranks = [int(child) for child in children
                 if pathlib.Path(f"/proc/{child}/comm").read_text().strip() == name]
        self.assertEqual(len(ranks), 2)
        for rank in ranks:
            resource.prlimit(rank, resource.RLIMIT_FSIZE, (1000, 1000))
        self.fails(self.end_of(launcher), "two", f"two/history.csv: {TOO_LARGE}")
        rows = rows_of(self.folder / "two")
        done = self.run_program(["-restart", "two"])
        self.assertEqual(done.returncode, 0, done.stderr)
        times = [float(row[0]) for row in rows_of(self.folder / "two")]
        self.assertEqual(len(times), 3001)
        self.assertTrue(all(0.0999 < late - early < 0.1001 for early, late in zip(times, times[1:])))
        self.assertEqual(times[:len(rows)], [float(row[0]) for row in rows])

    def test_summary_that_cannot_be_written(self):
        """A directory is in its place; the run's other files are whole."""
        self.run_program(BRIEF + ["-output_directory", "summary", "-wall_time", "1e-6"])
        (self.folder / "summary" / "summary.json").unlink()
        (self.folder / "summary" / "summary.json").mkdir()
        (self.folder / "summary" / "summary.json" / "mine").touch()
        done = self.run_program(["-restart", "summary", "-wall_time", "100"])
        self.assertEqual(done.returncode, 2, done.stderr)  # it is seen before anything is computed
        (self.folder / "summary" / "summary.json" / "mine").unlink()
        (self.folder / "summary" / "summary.json.part").mkdir()
        (self.folder / "summary" / "summary.json.part" / "mine").touch()
        done = self.run_program(["-restart", "summary", "-wall_time", "100"])
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(f"summary/summary.json.part: {os.strerror(errno.EISDIR)}; the run's other files are "
                      "whole", done.stderr)
        self.assertEqual(len(rows_of(self.folder / "summary")), 91)
        (self.folder / "summary" / "summary.json.part" / "mine").unlink()
        (self.folder / "summary" / "summary.json.part").rmdir()
        done = self.run_program(["-restart", "summary"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads((self.folder / "summary" / "summary.json").read_text())["status"], 0)

    def test_standard_output(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = self.run_program(BRIEF + ["-output_directory", "full", "-log_view"], stdout=full)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (0, 1), done.stderr)
            self.assertIn("tribogel: warning: standard output", done.stderr)
            done = self.run_program(["-help"], stdout=full)
            self.assertEqual((done.returncode, done.stderr),
                             (3, f"tribogel: error: standard output: {NO_SPACE}\n"))
        reading, writing = os.pipe()
        os.close(reading)
        done = self.run_program(BRIEF + ["-output_directory", "pipe"], stdout=writing)
        os.close(writing)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("tribogel: warning: standard output", done.stderr)
        # Closed from the start: the next file that is opened would get its number.
        words = " ".join(BRIEF)
        done = subprocess.run(f"'{ARGUMENTS.tribogel}' {words} -output_directory closed >&- 2>&- <&-",
                              shell=True,
                              cwd=self.folder, check=False)
        self.assertEqual(done.returncode, 0)
        for name in ("pipe", "closed"):
            for file in ("history.csv", "profile.csv"):
                self.assertEqual((self.folder / name / file).read_bytes(),
                                 (self.folder / "full" / file).read_bytes())

    def test_directory_whose_name_is_no_text(self):
        """It could not be written into summary.json, which is UTF-8."""
        done = self.run_program(BRIEF + ["-output_directory", os.fsdecode(b"latin\xe9")])
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("a byte 0xE9, which is no UTF-8", done.stderr)


def main():
    global ARGUMENTS
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", required=True)
    ARGUMENTS, rest = parser.parse_known_args()
    os.environ.pop("PETSC_OPTIONS", None)
    unittest.main(argv=sys.argv[:1] + rest)


if __name__ == "__main__":
    main()
