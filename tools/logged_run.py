"""One run of the program with PETSc's log: what the log and the summary say."""
import collections
import csv
import json
import subprocess

from program import cpu_seconds, in_environment

LINEAR = ("PCSetUp", "KSPSolve")  # PETSc sets the preconditioner up before it begins to count a KSPSolve

# Times: of the slowest rank. Flops, messages and bytes: of all ranks together.
Event = collections.namedtuple("Event", "count seconds flops messages bytes reductions")
NOTHING = Event(0, 0.0, 0.0, 0.0, 0.0, 0.0)


def read_log(path):
    """Of each event that happened in a file of -log_view :FILE:ascii_csv, added up over the stages; "summary" is the whole run.
    PETSc books a message where it is sent and where it is received: halved here, as in its own table."""
    stages = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file, skipinitialspace=True):
            if row["Rank"] and float(row["Count"]):
                stages.setdefault((row["Stage Name"], row["Event Name"].strip()), []).append(
                    [float(row[name]) for name in ("Count", "Time", "FLOP", "Num Messages", "Message Length", "Num Reductions")])
    events = {}
    for (_, name), ranks in stages.items():
        count, seconds, flops, messages, length, reductions = zip(*ranks)
        here = Event(int(max(count)), max(seconds), sum(flops), sum(messages) / 2, sum(length) / 2, max(reductions))
        events[name] = Event(*(a + b for a, b in zip(events.get(name, NOTHING), here)))
    return events


class Run:
    """Words of options in, numbers out. failure: "" or a line that says why there is no or half a result."""

    def __init__(self, program, words, directory, ranks=1, mpirun="mpirun", limit=None):
        directory.mkdir(parents=True, exist_ok=True)
        log = directory / "log.csv"
        for stale in (log, directory / "summary.json"):
            stale.unlink(missing_ok=True)
        command = ["timeout", "--kill-after=10", str(limit)] if limit else []
        command += [mpirun, "-n", str(ranks)] if ranks > 1 else []
        command += [program, *words, "-output_directory", directory, "-overwrite", "-log_view", f":{log}:ascii_csv"]
        self.cpu, done = cpu_seconds(in_environment, '"$@"', *map(str, command), stdout=subprocess.DEVNULL,
                                     stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace")
        self.ranks, self.status = ranks, done.returncode
        self.failure = self.reason_of(done, limit)
        self.events = read_log(log) if log.exists() else {}
        path = directory / "summary.json"
        self.summary = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        self.counts = self.summary.get("counts", {})
        self.cost = self.summary.get("cost", {})
        self.phases = {phase["phase"]: phase for phase in self.summary.get("phases", [])}

    @staticmethod
    def reason_of(done, limit):
        if not done.returncode:
            return ""
        if limit and done.returncode in (124, 137):
            return f"stopped after {limit:g} s"
        lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        own = [line for line in lines if line.startswith("tribogel: error")]
        return (own or lines or [f"status {done.returncode}"])[-1].removeprefix("tribogel: error: ")

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
        """Linear solver within Newton's iterations: without the solves outside SNESSolve, taken to cost as much each. An inner
        preconditioner that is set up within an outer KSPSolve is in both of PETSc's times; what is no residual and no Jacobian bounds
        the sum."""
        solves = self.event("KSPSolve").count
        if not solves:
            return 0.0
        bound = self.newton_seconds - self.seconds("SNESFunctionEval", "SNESJacobianEval")
        return min(self.seconds(*LINEAR) * min(1, self.newton / solves), max(bound, 0.0))

    @property
    def rest_of_newton(self):
        """The part of Newton's iterations that is not the linear solver."""
        return max(0.0, 1 - self.linear_seconds / self.newton_seconds) if self.newton_seconds else float("nan")


def table(names, rows):
    """Markdown."""
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    return "\n".join(lines + ["| " + " | ".join(str(cell).replace("|", "/") for cell in row) + " |" for row in rows])
