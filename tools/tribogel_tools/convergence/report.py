"""Tables, CSV files and the picture of a refinement study, for tools/convergence."""
import math

import matplotlib.pyplot as plt
import numpy as np

from .. import extrapolate, plot
from ..tables import markdown, write_csv
from .refinement import COUNTS, CURVES, QUANTITIES

MARKERS = "osD^vP*X"


def size(value):
    return f"{value:.1e}" if math.isfinite(value) else "-"


def exact(value):
    return f"{value:.8g}" if math.isfinite(value) else "-"


def observed(limit):
    return f"{limit.order:.2f} {limit.verdict}" if math.isfinite(limit.order) else limit.verdict


def run_table(study):
    """What each run cost and how far it is from the best limit."""
    header = ["order", "grading", "elements", "tolerance", *COUNTS, "N error", "T error", "(N limit)",
              "(T limit)"]
    rows = []
    for r in study.results:
        key = [r.case.family.order, r.case.family.grading, r.case.elements, r.case.tolerance]
        counts = ["-"] * len(COUNTS)
        if r.counts:
            counts = [f"{r.counts[name]:.4g}" if name in ("cpu_s", "peak_MB") else r.counts[name]
                      for name in COUNTS]
        (n, n_limit), (t, t_limit) = (study.error(r, name) for name in ("N", "T"))
        rows.append([*key, *counts] + (["FAILED", "FAILED", "", ""] if r.failure else
                                       [size(n), size(t), size(n_limit), size(t_limit)]))
    notes = ["Errors: largest at a phase's end, relative to the limit with the smallest uncertainty among "
             "the families;",
             "in brackets that limit's relative uncertainty: errors near or below it mean nothing."]
    notes += [f"FAILED {r.case.name()}: {r.failure}" for r in study.results if r.failure]
    return "Runs", header, rows, notes


def family_table(study, family):
    """Values at the mesh levels, orders and limits."""
    runs = study.series(family)
    header = ["phase", "quantity", *(f"n={r.case.elements}" for r in runs), "mesh order", "step order",
              "limit", "+- mesh", "+- steps", "relative", "target"]
    target = study.target(family)
    rows, used = [], set()
    for phase in study.phases:
        for name in QUANTITIES:
            key = (family, phase, name)
            if key not in study.mesh:
                continue
            mesh, steps, limit = study.mesh[key], study.steps.get(key), study.limits.get(key)
            used |= {mesh.verdict} | ({steps.verdict} if steps else set())
            row = [phase, name, *(exact(r.value(phase, name)) for r in runs), observed(mesh)]
            if limit:
                row += [observed(steps), exact(limit.value), size(mesh.uncertainty), size(steps.uncertainty),
                        size(limit.relative()), "met" if study.reaches_target(family, limit) else "MISSED"]
            else:
                row += ["no common run", "-", size(mesh.uncertainty), "-", "-", "MISSED"]
            rows.append(row)
    irregular = extrapolate.family_irregularity([r.case.elements for r in runs],
                                                [r.counts["unknowns"] for r in runs]) if runs else 0
    steps = study.series(family, steps=True)
    notes = [f"{verdict}: {text}." for verdict, text in extrapolate.VERDICTS.items() if verdict in used]
    notes.append("Nested meshes: the coarsest one with its edges halved." if family.nested() else
                 f"sqrt(unknowns) is linear in the elements within {100 * irregular:.2g} %"
                 + ("." if irregular < 0.01 else ": NOT nearly self-similar, orders mean little."))
    if steps:
        levels = ", ".join(f"{r.case.tolerance} ({r.counts['steps']} steps)" for r in steps)
        notes.append(f"Steps refined on n={steps[0].case.elements}: tolerances {levels}.")
    missing = [r.case.name() for r in study.results if r.case.family == family and r.failure]
    notes += [f"Without the failed {name}." for name in missing]
    return f"Limits, {family.label()} (relative uncertainty to reach: {target:g})", header, rows, notes


def agreement_table(study):
    """Limits of all families beside each other."""
    header = ["phase", "quantity", *(f.label() for f in study.families), "limits"]
    rows, counts = [], {"agree": 0, "agree, too uncertain": 0, "DISAGREE": 0}
    for phase in study.phases:
        for name in QUANTITIES:
            limits = study.of_families(phase, name)
            if len(limits) < 2:
                continue
            agree = extrapolate.all_agree(list(limits.values()))
            sure = all(study.reaches_target(f, limit) for f, limit in limits.items())
            verdict = ("agree" if sure else "agree, too uncertain") if agree else "DISAGREE"
            counts[verdict] += 1
            cells = [f"{limits[f].value:.7g} +- {size(limits[f].uncertainty)}" if f in limits else "-"
                     for f in study.families]
            rows.append([phase, name, *cells, verdict])
    notes = ["Limits agree when their intervals overlap; too uncertain: some family misses its target there.",
             "; ".join(f"{verdict}: {count}" for verdict, count in counts.items()) + "."]
    for family in study.families:
        own = [study.reaches_target(family, limit) for key, limit in study.limits.items() if key[0] == family]
        notes.append(f"{family.label()}: relative uncertainty at most {study.target(family):g} in "
                     f"{sum(own)} of {len(own)} cases.")
    return "Do the limits agree", header, rows, notes


def curve_table(study, steps):
    """Differences over time to the finest run of each series."""
    header = ["family", "elements", "tolerance",
              *(f"{name} phase {phase}" for name in CURVES for phase in study.phases)]
    rows = []
    for family in study.families:
        columns = {name: study.curves(family, name, steps) for name in CURVES}
        for index, (result, _) in enumerate(columns["N"]):
            cells = []
            for name in CURVES:
                for phase in study.phases:
                    d = columns[name][index][1].get(phase)
                    cells.append(f"{d[0]:.1e} ({d[1]:.0e})" if d else "-")
            rows.append([family.label(), result.case.elements, result.case.tolerance, *cells])
    what = "step" if steps else "mesh"
    notes = [f"max over t of |value - value of the finest {what}| / max |value| in the phase, at the "
             "coarser run's own steps,",
             "the finest run interpolated by a monotone cubic within the phase. In brackets what that "
             "interpolation errs",
             "when every other step is left out (several times more than with all): smaller differences "
             "mean nothing."]
    notes += [] if steps else ["Runs place their steps differently: the difference has a part of the step's "
                               "error too."]
    return f"Curves over time, {what} series", header, rows, notes


def as_text(table):
    title, header, rows, notes = table
    cells = [[str(cell) for cell in row] for row in [header, *rows]]
    widths = [max(len(row[k]) for row in cells) for k in range(len(header))]
    lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in cells]
    return "\n".join([title, "", *lines, "", *notes, ""])


def as_markdown(table):
    title, header, rows, notes = table
    return "\n".join([f"## {title}", "", markdown(header, rows, " ---: "), "",
                      *(f"- {note}" for note in notes), ""])


def write_runs(study, path):
    """A row for each run and phase end; 17 digits. A failed run has what it reached, or one row without a
    phase."""
    rows = []
    for r in study.results:
        key = [r.case.family.order, r.case.family.grading, r.case.elements, r.case.tolerance,
               r.failure or "complete",
               *(r.counts.get(name, "nan") for name in COUNTS)]
        for phase in sorted(r.phases) or [""]:
            values = (f"{r.value(phase, name):.17g}" for name in QUANTITIES)
            rows.append([*key, phase, r.times.get(phase, ""), *values])
    write_csv(path, ["order", "grading", "elements", "tolerance", "status", *COUNTS, "phase", "time_s",
                     *QUANTITIES.values()], rows)


def write_limits(study, path):
    rows = [[key[0].order, key[0].grading, key[1], key[2], f"{limit.value:.17g}", f"{limit.uncertainty:.17g}",
             study.mesh[key].order, study.mesh[key].verdict, f"{study.mesh[key].uncertainty:.17g}",
             study.steps[key].order, study.steps[key].verdict, f"{study.steps[key].uncertainty:.17g}"]
            for key, limit in study.limits.items()]
    write_csv(path, ["order", "grading", "phase", "quantity", "limit", "uncertainty", "mesh_order",
                     "mesh_verdict", "mesh_uncertainty", "step_order", "step_verdict", "step_uncertainty"],
              rows)


def draw_errors(axes, study, name, steps):
    for index, family in enumerate(study.families):
        runs = study.series(family, steps=steps)
        x = [r.counts["steps" if steps else "unknowns"] for r in runs]
        y = [study.series_error(family, r, name, steps) for r in runs]
        kept = [(a, b) for a, b in zip(x, y) if b > extrapolate.ROUND_OFF]  # no nan either
        if kept:
            axes.plot(*zip(*kept), marker=MARKERS[index % len(MARKERS)], color=f"C{index}",
                      label=family.label())
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("accepted steps" if steps else "unknowns")
    axes.set_ylabel(f"largest error of {name} at a phase's end\nrelative, against the limit of its series",
                    fontsize=9)
    axes.set_title(f"{name}: {'steps' if steps else 'mesh'} refined", fontsize=10)
    axes.grid(True, which="both", color="#e8e8e8", linewidth=0.6)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize=8, frameon=False)


def draw_curves(axes, study, name, steps):
    """The levels of the first family over time, each phase with its own logarithmic time."""
    runs = study.series(study.families[0], steps=steps)
    colours = plt.get_cmap("viridis")(np.linspace(0, 0.85, max(len(runs), 1)))
    for rank, (result, colour) in enumerate(zip(runs, colours)):
        x = plot.stretched_time(result.run)[0]
        label = f"tolerance {result.case.tolerance}" if steps else f"n = {result.case.elements}"
        axes.plot(x, result.run.history[CURVES[name]], color=colour,
                  linewidth=1 + 0.8 * (len(runs) - rank - 1),
                  label=label)
    plot.mark_phase_ends(axes, range(1, len(study.phases)))
    axes.set_xticks([k + 0.5 for k in range(len(study.phases))], [f"phase {p}" for p in study.phases])
    axes.set_xlabel("time, logarithmic in each phase")
    axes.set_ylabel({"N": "axial force N  (N)", "T": "torque T  (N mm)"}[name])
    axes.set_title(f"{name}(t), {study.families[0].label()}, {'steps' if steps else 'mesh'} refined",
                   fontsize=10)
    if runs:
        axes.legend(fontsize=8, frameon=False)
    plot.frame(axes)


def draw(study):
    figure, axes = plt.subplots(4, 2, figsize=(14, 18), layout="constrained")
    rows = ((draw_errors, False), (draw_errors, True), (draw_curves, False), (draw_curves, True))
    for column, name in enumerate(CURVES):
        for row, (draw_one, steps) in enumerate(rows):
            draw_one(axes[row, column], study, name, steps)
    return figure


def write(study, directory):
    """Everything, and the tables on standard output."""
    directory.mkdir(parents=True, exist_ok=True)
    tables = [run_table(study), *(family_table(study, family) for family in study.families),
              agreement_table(study), curve_table(study, False), curve_table(study, True)]
    print("\n".join(as_text(table) for table in tables))
    quantities = [f"- {name}: `{column}`" for name, column in QUANTITIES.items()]
    lines = ["# Mesh and steps", "", "Values at phase ends; displacements are positive downwards.", "",
             *quantities, "", *map(as_markdown, tables)]
    (directory / "convergence.md").write_text("\n".join(lines), encoding="utf-8")
    write_runs(study, directory / "runs.csv")
    write_limits(study, directory / "limits.csv")
    figure = draw(study)
    plot.save(figure, directory / "convergence", dpi=110)
    print(f"files: {directory}/convergence.md, convergence.png (and .pdf), runs.csv, limits.csv")
