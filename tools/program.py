"""The program that the tools run: built for this machine when needed, in the environment of tools/environment."""
import pathlib
import resource
import subprocess

TOOLS = pathlib.Path(__file__).resolve().parent
NATIVE = ("-DCMAKE_BUILD_TYPE=Release", "-DTRIBOGEL_NATIVE=ON", "-DTRIBOGEL_TESTS=OFF")  # as tools/run


class CannotBuild(Exception):
    """There is no program to run."""


def in_environment(command, *arguments, **how):
    """Runs a line of bash that has sourced tools/environment. Not replaced by the program it starts: Linux hands the
    memory peak of a process on to what replaces it, and that of a tool is larger than a small run's."""
    return subprocess.run(["bash", "-uc", f'. "$0"; {command}; exit $?', str(TOOLS / "environment"), *arguments],
                          check=False, **how)


def cpu_seconds(run, *words, **how):
    """User and system time of the processes that a function starts and waits for, and what it returns."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = run(*words, **how)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, result


def program_of(given):
    """Path of the program, built unless it is given."""
    if not given:
        if subprocess.run([TOOLS / "install"], check=False).returncode:
            raise CannotBuild("packages are missing")
        if in_environment('build build-native tribogel "$@" >&2', *NATIVE).returncode:
            raise CannotBuild("the program does not build")
    return pathlib.Path(given or TOOLS.parent / "build-native" / "tribogel").resolve()
