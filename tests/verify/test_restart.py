#!/usr/bin/python3
"""A run that was killed at any moment, or asked to stop, goes on with -restart and ends with the history of
the run that was left alone: no row lost, none doubled, N and T within 1e-10 of their largest values. What is
no checkpoint, or another scene, is refused in one line and nothing is changed.

  test_restart.py TRIBOGEL --mpirun MPIRUN [--kills N] [--seed S] [unittest's arguments]

--kills: how many times a run on 2 ranks is killed; 20 make the study of
tests/measurements/restarts.md, to which the table printed at the end belongs.
"""
import argparse
import csv
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
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


class Killed(Folder):
    def kill(self, name, every, longest, whole):
        """SIGKILL at some moment to all ranks, or to one, and mpirun then ends the others. Returns the
        moment."""
        while True:
            delay = random.uniform(0, longest)
            launcher = self.start(2, SCENE + ["-checkpoint_every", every, "-output_directory", name])
            time.sleep(delay)
            try:
                victims = ranks_of(launcher.pid)
                for victim in victims if whole else random.sample(victims, min(1, len(victims))):
                    os.kill(victim, signal.SIGKILL)
            except (FileNotFoundError, ProcessLookupError):
                pass
            try:
                status = launcher.wait(timeout=30)
            # mpirun does not see the end of ranks that die before they greet it
            except subprocess.TimeoutExpired:
                for left in ranks_of(launcher.pid) + [launcher.pid]:
                    os.kill(left, signal.SIGKILL)
                status = launcher.wait(timeout=30)
            if status != 0:
                return delay
            shutil.rmtree(self.folder / name)  # it was faster: that was no kill
            longest = delay

    def test_at_random_moments(self):
        random.seed(ARGUMENTS.seed)
        begin = time.monotonic()
        run(2, SCENE + ["-output_directory", "whole"], self.folder)
        duration = time.monotonic() - begin
        print(f"\n{'killed after':>12} {'checkpoints':>11} {'rows':>5}   dN, dT restarted on 1, 2, 3 ranks")
        for number in range(ARGUMENTS.kills):
            every = ("0", "0.1", "600")[number % 3]
            name = f"killed{number}"
            delay = self.kill(name, every, duration, number % 2 == 0)
            directory = self.folder / name
            rows = len((directory / "history.csv").read_text().splitlines()) - 1 if directory.exists() else 0
            found = self.restart(name)
            print(f"{delay:>10.2f} s {every:>9} s {rows:>5} {found}", flush=True)

    def restart(self, name):
        """On 1, 2 and 3 ranks, each from a copy."""
        if not (self.folder / name / "checkpoint.h5").exists():
            self.assertFalse((self.folder / name / "history.csv").exists() and
                             len(table(self.folder / name / "history.csv")) > 1)
            done = run(1, ["-restart", name], self.folder, 2)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            return "   before the first step, no checkpoint yet: refused"
        text = ""
        for ranks in (1, 2, 3):
            directory = self.copy(name, f"{name}_{ranks}")
            run(ranks, ["-restart", directory], self.folder)
            found = differences(self.folder / directory, self.folder / "whole")
            self.assertLessEqual(max(found), TOLERANCE)
            text += f"   {found[0]:.1e} {found[1]:.1e}"
        return text


class Stopped(Folder):
    def wait_for_rows(self, name, count):
        path = self.folder / name / "history.csv"
        for _ in range(3000):
            if path.exists() and path.read_bytes().count(b"\n") > count:
                return
            time.sleep(0.01)
        raise AssertionError(f"no {count} rows in {path}")

    def test_by_signals(self):
        run(1, SCENE + ["-output_directory", "whole"], self.folder)
        for ranks, sent in ((1, signal.SIGUSR1), (1, signal.SIGTERM), (1, signal.SIGINT),
                            (2, signal.SIGUSR1)):
            with self.subTest(ranks=ranks, signal=sent.name):
                name = f"{sent.name}{ranks}"
                program = self.start(ranks, SCENE + ["-output_directory", name, "-checkpoint_every", "0"])
                self.wait_for_rows(name, 5)
                program.send_signal(sent)  # mpirun hands SIGUSR1 on
                self.assertEqual(program.wait(timeout=60), 4)
                rows = len(table(self.folder / name / "history.csv"))
                self.assertLess(rows, len(table(self.folder / "whole" / "history.csv")))
                self.assertIn(f"stopped by {sent.name}", (self.folder / name / "summary.json").read_text())
                run(3 - ranks, ["-restart", name], self.folder)
                self.assert_same(name, "whole")

    def test_one_signalled_rank_stops_all(self):
        program = self.start(2, SCENE + ["-output_directory", "run", "-checkpoint_every", "0"])
        self.wait_for_rows("run", 5)
        os.kill(ranks_of(program.pid)[1], signal.SIGUSR1)
        self.assertEqual(program.wait(timeout=60), 4)

    def test_each_step_by_a_program_of_its_own(self):
        """No time is enough for a second step; the last program finds nothing left to do."""
        run(1, SHORT + ["-output_directory", "whole"], self.folder)
        steps = len(table(self.folder / "whole" / "history.csv")) - 1
        self.assertEqual(steps, 10)
        run(1, SHORT + ["-output_directory", "pieces", "-wall_time", "1e-6"], self.folder, 4)
        self.copy("pieces", "ranks")
        for step in range(2, steps + 1):
            last = step == steps
            run(1, ["-restart", "pieces"], self.folder, 0 if last else 4)
            run(1 + step % 3, ["-restart", "ranks"], self.folder, 0 if last else 4)
        for name in ("history.csv", "profile.csv"):
            self.assertEqual((self.folder / "pieces" / name).read_bytes(),
                             (self.folder / "whole" / name).read_bytes())
        self.assert_same("ranks", "whole")
        before = (self.folder / "pieces" / "history.csv").read_bytes()
        self.assertIn("complete", run(1, ["-restart", "pieces"], self.folder).stdout)
        self.assertEqual((self.folder / "pieces" / "history.csv").read_bytes(), before)

    def test_by_a_step_that_fails(self):
        """Status 3 leaves the last good state; with what it lacked the run goes on from there."""
        run(1, SHORT + ["-output_directory", "whole"], self.folder)
        run(1, SHORT + ["-output_directory", "failed", "-wall_time", "1e-6"], self.folder, 4)
        run(1, ["-restart", "failed"], self.folder, 4)
        rows = table(self.folder / "failed" / "history.csv")
        strict = ["-snes_max_it", "1", "-snes_rtol", "1e-15", "-ts_max_reject", "2"]
        done = run(1, ["-restart", "failed"] + strict, self.folder, 3)
        self.assertIn("-ts_max_reject reached at t = 6 s", done.stderr)
        self.assertEqual(table(self.folder / "failed" / "history.csv"), rows)
        lax = ["-snes_max_it", "25", "-snes_rtol", "1e-7", "-ts_max_reject", "20", "-wall_time", "1e3"]
        run(1, ["-restart", "failed"] + lax, self.folder)
        self.assertEqual((self.folder / "failed" / "history.csv").read_bytes(),
                         (self.folder / "whole" / "history.csv").read_bytes())

    def test_by_the_number_of_steps(self):
        run(1, SHORT + ["-output_directory", "whole"], self.folder)
        done = run(1, SHORT + ["-output_directory", "run", "-ts_max_steps", "5"], self.folder, 3)
        self.assertIn("-ts_max_steps", done.stderr)
        run(1, ["-restart", "run", "-ts_max_steps", "7"], self.folder, 3)
        run(1, ["-restart", "run"], self.folder)  # the limit was of the starts before
        self.assert_same("run", "whole")


class Refused(Folder):
    def setUp(self):
        super().setUp()
        run(1, SHORT + ["-output_directory", "run", "-wall_time", "1e-6"], self.folder, 4)

    def refuses(self, words, *parts, ranks=1):
        before = contents(self.folder / "run")
        done = run(ranks, words, self.folder, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tribogel: error: "), done.stderr)
        for part in parts + ("allowed: ",):
            self.assertIn(part, done.stderr)
        self.assertEqual(contents(self.folder / "run"), before)

    def test_what_is_no_checkpoint(self):
        self.refuses(["-restart", "nowhere"], "-restart = nowhere", "does not exist")
        self.refuses(["-restart"], "-restart", "value missing")
        path = self.folder / "run" / "checkpoint.h5"
        whole = path.read_bytes()
        path.write_bytes(whole[:len(whole) // 2])
        for ranks in (1, 2):
            self.refuses(["-restart", "run"], "-restart = run", "no whole HDF5 file", ranks=ranks)
        path.write_text("not HDF5\n")
        self.refuses(["-restart", "run"], "no whole HDF5 file")
        import h5py
        with h5py.File(path, "w") as file:
            file["U"] = [1.0, 2.0]
        self.refuses(["-restart", "run"], "is no checkpoint of tribogel")

    def test_another_scene(self):
        for name, value, stored in (("-top_height", "4.5", "4.4"),
                                    ("-friction_coefficients", "0,1e-3", "0,8e-4"),
                                    ("-element_order", "2", "1"), ("-schedule_rates", "0,0.2", "0,0.1"),
                                    ("-plate_contact", "false", "true")):
            self.refuses(["-restart", "run", name, value], f"{name} = {value}", f"run has {stored}")
        self.refuses(["-restart", "run", "-schedule_twists", "0,2"],
                     "-schedule_twists = 0,2: the run in run has none")
        self.refuses(["-restart", "run", "-overwrite"], "-overwrite")
        self.refuses(["-restart", "run", "-output_directory", "other"], "-output_directory = other")
        self.refuses(SHORT + ["-output_directory", "run"], "-output_directory = run", "holds a run")

    def test_files_that_have_lost_rows(self):
        path = self.folder / "run" / "history.csv"
        path.write_bytes(path.read_bytes()[:-10])
        self.refuses(["-restart", "run"], "history.csv is shorter")

    def test_files_of_other_columns(self):
        path = self.folder / "run" / "profile.csv"
        path.write_text(path.read_text().replace("mu,status", "status,mu", 1))
        self.refuses(["-restart", "run"], "profile.csv has other columns")

    def test_but_not_the_same_scene_again_nor_another_solver(self):
        words = SHORT + ["-top_height", "4.40", "-output_directory", "run/", "-snes_rtol", "1e-9",
                         "-wall_time", "1e3"]
        run(1, words + ["-restart", "run"], self.folder)
        self.assertIn('"snes_rtol": "1e-9"', (self.folder / "run" / "summary.json").read_text())


class MeshFile(Folder):
    """The mesh of the file goes with the run, under whatever path."""
    BRIEF = ["-model", "solid", "-element_order", "1", "-plate_contact", "false", "-top_material",
             "hyperelastic", "-bottom_material", "hyperelastic", "-friction_coefficients", "0.1",
             "-friction_exponents", "0", "-schedule_end_times", "1", "-schedule_approach", "0.1",
             "-schedule_rates", "0", "-ts_adapt_type", "none", "-ts_dt", "0.5"]

    def setUp(self):
        super().setUp()
        made = subprocess.run([REPOSITORY / "tools" / "specimen-mesh", "square", "--elements", "1",
                               "--bottom-radius", "14"],
                              capture_output=True, text=True, check=True)
        self.first = made.stdout
        for name in ("start", "elsewhere"):
            (self.folder / name).mkdir()
        (self.folder / "start" / "mesh.msh").write_text(self.first)
        run(1, self.BRIEF + ["-mesh_file", "mesh.msh", "-output_directory", "../run", "-wall_time", "1e-6"],
            self.folder / "start", 4)

    def moved(self, node, z):
        """The mesh with a node at another height."""
        head, tail = self.first.split("$Nodes\n")
        old = next(line for line in tail.splitlines() if line.startswith(f"{node} "))
        return head + "$Nodes\n" + tail.replace(old, " ".join(old.split()[:3] + [z]), 1)

    def reversed(self):
        """The mesh with its elements in the opposite order."""
        head, tail = self.first.split("$Elements\n")
        count, *elements, end = tail.splitlines()
        return "\n".join([head + "$Elements", count] + elements[::-1] + [end]) + "\n"

    def refuses(self, ranks, words, *parts):
        before = contents(self.folder / "run")
        done = run(ranks, words, self.folder, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tribogel: error: -mesh_file = "), done.stderr)
        for part in parts + ("allowed: ",):
            self.assertIn(part, done.stderr)
        self.assertEqual(contents(self.folder / "run"), before)

    def test_another_mesh_is_refused(self):
        path = self.folder / "start" / "mesh.msh"
        for ranks, text in ((1, self.moved(14, "-1.9")), (2, self.reversed()), (1, self.moved(19, "-0.5"))):
            path.write_text(text)
            self.refuses(ranks, ["-restart", "run"], "mesh.msh: the mesh is not that of the run in run",
                         "the same mesh")
        path.unlink()
        self.refuses(1, ["-restart", "run"], "mesh.msh: does not exist", "-mesh_file with the path")
        self.refuses(1, ["-restart", "run", "-mesh_file", "mesh.msh"],
                     "-mesh_file = mesh.msh: does not exist")

    def test_the_same_mesh_is_taken(self):
        run(2, ["-restart", "../run", "-wall_time", "1e3"], self.folder / "elsewhere")
        shutil.rmtree(self.folder / "run")
        run(1, self.BRIEF
            + ["-mesh_file", "start/mesh.msh", "-output_directory", "run", "-wall_time", "1e-6"],
            self.folder, 4)
        (self.folder / "start" / "mesh.msh").rename(self.folder / "elsewhere" / "gel.msh")
        run(1, ["-restart", "../run", "-mesh_file", "gel.msh", "-wall_time", "1e3"],
            self.folder / "elsewhere")


def main():
    global ARGUMENTS
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", required=True)
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=20)
    ARGUMENTS, rest = parser.parse_known_args()
    os.environ.pop("PETSC_OPTIONS", None)
    unittest.main(argv=sys.argv[:1] + rest)


if __name__ == "__main__":
    main()
