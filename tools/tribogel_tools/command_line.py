"""What the commands share: how they read their command line, and how they say what is wrong with it."""
import argparse
import os
import pathlib
import sys

REFUSED, INTERRUPTED = 2, 130  # exit statuses


class BadInput(Exception):
    """What was asked for cannot be done; the text is the whole line for the user."""


class Parser(argparse.ArgumentParser):
    """Help is the text at the head of the command's module; what is wrong is one line."""

    def __init__(self, name, text):
        super().__init__(prog=name, description=text, formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        raise BadInput(message)

    def add_program(self):
        self.add_argument("--program",
                          help="tribogel to run (default: built for this machine in build-native)")

    def add_jobs(self, most=None):
        cores = len(os.sched_getaffinity(0))
        self.add_argument("--jobs", type=positive, default=min(most or cores, cores),
                          help="runs at a time (default: %(default)s)")

    def add_output(self, directory):
        self.add_argument("--output", type=pathlib.Path, default=pathlib.Path(directory),
                          help="directory (default: %(default)s)")

    def parse(self, words):
        """The command's own words; those behind -- are options of the program: `further`."""
        split = words.index("--") if "--" in words else len(words)
        arguments = self.parse_args(words[:split])
        arguments.further = words[split + 1:]
        return arguments


def positive(text):
    """A whole number from 1."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}; allowed: whole numbers from 1")
    return int(text)


def positives(text):
    """Whole numbers from 1, separated by commas."""
    return [positive(word) for word in text.split(",")]


def words_of(text):
    return [word for word in text.split(",") if word]


def series_of(texts, option, allowed):
    """KIND:N,N,... from each text, as pairs (kind, n); ":" alone is none."""
    found = []
    for text in [] if texts == [":"] else texts:
        kind, _, counts = text.rpartition(":")
        if kind not in allowed or not all(n.isdecimal() and int(n) > 0 for n in counts.split(",")):
            raise BadInput(f"{option} {text}; allowed: KIND:N,N,... with KIND one of {', '.join(allowed)}")
        found += [(kind, int(n)) for n in counts.split(",")]
    return found


def need_files(paths):
    """Options files must be there."""
    for path in paths:
        if not pathlib.Path(path).is_file():
            raise BadInput(f"no options file {path}")


def progress(*words):
    """A line on what is done, while tables are still to come."""
    print(*words, file=sys.stderr, flush=True)


def exit_status(name, command):
    """That of `command(words)`; what was refused is one line under the command's name."""
    try:
        return command(sys.argv[1:])
    except (BadInput, OSError) as error:
        progress(f"{name}: error: {error}")
        return REFUSED
    except KeyboardInterrupt:
        progress(f"{name}: interrupted")
        return INTERRUPTED
