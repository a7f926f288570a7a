"""What tools/fuzz and tests/refusals share: a start of the program in a directory of its own, and what makes
a refusal."""
import os
import subprocess
import tempfile

from . import program
from .program import ERROR

REFUSED = 2  # exit status of the program


def contents(directory):
    """Names and contents of all that is there."""
    return {str(path.relative_to(directory)): path.read_bytes() if path.is_file() else None
            for path in directory.rglob("*")}


def start(command, directory, time_limit, **variables):
    """Runs the command there, with no options from the user's environment or home but those given. Open MPI
    gets a place of its own for its files: of two programs that start and end at a time one may remove the
    other's."""
    environment = {name: value for name, value in os.environ.items() if name != "PETSC_OPTIONS"}
    with tempfile.TemporaryDirectory() as scratch:
        environment.update(variables, HOME=str(directory), TMPDIR=scratch)
        done = program.start(command, time_limit, cwd=directory, env=environment)
    if done.returncode in program.TIME_IS_UP:
        raise subprocess.TimeoutExpired(command, time_limit)
    return done


def faults_of_refusal(done, before, directory):
    """What is wrong with a refusal, as a list of lines: its status, its one line, or something that it
    wrote."""
    wrong = []
    if done.returncode != REFUSED:
        wrong.append(f"exit status {done.returncode}, not {REFUSED}")
    if done.stderr.count("\n") != 1 or not done.stderr.startswith(ERROR) or not done.stderr.endswith("\n"):
        wrong.append(f"stderr is not one line that begins with '{ERROR}': {done.stderr!r}")
    if contents(directory) != before:
        wrong.append("files were written, changed or removed")
    return wrong
