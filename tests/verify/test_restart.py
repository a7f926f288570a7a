#!/usr/bin/python3
"""A run that was killed at any moment, or asked to stop, goes on with -restart and ends with the history of
the run that was left alone: no row lost, none doubled, N and T within 1e-10 of their largest values.

  test_restart.py TRIBOGEL --mpirun MPIRUN [--kills N] [--seed S] [unittest's arguments]

--kills: how many times a run on 2 ranks is killed; 20 make the study of
tests/measurements/restarts.md, to which the table printed at the end belongs.
"""
import os
import random
import shutil
import signal
import sys
import time

sys.dont_write_bytecode = True
import restarts  # noqa: E402
from restarts import SCENE, SHORT, TOLERANCE, Folder, differences, ranks_of, run, table  # noqa: E402


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
        random.seed(restarts.ARGUMENTS.seed)
        begin = time.monotonic()
        run(2, SCENE + ["-output_directory", "whole"], self.folder)
        duration = time.monotonic() - begin
        print(f"\n{'killed after':>12} {'checkpoints':>11} {'rows':>5}   dN, dT restarted on 1, 2, 3 ranks")
        for number in range(restarts.ARGUMENTS.kills):
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


if __name__ == "__main__":
    restarts.main(__doc__, kills=3, seed=20)
