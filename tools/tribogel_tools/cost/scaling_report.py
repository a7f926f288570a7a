"""Tables and the picture of tools/scaling. Runs are {(ranks, elements): Run}."""
import math

import matplotlib.pyplot as plt

from .. import plot
from ..tables import markdown, write_csv
from .cost_model import Model, Traffic, at, fit, line

SHOWN = ("SNESSolve", "SNESFunctionEval", "GelBulkResidual", "GelContactResid", "SNESJacobianEval",
         "GelBulkJacobian", "GelContactJacob", "GelContactSearch", "GelContactMortar", "MatAssemblyEnd",
         "PCSetUp", "MatLUFactorSym", "MatLUFactorNum", "MatPtAPSymbolic", "MatPtAPNumeric", "KSPSolve",
         "PCApply", "MatMult", "MatMultAdd", "MatSolve", "KSPGMRESOrthog", "GelObserve", "GelCheckpoint")


def dofs(run):
    return run.counts["unknowns"]


def per_newton(run, name="SNESSolve", what="seconds"):
    return getattr(run.event(name), what) / run.newton


def linear_per_newton(run):
    return run.counts["linear_iterations"] / run.counts["newton_iterations"]


def megabytes(run):
    return run.cost["peak_memory_MB"]


def write_events(path, runs):
    names = ("elements", "ranks", "dofs", "newton", "linear", "cpu_s", "memory_MB", "event", "count",
             "seconds", "flops", "messages", "bytes", "reductions")
    rows = []
    for (ranks, elements), run in runs.items():
        for event, numbers in run.events.items():
            rows.append([elements, ranks, dofs(run), run.newton, run.counts["linear_iterations"],
                         f"{run.cpu:.3f}",
                         f"{megabytes(run):.1f}", event, *(f"{number:.6g}" for number in numbers)])
    write_csv(path, names, rows)


def efficiency(fewest, more, name="SNESSolve"):
    """Strong: the same work, in the same number of Newton iterations or not."""
    one, many = per_newton(fewest, name), per_newton(more, name)
    return one * fewest.ranks / (many * more.ranks) if many else math.nan


def weak_efficiency(first, run):
    """Cost per dof, of the first over this."""
    return per_newton(first) * first.ranks / dofs(first) / (per_newton(run) * run.ranks / dofs(run))


def runs_table(runs):
    rows = []
    for (ranks, elements), run in sorted(runs.items(), key=lambda item: item[0][::-1]):
        n = dofs(run)
        rows.append([elements, ranks, n, run.newton, f"{linear_per_newton(run):.1f}",
                     f"{per_newton(run):.4g}",
                     f"{100 * run.rest_of_newton:.0f}", f"{run.cpu:.1f}", f"{megabytes(run):.0f}",
                     f"{1e3 * megabytes(run) / n:.3g}",
                     f"{per_newton(run, what='flops') / n:.3g}", f"{per_newton(run, what='messages'):.3g}",
                     f"{per_newton(run, what='bytes') / n:.3g}", f"{per_newton(run, what='reductions'):.3g}"])
    return markdown(["elements", "ranks", "dofs", "Newton", "linear/Newton", "s/Newton", "rest %", "CPU s",
                     "MB", "kB/dof", "flop/dof/Newton", "messages/Newton", "B/dof/Newton",
                     "reductions/Newton"], rows)


def by_elements(runs):
    groups = {}
    for (ranks, elements), run in sorted(runs.items()):
        groups.setdefault(elements, []).append(run)
    return groups


def strong_tables(runs, triad):
    parts = []
    for elements, group in by_elements(runs).items():
        first, *others = group
        if not others:
            continue
        names = [name for name in SHOWN if first.event(name).seconds > 1e-3 * first.newton_seconds]
        rows = []
        for name in names:
            row = [name, first.event(name).count, f"{per_newton(first, name):.3g}"]
            for run in others:
                row += [f"{per_newton(run, name):.3g}", f"{efficiency(first, run, name):.2f}",
                        f"{per_newton(run, name, 'messages'):.3g}",
                        f"{per_newton(run, name, 'bytes') / 1e6:.3g}"]
            rows.append(row)
        if triad and first.ranks == 1:
            row = ["memory bandwidth", "", ""]
            for run in others:
                row += ["", f"{triad[run.ranks] / triad[1] / run.ranks:.2f}", "", ""]
            rows.append(row)
        head = ["event", "count", f"s, {first.ranks}"]
        for run in others:
            head += [f"s, {run.ranks}", f"efficiency, {run.ranks}", f"messages, {run.ranks}",
                     f"MB, {run.ranks}"]
        parts.append(f"{elements} elements, {dofs(first)} dofs; per Newton iteration, by ranks:\n\n"
                     + markdown(head, rows))
    return "\n\n".join(parts)


def weak_table(runs, weak):
    found = [runs[pair] for pair in weak if pair in runs]
    rows = [[run.ranks, dofs(run), f"{dofs(run) / run.ranks:.0f}", f"{linear_per_newton(run):.1f}",
             f"{per_newton(run):.4g}",
             f"{weak_efficiency(found[0], run):.2f}"] for run in found]
    return markdown(["ranks", "dofs", "dofs a rank", "linear/Newton", "s/Newton", "efficiency"], rows)


def on_fewest(runs):
    """Runs on the fewest ranks that have more than one mesh, or at all, by dofs."""
    fewest = min(ranks for ranks, _ in runs)
    return sorted((run for (ranks, _), run in runs.items() if ranks == fewest), key=dofs)


QUANTITIES = {
    "seconds of a Newton iteration": per_newton,
    "of it, the linear solver": lambda run: run.linear_seconds / run.newton,
    "of it, the rest": lambda run: per_newton(run) * run.rest_of_newton,
    "CPU seconds of the whole run per Newton": lambda run: run.cpu / run.newton,
    "bulk residual, seconds per Newton": lambda run: per_newton(run, "GelBulkResidual"),
    "bulk Jacobian": lambda run: per_newton(run, "GelBulkJacobian"),
    "contact residual": lambda run: per_newton(run, "GelContactResid"),
    "contact Jacobian": lambda run: per_newton(run, "GelContactJacob"),
    "linear iterations per Newton": linear_per_newton,
    "flops per Newton": lambda run: per_newton(run, what="flops"),
    "memory, MB": megabytes,
}


def exponents(series):
    """Rows of (quantity, exponent with its error, value at the largest)."""
    x = [dofs(run) for run in series]
    rows = []
    for name, value in QUANTITIES.items():
        power = fit(x, [value(run) for run in series])
        text = "" if math.isnan(power.exponent) else f"{power.exponent:.2f}"
        rows.append([name, text + ("" if math.isnan(power.error) else f" ± {power.error:.2f}"),
                     f"{value(series[-1]):.4g}"])
    return rows


def summary(series):
    x, last = [dofs(run) for run in series], series[-1]
    power = fit(x, [per_newton(run) for run in series])
    offset, slope = line(x, [megabytes(run) for run in series])
    sentence = "One mesh: no exponent"
    if len(x) > 1:
        sentence = f"Cost of a Newton iteration ~ dofs^{power.exponent:.2f} from {x[0]} to {x[-1]} dofs"
    if not math.isnan(power.error):
        sentence += f" (standard error {power.error:.2f})"
    return (f"{sentence}. Memory: {1e3 * megabytes(last) / x[-1]:.3g} kB/dof at {x[-1]} dofs; {offset:.0f} "
            f"MB + {1e3 * slope:.3g} kB/dof by a straight line. The part of a Newton iteration that is not "
            f"the linear solver: {100 * last.rest_of_newton:.0f} % at {x[-1]} dofs.")


def model_of(runs, machine):
    series = on_fewest(runs)
    x = [dofs(run) for run in series]
    dimension = 3 if series[0].summary["options"]["model"] == "solid" else 2
    cost = fit(x, [per_newton(run) for run in series])
    iterations = fit(x, [linear_per_newton(run) for run in series])
    several = [run for run in runs.values() if run.ranks > 1]
    traffic = None
    if several:
        run = max(several, key=lambda r: (r.ranks, dofs(r)))
        traffic = Traffic(run.ranks, dofs(run), linear_per_newton(run),
                          *(per_newton(run, what=what) for what in ("messages", "bytes", "reductions")))
    return Model(cost, iterations, traffic, machine, dimension)


def model_table(model, series, sizes, counts):
    offset, slope = line([dofs(run) for run in series], [megabytes(run) for run in series])
    rows = []
    for n in sizes:
        for p in counts:
            compute, latency, bandwidth = model.parts(n, p)
            rows.append([n, p, f"{model.linear_iterations(n):.1f}", f"{compute:.3g}", f"{latency:.2g}",
                         f"{bandwidth:.2g}",
                         f"{model.seconds(n, p):.3g}", f"{model.efficiency(n, p):.2f}",
                         f"{offset + slope * n / p:.0f}"])
    return markdown(["dofs", "ranks", "linear/Newton", "computing s", "latency s", "bytes s", "s/Newton",
                     "efficiency", "MB a rank"], rows)


def report(runs, weak, triad, machine, sizes, counts):
    series = on_fewest(runs)
    parts = ["# Scaling", summary(series)]
    if triad:
        parts.append("Memory bandwidth (STREAM triad): " + "; ".join(
            f"{p} at once {rate / 1e9:.1f} GB/s, {rate / triad[1]:.2f} times one core's"
            for p, rate in triad.items()) + ".")
    parts += ["## Runs", runs_table(runs)]
    if strong := strong_tables(runs, triad):
        parts += ["## Strong scaling", strong]
    if weak:
        parts += ["## Weak scaling", weak_table(runs, weak)]
    if len(series) > 1:
        model = model_of(runs, machine)
        parts += [f"## Over dofs, on {series[0].ranks} rank(s)",
                  markdown(["quantity", "exponent", "at the largest"], exponents(series)),
                  "## Model",
                  f"Extrapolated, not measured, from {len(series)} meshes up to {dofs(series[-1])} dofs: "
                  f"seconds of a Newton iteration = {model.cost.factor:.3g} dofs^{model.cost.exponent:.2f} "
                  f"/ ranks + latency + bytes, with {machine.latency:g} s a message, {machine.bandwidth:g} "
                  f"B/s for each rank, at most {machine.neighbours} neighbours, linear iterations ~ "
                  f"dofs^{model.iterations.exponent:.2f}, a core and its memory bandwidth to each rank, and "
                  "no loss by uneven work.",
                  model_table(model, series, sizes, counts)]
        if not model.traffic:
            parts.append("No run on several ranks: nothing is known of messages, and they are left out.")
    return "\n\n".join(parts) + "\n"


def draw(stem, runs, triad):
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
    series = on_fewest(runs)
    x = [dofs(run) for run in series]
    shown = {"a Newton iteration": per_newton, "linear solver": QUANTITIES["of it, the linear solver"],
             "the rest": QUANTITIES["of it, the rest"]}
    for marker, (label, value) in zip("osD", shown.items()):
        y = [value(run) for run in series]
        power = fit(x, y)
        known = not math.isnan(power.exponent)
        points, = left.loglog(x, y, marker, label=label + (f" ~ dofs^{power.exponent:.2f}" if known else ""))
        if known:
            left.loglog(x, [at(power, n) for n in x], "-", lw=0.8, color=points.get_color())
    left.set_xlabel("dofs")
    left.set_ylabel(f"s per Newton iteration, {series[0].ranks} rank(s)")
    left.legend(fontsize=8)
    groups = {elements: group for elements, group in by_elements(runs).items() if len(group) > 1}
    if groups:
        first, *others = groups[max(groups)]
        names = [name for name in SHOWN if first.event(name).seconds > 0.02 * first.newton_seconds]
        for k, run in enumerate(others):
            width = 0.8 / len(others)
            right.barh([i + k * width for i in range(len(names))],
                       [efficiency(first, run, name) for name in names], width,
                       label=f"{run.ranks} ranks")
            if triad and first.ranks == 1:
                right.axvline(triad[run.ranks] / triad[1] / run.ranks, color=f"C{k}", ls="--",
                              label=f"memory bandwidth, {run.ranks}")
        right.set_yticks(range(len(names)), names, fontsize=8)
        right.set_title(f"strong scaling, {dofs(first)} dofs", fontsize=10)
        right.set_xlabel("efficiency")
        right.axvline(1, color="k", lw=0.8)
        right.invert_yaxis()
        right.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=4)
    else:
        right.set_axis_off()
    plot.save(figure, stem, dpi=150)
