"""The program that the tools run: built for this machine when needed, and started in the environment of
tools/environment. Every tool starts it here."""
import dataclasses
import json
import pathlib
import resource
import subprocess

from .command_line import BadInput

TOOLS = pathlib.Path(__file__).resolve().parents[1]
OPTIONS = TOOLS.parent / "options"
NATIVE = ("-DCMAKE_BUILD_TYPE=Release", "-DTRIBOGEL_NATIVE=ON", "-DTRIBOGEL_TESTS=OFF")  # as tools/run
ERROR = "tribogel: error: "  # begins the program's line when it refuses or gives up
TIME_IS_UP = (124, 137)  # statuses of timeout(1)
PATIENCE = 10  # s, from the signal that ends a run to the one that kills it


class RunFailed(Exception):
    """A run that had to complete did not; the text says which and why."""


def in_environment(command, *arguments, **how):
    """Runs a line of bash that has sourced tools/environment. Not replaced by the program it starts: Linux
    hands the memory peak of a process on to what replaces it, and that of a tool is larger than a small
    run's."""
    return subprocess.run(["bash", "-uc", f'. "$0"; {command}; exit $?', str(TOOLS / "environment"),
                           *arguments],
                          check=False, **how)


def install(*packages):
    """Whether tools/install found or brought all."""
    return subprocess.run([TOOLS / "install", *packages], check=False).returncode == 0


def built(target, *options):
    """Path of a program made in build-native."""
    if in_environment('build build-native "$@" >&2', target, *NATIVE, *options).returncode:
        raise BadInput(f"{target} does not build")
    return TOOLS.parent / "build-native" / target


def program_of(given):
    """Path of the program, built unless it is given."""
    if not given:
        if not install():
            raise BadInput("packages are missing")
        return built("tribogel")
    path = pathlib.Path(given).resolve()
    if not path.is_file():
        raise BadInput(f"no program {given}")
    return path


def start(command, time_limit=None, stdout=subprocess.PIPE, **how):
    """Starts the words of a command and waits for it: a CompletedProcess. time_limit: wall seconds, after
    which it ends with one of TIME_IS_UP."""
    limit = ["timeout", f"--kill-after={PATIENCE}", str(time_limit)] if time_limit else []
    words = [word if isinstance(word, bytes) else str(word) for word in (*limit, *command)]
    return in_environment('"$@"', *words, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE,
                          text=True, errors="backslashreplace", **how)


@dataclasses.dataclass
class Ended:
    """A run that has ended."""
    directory: pathlib.Path
    status: int
    stderr: str
    time_limit: float | None = None

    @property
    def timed_out(self):
        return self.time_limit is not None and self.status in TIME_IS_UP

    @property
    def failure(self):
        """Nothing for a run that completed, else the program's own line."""
        if not self.status:
            return ""
        if self.timed_out:
            return f"stopped after {self.time_limit:g} s"
        lines = [line.strip() for line in self.stderr.splitlines() if line.strip()]
        own = [line for line in lines if line.startswith(ERROR)]
        return (own or lines or ["nothing said"])[-1]

    @property
    def reason(self):
        """The same without the program's name."""
        return self.failure.removeprefix(ERROR)

    def summary(self):
        """summary.json; of a run that did not complete what it got to, {} when there is none to read."""
        try:
            return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}


def options_files(paths):
    """The words that name options files, in their order."""
    return [word for path in paths for word in ("-options_file", path)]


def run(program, words, directory, *, ranks=1, mpirun="mpirun", time_limit=None, log=None):
    """One run with these words of options into a directory, whose summary.json of before is removed. log:
    name of a file there for what the program prints."""
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "summary.json").unlink(missing_ok=True)
    command = [mpirun, "-n", ranks] if ranks > 1 else []
    command += [program, *words, "-output_directory", directory, "-overwrite"]
    if log:
        with open(directory / log, "w", encoding="utf-8") as file:
            done = start(command, time_limit, file)
    else:
        done = start(command, time_limit, subprocess.DEVNULL)
    return Ended(directory, done.returncode, done.stderr, time_limit)


def cpu_seconds(function, *words, **how):
    """User and system time of the processes that a function starts and waits for, and what it returns."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = function(*words, **how)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, result
