#!/usr/bin/python3
"""What the tools share: a run that is started, timed and reported; tables; command lines. Every command in
Python refuses nonsense in one line."""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "tools"))
from tribogel_tools import command_line, program, tables  # noqa: E402

FAKE = """#!/bin/sh
printf '%s\\n' "$*"
echo "$OMP_NUM_THREADS" > threads
echo 'tribogel: error: -top_radius = 0: allowed: > 0' >&2
echo 'mpirun: a remark' >&2
exit 2
"""


class Program(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.fake = self.folder / "fake"
        self.fake.write_text(FAKE, encoding="utf-8")
        self.fake.chmod(0o755)

    def test_a_run_has_its_words_its_directory_and_the_programs_own_line(self):
        directory = self.folder / "a" / "run"
        directory.mkdir(parents=True)
        (directory / "summary.json").write_text("{}")
        ended = program.run(self.fake, ["-top_radius", 0], directory, log="program.log")
        self.assertEqual((ended.status, ended.failure), (2, "tribogel: error: -top_radius = 0: allowed: > 0"))
        self.assertEqual(ended.reason, "-top_radius = 0: allowed: > 0")
        self.assertEqual((directory / "program.log").read_text(),
                         f"-top_radius 0 -output_directory {directory} -overwrite\n")
        self.assertFalse((directory / "summary.json").exists())  # that of a run before is none of this one
        self.assertEqual(ended.summary(), {})

    def test_several_processes_are_started_by_mpirun(self):
        ended = program.run("program", ["-x"], self.folder / "run", ranks=3, mpirun=self.fake, log="log")
        self.assertRegex((self.folder / "run" / "log").read_text(), "^-n 3 program -x ")
        self.assertEqual(ended.status, 2)

    def test_the_environment_is_that_of_the_tools(self):
        done = program.start([self.fake, b"\xff"], cwd=self.folder,
                             env={"OMP_NUM_THREADS": "7", "PATH": "/usr/bin:/bin"})
        self.assertEqual((self.folder / "threads").read_text(), "1\n")
        self.assertEqual(done.stdout, "\\xff\n")

    def test_time_is_up(self):
        ended = program.Ended(self.folder, program.start(["sleep", 60], 0.2).returncode, "", 0.2)
        self.assertTrue(ended.timed_out)
        self.assertEqual(ended.failure, "stopped after 0.2 s")

    def test_a_failure_always_has_a_line(self):
        self.assertEqual(program.Ended(self.folder, 0, "a warning\n").failure, "")
        self.assertEqual(program.Ended(self.folder, 9, "one\n\ntwo\n").failure, "two")
        self.assertEqual(program.Ended(self.folder, 9, "\n").failure, "nothing said")

    def test_cpu_seconds_are_those_of_what_was_started(self):
        words = [sys.executable, "-c", "import time\nwhile time.process_time() < 0.3: pass"]
        seconds, done = program.cpu_seconds(program.start, words)
        self.assertEqual(done.returncode, 0)
        self.assertTrue(0.3 < seconds < 3, seconds)

    def test_what_is_no_program_is_refused(self):
        with self.assertRaisesRegex(command_line.BadInput, "no program nosuch"):
            program.program_of("nosuch")


class Tables(unittest.TestCase):
    def test_markdown(self):
        self.assertEqual(tables.markdown(["a", "b|c"], [[1, "x"], [22, ""]]),
                         "| a | b/c |\n|---|---|\n| 1 | x |\n| 22 |  |")
        self.assertEqual(tables.markdown(["a", "b"], [[22, "x"]], padded=True),
                         "| a  | b |\n|----|---|\n| 22 | x |")

    def test_csv_there_and_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "table.csv")
            tables.write_csv(path, ["name", "value"], [["a,b", 1.5], ["\u00bd", ""]])
            self.assertEqual(path.read_bytes(), 'name,value\n"a,b",1.5\n\u00bd,\n'.encode())
            self.assertEqual(tables.read_csv(path),
                             [{"name": "a,b", "value": "1.5"}, {"name": "\u00bd", "value": ""}])


class CommandLine(unittest.TestCase):
    def test_lists(self):
        self.assertEqual(command_line.positives("1,20"), [1, 20])
        for text in ("0", "1,", "-1", "1.5", "x", "\u00b2"):
            with self.assertRaises(argparse.ArgumentTypeError):
                command_line.positives(text)
        self.assertEqual(command_line.series_of(["Q1/P0:4,6", "Q2:2"], "--x", ("Q1/P0", "Q2")),
                         [("Q1/P0", 4), ("Q1/P0", 6), ("Q2", 2)])
        self.assertEqual(command_line.series_of([":"], "--x", ("1",)), [])
        for text in ("3:4", "1:0", "1:", "1"):
            with self.assertRaisesRegex(command_line.BadInput, "--x .*; allowed: "):
                command_line.series_of([text], "--x", ("1",))

    def test_words_behind_two_dashes_are_the_programs(self):
        parser = command_line.Parser("tool", "text")
        parser.add_jobs()
        arguments = parser.parse(["--jobs", "3", "--", "-x", "--jobs"])
        self.assertEqual((arguments.jobs, arguments.further), (3, ["-x", "--jobs"]))

    def test_every_command_refuses_nonsense_in_one_line(self):
        commands = [path for path in (REPOSITORY / "tools").iterdir()
                    if path.is_file() and "tribogel_tools" in path.read_text(encoding="utf-8")
                    and not path.suffix]
        self.assertEqual(len(commands), 12)
        for command in commands:
            done = subprocess.run([command, "--nonsense"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertTrue(done.stderr.startswith(f"{command.name}: error: "), done.stderr)


if __name__ == "__main__":
    unittest.main()
