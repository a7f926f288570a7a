"""Starts the program on many generated inputs, sensible ones and nonsense, and says what it did wrong.

  tools/fuzz [--cases 10000] [--first 0] [--seed 1] [--jobs 2] [--program build/tribogel]
  tools/fuzz --seed 1 --case 1234        # one of them, with its words and files

A case is options on the command line, in files, in .petscrc and in PETSC_OPTIONS. Others are files of meshes,
runs that go on after a change, and files that cannot grow. Of each it is known whether it must be refused,
must run, must be refused or run with a warning, or may do either; seed and number make a case, whatever the
others are. Wrong is: another exit status than 0, 2, 3, 4, or no end within --timeout; a trace of PETSc, MPI
or a sanitizer; a refusal that is not one line beginning "tribogel: error: ", that holds a control character,
names no option or file, or wrote something; status 3 without a reason; status 0 or 4 with anything but finite
N and T in history.csv, with a row lost, or with other options than asked for; a history that ends within a
row; another N for the same mesh in other words.
Status: 0 when nothing was wrong, 1 when something was, 2 bad input.
"""
import collections
import concurrent.futures
import json
import math
import pathlib
import random
import re
import shlex
import subprocess
import tempfile

from .. import program
from ..command_line import BadInput, Parser
from ..refusal import REFUSED, contents, faults_of_refusal, start
from ..tables import markdown, read_csv
from .cases import case_of
from .scenes import options_of

LONGEST_LINE = 4000  # characters of a refusal
TRACES = ("PETSC ERROR", "MPI_ABORT", "MPI_Abort", "mpi_abort", "Sanitizer", "runtime error",
          "terminate called", "HDF5-DIAG", "Segmentation", "Assertion", "Fatal error", "corrupt",
          "double free", "[0]", "std::")
STATUSES = {0: "complete", 2: "refused", 3: "cannot go on", 4: "stopped"}


def prepare(directory, case):
    """What the cases expect to find, and their files."""
    (directory / "a_file").write_text("mine\n")
    for run, file, text in (("a_run", "history.csv", b"an older run\n"),
                            ("a_text", "checkpoint.h5", b"not HDF5\n"),
                            ("an_hdf5", "checkpoint.h5", b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 20)):
        (directory / run).mkdir()
        (directory / run / file).write_bytes(text)
    write(directory, case.files)


def write(directory, files):
    for name, text in files.items():
        path = directory / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text(path.read_bytes()) if callable(text) else text)


def faults_of_history(directory, case, status):
    """Force and torque in each row of the history that the run has left, and whether rows are missing."""
    paths = [path for path in directory.rglob("history.csv") if path.parent.name not in ("a_run", "first")]
    if not paths:
        return ["no history.csv"] if case.room is None else []
    text = paths[0].read_text(encoding="utf-8")
    rows = read_csv(paths[0])
    wrong = [f"{name} = {row[name]} at {row['time_s']} s in history.csv" for row in rows
             for name in ("normal_force_N", "torque_Nmm") if not math.isfinite(float(row[name] or "nan"))][:1]
    if text and not text.endswith("\n"):
        wrong.append(f"history.csv ends within a row: {text[-60:]!r}")
    if status == 3:
        return wrong
    if not rows:
        return [*wrong, "no row in history.csv"]
    return wrong + faults_of_summary(paths[0].parent, case, rows)


def faults_of_summary(run, case, rows):
    """Rows that were lost, and options that are others than asked for."""
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    wrong, steps = [], summary["counts"]["accepted_steps"]
    if len(rows) != steps + 1:
        wrong.append(f"{len(rows)} rows in history.csv after {steps} steps")
    options = summary["options"]
    wrong += [f"asked for {name} = {text}, run with {options.get(name[1:])}"
              for name, text in case.asked.items()
              if text is not None and options.get(name[1:]) != text][:1]
    if case.same_as_first:
        forces = [float(row["normal_force_N"])
                  for row in (rows[-1], read_csv(run.parent / "first" / "history.csv")[-1])]
        if abs(forces[0] - forces[1]) > 1e-6 * abs(forces[1]):
            wrong.append(f"N = {forces[0]} N, and {forces[1]} N for the same mesh")
    return wrong


def faults_of_words(case, line):
    """What is wrong with the line of a refusal."""
    wrong = []
    if len(line) > LONGEST_LINE:
        wrong.append(f"a line of {len(line)} characters")
    if any(ord(c) < 32 or ord(c) == 127 for c in line):
        wrong.append(f"control characters in {line!r:.500}")
    names = case.names or (r"-\w+", ".opts", "line ")
    if not any(name in line if case.names else re.search(name, line) for name in names):
        wrong.append(f"none of {names} in {line!r:.500}")
    return wrong


def judge(case, done, before, directory):
    wrong = [f"'{trace}' on stderr" for trace in TRACES if trace in done.stderr]
    outcome = STATUSES.get(done.returncode)
    if outcome is None:
        return [*wrong, f"exit status {done.returncode}: {done.stderr[-500:]!r}"]
    if case.expected == "refused" and done.returncode != REFUSED:
        return [*wrong, f"nonsense was taken: status {done.returncode} {done.stderr[:500]!r}"]
    if case.expected == "runs" and done.returncode not in (0, 4):
        return [*wrong, f"a sensible case: status {done.returncode}, {done.stderr[:500]!r}"]
    said = [line for line in done.stdout.splitlines() if line.startswith(("warning: ", "note: "))]
    named = any(name in " ".join(said) for name in case.names)
    if case.expected == "told" and done.returncode != REFUSED and not named:
        wrong.append(f"status {done.returncode} without a word of {case.names}: {said!r:.500}")
    if done.returncode == REFUSED:
        return [*wrong, *faults_of_refusal(done, before, directory),
                *faults_of_words(case, done.stderr.rstrip("\n"))]
    if done.returncode == 3 and not (done.stderr.startswith(program.ERROR) and done.stderr.count("\n") == 1):
        wrong.append(f"status 3 without one line of reason: {done.stderr[:500]!r}")
    if done.returncode != 3 and done.stderr:
        wrong.append(f"status {done.returncode} and on stderr: {done.stderr[:500]!r}")
    if "-help" not in case.words:
        wrong += faults_of_history(directory, case, done.returncode)
    return wrong


def run_case(number, arguments, options):
    """The case, what came of it in a word, and what was wrong."""
    case = case_of(random.Random(f"{arguments.seed}/{number}"), options)
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        prepare(directory, case)
        words = [str(arguments.program), *case.words]
        try:
            if case.first:
                first = start([str(arguments.program), *case.first], directory, arguments.timeout)
                if first.returncode not in (0, 4):
                    said = f"the run before: status {first.returncode} {first.stderr[:500]!r}"
                    return case, "first failed", [said]
            write(directory, case.change)
            before = contents(directory)
            if case.room is not None:
                words = ["prlimit", f"--fsize={case.room}", "--", *words]
            done = start(words, directory, arguments.timeout, **case.variables)
        except subprocess.TimeoutExpired:
            return case, "no end", [f"no end within {arguments.timeout} s"]
        if arguments.case is not None:
            show(case, words, done)
        return case, STATUSES.get(done.returncode, "crash"), judge(case, done, before, directory)


def show(case, words, done):
    for name, text in case.files.items():
        print(f"== {name}\n{text!r:.3000}")
    print("==", *(f"{name}={value!r}" for name, value in case.variables.items()), shlex.join(words)[:3000])
    print(f"== status {done.returncode}\n{done.stderr[:3000]}", end="")


def table(counts):
    """Outcomes by expectation, as a table in Markdown."""
    outcomes = [*STATUSES.values(), "no end", "crash", "first failed"]
    rows = []
    for expected in ("runs", "refused", "told", "either"):
        row = [counts[expected, outcome] for outcome in outcomes]
        rows.append([expected, sum(row), *row])
    return markdown(["expected", "cases", *outcomes], rows)


def main(words):
    parser = Parser("fuzz", __doc__)
    add = parser.add_argument
    add("--cases", type=int, default=10000, help="how many (default: %(default)s)")
    add("--first", type=int, default=0, help="number of the first of them (default: %(default)s)")
    add("--case", type=int, help="only this one, with its words and files")
    add("--seed", type=int, default=1, help="default: %(default)s")
    parser.add_jobs()
    add("--timeout", type=float, default=120, help="seconds for a case (default: %(default)s)")
    parser.add_program()
    arguments = parser.parse_args(words)
    arguments.program = program.program_of(arguments.program)
    try:
        options = options_of(program.start([arguments.program, "-help", "markdown"]).stdout)
    except ValueError as error:
        raise BadInput(f"{arguments.program} -help markdown: {error}") from None
    numbers = range(arguments.first,
                    arguments.first + arguments.cases) if arguments.case is None else [arguments.case]
    counts, failures = collections.Counter(), 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = pool.map(lambda number: run_case(number, arguments, options), numbers)
        for number, (case, outcome, wrong) in zip(numbers, results):
            counts[case.expected, outcome] += 1
            failures += bool(wrong)
            for line in wrong:
                print(f"WRONG case {number} ({case.about}): {line}", flush=True)
    print(f"\nseed {arguments.seed}\n\n{table(counts)}\n\n{failures} wrong")
    return 1 if failures else 0
