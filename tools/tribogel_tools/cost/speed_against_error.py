"""CPU seconds against true error in N and T: model x element order x elements x integrator x step tolerance x
solver.

  tools/speed-against-error [OPTIONS_FILE] [--orders 1,2] [--elements 4,6,8,12,16]
                            [--tolerances 1,0.3,0.1,0.03] [--integrators sdirk2,exponential_euler]
                            [--solid 1:4,6,8 --solid 2:2,3,4] [--solvers FILE ...]
                            [--peers compare-peers.csv] [-- -option value ...]

The scene is that of OPTIONS_FILE (default: the paper's, options/paper/fig06.opts). Every combination of the
first four runs with the axisymmetric model, whole schedule; --solid ORDER:N,... are runs in space, which
solve the steady states of the same schedule (-schedule_kind steady; none: --solid :). Each run is made once
for each options file of --solvers too. One run after the other, on one core; CPU seconds are user and system
time of the whole process.

Errors, in per cent: of N and of T at the ends of the phases (the largest, of N or T in the reference at that
end), and of N(t) and T(t) at every accepted step (of the largest N and T). The reference is the axisymmetric
model, order 2, with --reference-elements and --reference-tolerance; what it lacks itself is not in the
errors, so nothing below a few times its own tolerance means anything. --peers adds the rows of
tools/compare-peers, another scene, as a second picture.

Writes speed-against-error.csv, .md (the runs that none beats in both cost and error), .png and .pdf below
--output.
Status: 0, 1 when a run did not complete (the others are drawn), 2 bad input.
"""
import itertools
import pathlib

import matplotlib.pyplot as plt

from .. import plot
from ..command_line import BadInput, Parser, need_files, progress, series_of, words_of
from ..program import OPTIONS, cpu_seconds, program_of, run
from ..tables import markdown, read_csv, write_csv
from .speed import FORCE, TORQUE, course_of, error_of, front, largest_difference

COLUMNS = ("model", "order", "elements", "integrator", "tolerance_per_cent", "solver", "unknowns", "steps",
           "newton_iterations", "cpu_s", "memory_MB", "error_N_ends_per_cent", "error_T_ends_per_cent",
           "error_N_throughout_per_cent", "error_T_throughout_per_cent", "failure")


class Study:
    def __init__(self, arguments, program):
        self.a, self.program, self.rows = arguments, program, []

    def solve(self, name, words):
        """CPU seconds of a run, and the run."""
        words = ["-options_file", self.a.options_file, *words, *self.a.further]
        return cpu_seconds(run, self.program, words, self.a.output / "runs" / name)

    def reference(self):
        words = ["-model", "axisymmetric", "-element_order", "2", "-elements_radial",
                 str(self.a.reference_elements),
                 "-time_tolerance", str(self.a.reference_tolerance)]
        cpu, ended = self.solve("reference", words)
        if ended.status:
            raise BadInput(f"the reference does not complete: {ended.failure}")
        progress(f"reference: {cpu:.0f} CPU s")
        self.ends, self.course = ended.summary()["phases"], course_of(ended.directory)

    def run(self, model, order, elements, integrator, tolerance, solver):
        words = ["-model", model, "-element_order", order, "-elements_radial", str(elements)]
        if model == "solid":
            words += ["-schedule_kind", "steady", "-mesh_grading", "1"]
        else:
            words += ["-maxwell_integrator", integrator, "-time_tolerance", tolerance]
        if solver:
            words += ["-options_file", solver]
        name = "-".join(word for word in (model, order, str(elements), integrator, tolerance,
                                          pathlib.Path(solver).stem) if word)
        cpu, ended = self.solve(name, words)
        row = dict.fromkeys(COLUMNS, "") | {"model": model, "order": order, "elements": elements,
                                            "integrator": integrator,
                                            "tolerance_per_cent": tolerance,
                                            "solver": pathlib.Path(solver).stem,
                                            "cpu_s": f"{cpu:.2f}", "failure": ended.failure}
        if not ended.status:
            summary = ended.summary()
            counts = summary["counts"]
            row |= {"unknowns": counts["unknowns"], "steps": counts["accepted_steps"],
                    "newton_iterations": counts["newton_iterations"],
                    "memory_MB": f"{summary['cost']['peak_memory_MB']:.0f}"}
            row |= self.errors(summary["phases"], ended.directory, model == "axisymmetric")
        self.rows.append(row)
        progress(*(row[name] for name in COLUMNS))

    def errors(self, own, directory, throughout):
        found = {}
        for letter, name in (("N", FORCE), ("T", TORQUE)):
            differences = [abs(end[name] / exact[name] - 1) for end, exact in zip(own, self.ends)
                           if abs(exact[name]) > 1e-6 * max(abs(other[name]) for other in self.ends)]
            # The ends of phases without steady state (at rest, or too short) are not those of a steady
            # schedule.
            error = max(differences) if throughout else differences[-1]
            found[f"error_{letter}_ends_per_cent"] = f"{100 * error:.5f}"
            if throughout:
                error = largest_difference(course_of(directory), self.course, name)
                found[f"error_{letter}_throughout_per_cent"] = f"{100 * error:.5f}"
        return found


def table(rows):
    names = [name for name in COLUMNS if name != "failure"]
    return markdown([name.replace("_", " ") for name in names],
                    [[row[name] for name in names] for row in rows])


def families(rows):
    chosen = {}
    for row in rows:
        if row["failure"]:
            continue
        label = f"{row['model']}, order {row['order']}" + (f", {row['integrator']}" if row["integrator"]
                                                           else "")
        label += f", {row['solver']}" if row["solver"] else ""
        chosen.setdefault(label, []).append(row)
    return chosen


def draw(study, peers):
    figure, axes = plt.subplots(1, 3 if peers else 2, figsize=(15 if peers else 11, 5), squeeze=False,
                                layout="constrained")
    for marker, (label, rows) in zip(itertools.cycle("osD^vPX*"), families(study.rows).items()):
        axes[0][0].loglog([error_of(r) for r in rows], [float(r["cpu_s"]) for r in rows], marker, ms=5,
                          alpha=0.7, label=label)
        timed = [r for r in rows if r["error_N_throughout_per_cent"]]
        if timed:
            axes[0][1].loglog([float(r["error_N_throughout_per_cent"]) for r in timed],
                              [float(r["cpu_s"]) for r in timed], marker,
                              ms=5, alpha=0.7, label=label)
    for model in dict.fromkeys(row["model"] for row in study.rows):
        best = [row for row in front(study.rows) if row["model"] == model]
        axes[0][0].step([error_of(r) for r in best], [float(r["cpu_s"]) for r in best], "k-", lw=0.8,
                        where="post")
    axes[0][0].set_xlabel("error of N and T at the phases' ends, the larger one (%)")
    axes[0][1].set_xlabel("error of N(t) at any time (% of the largest N)")
    axes[0][0].set_title("phase ends; line: what none beats", fontsize=10)
    axes[0][1].set_title("the whole transient", fontsize=10)
    if peers:
        chosen = {}
        for row in peers:
            chosen.setdefault(f"{row['program']} {row['element']}, K/G {row['K/G']}", []).append(row)
        for marker, (label, rows) in zip(itertools.cycle("osD^vPX*"), chosen.items()):
            axes[0][2].loglog([max(abs(float(r["error N [%]"])), abs(float(r["error T [%]"]))) for r in rows],
                              [float(r["CPU s"]) for r in rows], marker + "-", ms=5, lw=0.6, label=label)
        axes[0][2].set_xlabel("error of N and T, the larger one (%)")
        axes[0][2].set_title("two cylinders in space, with other programs", fontsize=10)
    for each in axes[0]:
        each.set_ylabel("CPU seconds, one core")
        each.grid(which="both", lw=0.3)
        each.legend(fontsize=7, framealpha=0.6)
    plot.save(figure, study.a.output / "speed-against-error", dpi=120)


def peers_of(path):
    if not path:
        return []
    return [row for row in read_csv(path) if row["error N [%]"] not in ("-", "")
            and row["completed"] == "yes"]


def parse(words):
    parser = Parser("speed-against-error", __doc__)
    add = parser.add_argument
    add("options_file", nargs="?", default=OPTIONS / "paper" / "fig06.opts", type=pathlib.Path)
    add("--orders", type=words_of, default=["1", "2"])
    add("--elements", type=words_of, default=["4", "6", "8", "12", "16"], help="along the top radius")
    add("--tolerances", type=words_of, default=["1", "0.3", "0.1", "0.03"], help="-time_tolerance, per cent")
    add("--integrators", type=words_of, default=["sdirk2", "exponential_euler"])
    add("--solid", action="append", metavar="ORDER:N,...", help="default: 1:4,6,8 and 2:2,3,4; none: :")
    add("--solvers", nargs="+", default=[""], metavar="FILE",
        help="options files of solvers, such as options/solver/*.opts")
    add("--peers", metavar="CSV", help="compare-peers.csv")
    add("--reference-elements", type=int, default=32, help="default: %(default)s")
    add("--reference-tolerance", type=float, default=0.003, help="per cent (default: %(default)s)")
    parser.add_program()
    parser.add_output("tribogel-speed")
    a = parser.parse(words)
    a.output = a.output.resolve()
    need_files([a.options_file])
    a.solid = series_of(a.solid or ["1:4,6,8", "2:2,3,4"], "--solid", ("1", "2"))
    for name, allowed in (("orders", ("1", "2")), ("integrators", ("sdirk2", "exponential_euler"))):
        for word in getattr(a, name):
            if word not in allowed:
                raise BadInput(f"--{name} {word}; allowed: {', '.join(allowed)}")
    return a


def main(words):
    a = parse(words)
    peers = peers_of(a.peers)
    study = Study(a, program_of(a.program))
    a.output.mkdir(parents=True, exist_ok=True)
    study.reference()
    for case in itertools.product(a.orders, a.elements, a.integrators, a.tolerances, a.solvers):
        study.run("axisymmetric", *case)
    for (order, elements), solver in itertools.product(a.solid, a.solvers):
        study.run("solid", order, elements, "", "", solver)
    write_csv(a.output / "speed-against-error.csv", COLUMNS,
              [[row[name] for name in COLUMNS] for row in study.rows])
    text = table(front(study.rows))
    (a.output / "speed-against-error.md").write_text(text + "\n", encoding="utf-8")
    print(text)
    draw(study, peers)
    failed = [row for row in study.rows if row["failure"]]
    for row in failed:
        progress(f"speed-against-error: {row['model']} {row['order']}:{row['elements']}: {row['failure']}")
    return 1 if failed else 0
