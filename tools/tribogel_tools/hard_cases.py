"""Runs the hard cases of options/hard and says what the program does on each.

  tools/hard-cases [CASE ...] [--jobs 2] [--output hard-cases] [-- -option value ...]

A case is an options file there, or any other. The head of each says what it asks for and what is expected of
it: "# hard-case: completes", or "# hard-case: stops" for those that the program gives up in order, with
status 3, a reason and everything up to there in its files. The table is written into the output directory too
(hard-cases.md).
Status: 0 when every case did as expected, 1 when not, 2 bad input.
"""
import concurrent.futures
import pathlib
import re

from .command_line import BadInput, Parser
from .program import OPTIONS, program_of, run
from .tables import markdown

CASES = OPTIONS / "hard"
HEADER = ("case", "expected", "done", "steps", "cuts", "rejected", "Newton mean", "max", "linear", "dN/N",
          "dT/T", "energy", "CPU s")


def expectation(path):
    found = re.search(r"^# hard-case: (completes|stops)\b", path.read_text(encoding="utf-8"), re.MULTILINE)
    if not found:
        raise BadInput(f"{path}: its head must say '# hard-case: completes' or '# hard-case: stops'")
    return found.group(1)


def paths_of(names):
    paths = [path if (path := pathlib.Path(name)).is_file() else CASES / f"{name}.opts" for name in names]
    for name, path in zip(names, paths):
        if not path.is_file():
            raise BadInput(f"no case {name}; there are "
                           + ", ".join(sorted(p.stem for p in CASES.glob("*.opts"))))
    return paths or sorted(CASES.glob("*.opts"))


def ratio(part, whole):
    return f"{part / whole:.0e}" if whole else "-"


def row_of(path, ended):
    """A line of the table, whether all went as expected, and remarks."""
    expected, status, summary = expectation(path), ended.status, ended.summary()
    if not summary:
        empty = ("-",) * (len(HEADER) - 3)
        return (path.stem, expected, f"status {status}", *empty), False, [ended.failure or "no summary"]
    counts, balances = summary["counts"], summary["balances"]
    done = {0: "yes", 3: f"stops at {summary['time_s']:.5g} s"}.get(status, f"status {status}")
    steps = max(counts["accepted_steps"], 1)
    residual = balances["energy_residual_relative"]
    row = (path.stem, expected, done, counts["accepted_steps"], counts["failed_solves"],
           counts["rejected_steps"], f"{counts['newton_iterations'] / steps:.1f}",
           counts["largest_newton_iterations"], counts["linear_iterations"],
           ratio(balances["max_force_mismatch_N"], balances["max_normal_force_N"]),
           ratio(balances["max_torque_mismatch_Nmm"], balances["max_torque_Nmm"]),
           "-" if residual is None else f"{residual:.0e}", f"{summary['cost']['cpu_s']:.1f}")
    remarks = [f"{count} x {name}" for name, count in summary["failures"].items() if count]
    remarks += summary["notices"] + ([summary["reason"]] if summary["reason"] else [])
    return row, status == {"completes": 0, "stops": 3}[expected], remarks


def execute(path, program, further, output):
    return row_of(path, run(program, ["-options_file", path, *further], output / path.stem))


def main(words):
    parser = Parser("hard-cases", __doc__)
    parser.add_argument("cases", metavar="CASE", nargs="*", help="names or options files (default: all)")
    parser.add_jobs()
    parser.add_program()
    parser.add_output("tribogel-hard-cases")
    arguments = parser.parse(words)
    paths = paths_of(arguments.cases)
    for path in paths:
        expectation(path)
    program = program_of(arguments.program)
    arguments.output.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        runs = [pool.submit(execute, path, program, arguments.further, arguments.output) for path in paths]
        results = [each.result() for each in runs]
    report = markdown(HEADER, [row for row, _, _ in results], padded=True) + "\n\n"
    report += "".join(f"{row[0]}: {remark}\n" for row, _, remarks in results for remark in remarks)
    wrong = [row[0] for row, fine, _ in results if not fine]
    report += f"\nNOT as expected: {', '.join(wrong)}\n" if wrong else "\nall as expected\n"
    (arguments.output / "hard-cases.md").write_text(report, encoding="utf-8")
    print(report, end="")
    return 1 if wrong else 0
