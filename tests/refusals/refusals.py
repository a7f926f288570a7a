#!/usr/bin/python3
"""Bad input is refused: exit status 2, one line on stderr that names the option, the value and what is
allowed, and nothing is written. What is merely odd runs, with a warning or a note.

  tests/refusals/refusals.py TRIBOGEL [--mpirun MPIRUN]

With --mpirun some refusals are repeated on two processes. Each run has a directory of its own. The page
options/README.md must be what -help markdown prints.
"""
import argparse
import concurrent.futures
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
from cases import SUBJECTS  # noqa: E402
from tribogel_tools.refusal import contents, faults_of_refusal, start  # noqa: E402

TIMEOUT = 120  # s
ALLOWED = "allowed: "


def prepare(directory):
    """What the cases expect to find."""
    for subject in SUBJECTS:
        subject.prepare(directory)


def judge_refusal(command, expected):
    """What is wrong with the refusal, as a list of lines."""
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        prepare(directory)
        before = contents(directory)
        done = start(command, directory, TIMEOUT)
        wrong = faults_of_refusal(done, before, directory)
        return wrong + [f"'{part}' is not in {done.stderr!r}" for part in [ALLOWED] + expected
                        if part not in done.stderr]


def judge_run(command, expected):
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        prepare(directory)
        done = start(command, directory, TIMEOUT)
        wrong = [f"exit status {done.returncode}, not 0: {done.stderr}"] if done.returncode != 0 else []
        wrong += [f"'{part}' is not on stdout" for part in expected if part not in done.stdout]
        if (directory / "a_run" / "remarks.txt").read_text() != "mine\n":
            wrong.append("a file that is not ours was changed")
        return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", help="launcher for two processes")
    arguments = parser.parse_args()
    # -q: without the launcher's own remark that a process has ended with a status other than 0
    commands = [("", [arguments.tribogel])]
    if arguments.mpirun:
        commands.append((" on two processes", [arguments.mpirun, "-q", "-n", "2", arguments.tribogel]))

    cases = [(name + where, judge_refusal, command + words, expected) for where, command in commands
             for subject in SUBJECTS for name, words, expected in subject.REFUSALS
             if not where or name in subject.ON_TWO_PROCESSES]
    cases += [(name, judge_run, commands[0][1] + words, expected) for subject in SUBJECTS
              for name, words, expected in subject.RUNS]
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(4) as pool:  # starting a program is three quarters waiting
        for (name, *_), wrong in zip(cases, pool.map(lambda case: case[1](*case[2:]), cases)):
            for line in wrong:
                failures += 1
                print(f"FAILED {name}: {line}")
    page = pathlib.Path(__file__).resolve().parents[2] / "options" / "README.md"
    if start([arguments.tribogel, "-help", "markdown"], page.parent, TIMEOUT).stdout != page.read_text():
        failures += 1
        print(f"FAILED page of options: {page} is not what '-help markdown' prints")
    print(f"{len(cases) + 1} cases, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
