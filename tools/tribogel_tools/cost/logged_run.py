"""One run of the program with PETSc's log: what the log and the summary say."""
import collections
import csv
import math

from ..program import cpu_seconds, run

LINEAR = ("PCSetUp", "KSPSolve")  # PETSc sets the preconditioner up before it begins to count a KSPSolve

# Times: of the slowest rank. Flops, messages and bytes: of all ranks together.
Event = collections.namedtuple("Event", "count seconds flops messages bytes reductions")
NOTHING = Event(0, 0.0, 0.0, 0.0, 0.0, 0.0)


def read_log(path):
    """Of each event that happened in a file of -log_view :FILE:ascii_csv, added up over the stages; "summary"
    is the whole run. PETSc books a message where it is sent and where it is received: halved here, as in its
    own table."""
    stages = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file, skipinitialspace=True):
            if row["Rank"] and float(row["Count"]):
                stages.setdefault((row["Stage Name"], row["Event Name"].strip()), []).append(
                    [float(row[name])
                     for name in ("Count", "Time", "FLOP", "Num Messages", "Message Length",
                                  "Num Reductions")])
    events = {}
    for (_, name), ranks in stages.items():
        count, seconds, flops, messages, length, reductions = zip(*ranks)
        here = Event(int(max(count)), max(seconds), sum(flops), sum(messages) / 2, sum(length) / 2,
                     max(reductions))
        events[name] = Event(*(a + b for a, b in zip(events.get(name, NOTHING), here)))
    return events


class LoggedRun:
    """Words of options in, numbers out. failure: "" or a line that says why there is no or half a result."""

    def __init__(self, program, words, directory, ranks=1, mpirun="mpirun", limit=None):
        log = directory / "log.csv"
        log.unlink(missing_ok=True)
        self.cpu, ended = cpu_seconds(run, program, [*words, "-log_view", f":{log}:ascii_csv"], directory,
                                      ranks=ranks,
                                      mpirun=mpirun, time_limit=limit)
        self.ranks, self.status, self.failure = ranks, ended.status, ended.reason
        self.events = read_log(log) if log.exists() else {}
        self.summary = ended.summary()
        self.counts = self.summary.get("counts", {})
        self.cost = self.summary.get("cost", {})
        self.phases = {phase["phase"]: phase for phase in self.summary.get("phases", [])}

    def event(self, name):
        return self.events.get(name, NOTHING)

    def seconds(self, *names):
        return sum(self.event(name).seconds for name in names)

    @property
    def newton(self):
        """Newton iterations, also those of failed solves, which the summary's count leaves out."""
        return self.event("SNESLineSearch").count

    @property
    def newton_seconds(self):
        return self.seconds("SNESSolve")

    @property
    def linear_seconds(self):
        """Linear solver within Newton's iterations: without the solves outside SNESSolve, taken to cost as
        much each. An inner preconditioner that is set up within an outer KSPSolve is in both of PETSc's
        times; what is no residual and no Jacobian bounds the sum."""
        solves = self.event("KSPSolve").count
        if not solves:
            return 0.0
        bound = self.newton_seconds - self.seconds("SNESFunctionEval", "SNESJacobianEval")
        return min(self.seconds(*LINEAR) * min(1, self.newton / solves), max(bound, 0.0))

    @property
    def rest_of_newton(self):
        """The part of Newton's iterations that is not the linear solver."""
        if not self.newton_seconds:
            return math.nan
        return max(0.0, 1 - self.linear_seconds / self.newton_seconds)


def best_of(repeats, start):
    """The cheapest of the runs that got farthest."""
    return min((start() for _ in range(repeats)), key=lambda run: (run.status, run.cpu))
