"""What the tests of -restart share: scenes, starts of the program, comparison of histories."""
import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SCENE = ["-options_file", str(REPOSITORY / "options" / "quick.opts")]
# Few steps, two phases, slip.
SHORT = ["-element_order", "1", "-elements_radial", "3", "-mesh_grading", "2", "-schedule_end_times", "9,30",
         "-schedule_approach", "0.3,0.3", "-schedule_rates", "0,0.1", "-ts_adapt_type", "none", "-ts_dt", "3"]
TOLERANCE = 1e-10  # of the largest |N| and |T|
ARGUMENTS = None


def command(ranks):
    """The program, by itself or on several ranks; -q spares the launcher's remarks on exit statuses."""
    return ([ARGUMENTS.mpirun, "-q", "-n", str(ranks)] if ranks > 1 else []) + [ARGUMENTS.tribogel,
                                                                                "-skip_petscrc"]


def run(ranks, words, folder, status=0):
    done = subprocess.run(command(ranks) + words, cwd=folder, capture_output=True, text=True, timeout=300,
                          check=False)
    if done.returncode != status:
        raise AssertionError(f"status {done.returncode}, not {status}: {words}\n{done.stdout}\n{done.stderr}")
    return done


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def differences(directory, reference):
    """Largest differences of N and T, relative to their largest values, of two complete histories."""
    rows, expected = table(directory / "history.csv"), table(reference / "history.csv")
    if [row["phase"] for row in rows] != [row["phase"] for row in expected]:
        raise AssertionError(f"{len(rows)} rows for {len(expected)}, or other phases")
    times = [float(row["time_s"]) for row in rows]
    if any(late <= early for early, late in zip(times, times[1:])):
        raise AssertionError("times do not increase")
    profile, expected_profile = table(directory / "profile.csv"), table(reference / "profile.csv")
    for column in ("phase", "surface", "reference_r_mm", "status"):
        if [row[column] for row in profile] != [row[column] for row in expected_profile]:
            raise AssertionError(f"profile.csv differs in {column}")
    found = []
    for column in ("normal_force_N", "torque_Nmm"):
        pairs = [(float(row[column]), float(other[column])) for row, other in zip(rows, expected)]
        found.append(max(abs(a - b) for a, b in pairs) / max(abs(b) for _, b in pairs))
    return found


def contents(directory):
    return {path.name: path.read_bytes() for path in directory.iterdir()}


def ranks_of(launcher):
    """Process numbers of the ranks below mpirun."""
    children = pathlib.Path(f"/proc/{launcher}/task/{launcher}/children").read_text().split()
    name = pathlib.Path(ARGUMENTS.tribogel).name
    return [int(child) for child in children
            if pathlib.Path(f"/proc/{child}/comm").read_text().strip() == name]


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def assert_same(self, directory, reference):
        for difference in differences(self.folder / directory, self.folder / reference):
            self.assertLessEqual(difference, TOLERANCE)

    def start(self, ranks, words):
        program = subprocess.Popen(command(ranks) + words, cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        self.addCleanup(lambda: program.poll() is None and program.terminate())
        return program

    def copy(self, old, new):
        shutil.copytree(self.folder / old, self.folder / new)
        return new


def main(document, **counts):
    """Runs the tests of the calling script. `counts`: further options, each a whole number, by default
    this one."""
    global ARGUMENTS
    parser = argparse.ArgumentParser(description=document,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", required=True)
    for name, count in counts.items():
        parser.add_argument(f"--{name}", type=int, default=count)
    ARGUMENTS, rest = parser.parse_known_args()
    os.environ.pop("PETSC_OPTIONS", None)
    unittest.main(argv=sys.argv[:1] + rest)
