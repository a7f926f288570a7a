"""Draws what a run measured, as picture.png and picture.pdf in its run directory.

  tools/plot RUN_DIRECTORY [--output PATH]

Reads history.csv (needed) and profile.csv (contact surfaces; drawn when there) and works on runs that died
early. Left: axial force, torque and friction coefficients over time. Right: the same with each phase
stretched to equal width and its own logarithmic time, because transients last seconds and a hold an hour.
Below: the law of friction (from summary.json), the contact surfaces and the pressure. PATH is the picture's name; its ending, if any, is replaced by
.png and .pdf.

The interpreter is Debian's own: matplotlib is Debian's python3-matplotlib, which another python3 found first
in PATH does not see.
"""
import json
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

from .command_line import BadInput, Parser
from .run_data import History, is_meridian, rolled_rows, surface_rows

BLUE, RED, GREY = "#1f5a99", "#b3372b", "#777777"
COEFFICIENTS = (  # column, label, colour, line style
    ("mu_apparent", "apparent, eq. (3.13)", "#b3372b", "-"),
    ("mu_gong", "Gong, eq. (2.3)", "#d98c1f", "-"),
    ("mu_mean", "mean over the patch's points", "#4a4a4a", ":"),
    ("mu_area_weighted", "area-weighted", "#2f7d4f", "--"),
    ("mu_pressure_weighted", "pressure-weighted", "#1f5a99", "-."),
)


def stretched_time(run):
    """Abscissa of every row: phase k fills [k, k + 1] with the logarithm of the time since its start. Returns
    it with the decades to label: positions and exponents."""
    x, positions, exponents = np.zeros(len(run.history["time_s"])), [], []
    for index, rows in enumerate(run.rows):
        since = run.history["time_s"][rows] - run.history["time_s"][rows[0]]
        later = since > 0
        if not later.any():
            x[rows] = index
            continue
        # The start has no logarithm: it stands a little to the left of the first step.
        first, last = math.log10(since[later].min()), math.log10(since.max())
        first = min(first, last - 1)
        decades = np.arange(math.ceil(first), math.floor(last) + 1)[::-1]
        decades = decades[:: max(1, math.ceil(len(decades) * len(run.rows) / 22))]
        slope = 0.95 / (last - first)
        x[rows[later]] = index + 1 + slope * (np.log10(since[later]) - last)
        places = index + 1 + slope * (decades - last)
        positions += list(places[places < index + 0.97])
        exponents += list(decades[places < index + 0.97])
    return x, positions, exponents


def without_round_off(values, scale):
    return np.where(np.abs(values) < 1e-11 * scale, 0, values)


def number(value):
    return f"{value:.4g}" if 1e-3 <= abs(value) < 1e5 or value == 0 else f"{value:.3e}"


def decade_scale(axes, ends):
    """Logarithmic from the decade of the smallest value at a phase's end that counts, linear from there
    through zero. Within little more than a decade linear axes read better and are kept."""
    sizes = np.abs(ends[np.isfinite(ends)])
    top = sizes.max(initial=0)
    smallest = sizes[sizes > 1e-7 * top].min(initial=top)
    if smallest >= 0.05 * top:
        return
    lowest, highest = math.floor(math.log10(smallest)), math.ceil(math.log10(top))
    axes.set_yscale("symlog", linthresh=10.0**lowest, linscale=0.5)
    decades = 10.0 ** np.arange(lowest, highest + 1)
    below = -decades[::-1] if np.nanmin(ends) < -1e-7 * top else []
    axes.set_yticks(np.concatenate((below, [0], decades)))
    axes.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())


def frame(axes):
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(True, axis="y", color="#e4e4e4", linewidth=0.7)
    axes.set_axisbelow(True)


def mark_phase_ends(axes, positions):
    for x in positions:
        axes.axvline(x, color="#bbbbbb", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)


def draw_over_time(axes, run, curves):
    time = run.history["time_s"]
    for values, label, colour, style in curves:
        axes.plot(time, values, style, color=colour, linewidth=1.6, label=label)
    mark_phase_ends(axes, time[run.ends[:-1]])
    axes.set_xlim(0, time[-1] if time[-1] > 0 else 1)
    axes.set_xlabel("time  (s)")
    frame(axes)


def draw_by_phase(axes, run, curves, stretched, name_phases):
    """The same over the stretched time, with the values of the first curve at the phase ends."""
    x, positions, exponents = stretched
    annotate = curves[0][0]
    for values, label, colour, style in curves:
        axes.plot(x, values, style, color=colour, linewidth=1.6)
    mark_phase_ends(axes, range(1, len(run.rows)))
    if name_phases:
        for index in range(len(run.rows)):
            axes.annotate(f"phase {run.phases[index]}\n{run.label(index)}", (index + 0.5, 1), (0, 5),
                          ha="center",
                          va="bottom", fontsize=9, xycoords=("data", "axes fraction"),
                          textcoords="offset points")
    for index, end in enumerate(run.ends):
        value = annotate[end]
        if not math.isfinite(value):
            continue
        axes.plot(index + 1, value, "o", color=curves[0][2], markersize=4.5, clip_on=False, zorder=5)
        fraction = axes.transAxes.inverted().transform(axes.transData.transform((0, value)))[1]
        above = fraction < 0.88
        axes.annotate(number(value), (index + 1, value), (-5, 7 if above else -8), textcoords="offset points",
                      ha="right", va="bottom" if above else "top", fontsize=9, zorder=6,
                      bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8})
    axes.set_xlim(0, len(run.rows))
    axes.set_xticks(positions, [f"$10^{{{e}}}$" if abs(e) > 1 else f"{10.0 ** e:g}" for e in exponents],
                    fontsize=8)
    axes.set_xlabel("time since the start of the phase  (s), logarithmic in each phase")
    frame(axes)


def friction_law(directory):
    """The law's curve from summary.json; None if the run wrote none, or has no law or no rotation."""
    try:
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    law = summary.get("friction_law")
    return law if law and "mu" in law else None


def draw_law(axes, law):
    """What was put in, at the speeds of the schedule: a straight line in the logarithm of v is a power."""
    mu = np.array([math.nan if value is None else value for value in law["mu"]])
    axes.plot(law["speed_mm_per_s"], mu, color="#4a4a4a", linewidth=1.8)
    axes.set_xscale("log")
    sizes = np.abs(mu[np.isfinite(mu)])
    if len(sizes) and sizes.min() > 0 and sizes.max() > 20 * sizes.min():
        axes.set_yscale("log")
    axes.set_xlabel("sliding speed v  (mm/s)")
    axes.set_ylabel("friction coefficient of the law  (1)")
    axes.set_title(f"Law {law['name']}, at p = {law['pressure_MPa']:.3g} MPa", fontsize=10)
    frame(axes)


def draw_surfaces(axes, run):
    """Undeformed and deformed contact surfaces at the last phase end, like the paper's Fig. 8."""
    profile, history = run.profile, run.history
    phase = int(profile["phase"].max())
    time = profile["time_s"][profile["phase"] == phase][0]
    styles = {"bottom": (BLUE, 3.0, "", "bottom gel"), "top": (RED, 1.2, "o", "top gel")}
    for surface, (colour, width, marker, name) in styles.items():
        rows = surface_rows(profile, surface, phase)
        if len(rows) == 0:
            continue
        line = is_meridian(profile, rows)
        axes.plot(profile["reference_r_mm"][rows], profile["reference_z_mm"][rows],
                  linestyle="--" if line else "",
                  marker="" if line else ".", markersize=2, color=colour, linewidth=1.0 + 0.4 * width,
                  alpha=0.45,
                  label=f"{name}, undeformed")
        axes.plot(profile["r_mm"][rows], profile["z_mm"][rows], linestyle="-" if line else "", color=colour,
                  marker=marker if line else ".", markersize=4, markerfacecolor="white", linewidth=width,
                  alpha=0.6 if surface == "bottom" else 1, label=f"{name}, deformed")
    rolled = rolled_rows(profile, phase)
    if len(rolled):
        axes.plot(profile["r_mm"][rolled], profile["z_mm"][rolled],
                  ":" if is_meridian(profile, rolled) else "", color=RED,
                  marker=".", markersize=4, linewidth=1.2, label="top gel's wall, rolled on")
    bottom = surface_rows(profile, "bottom", phase)
    if len(bottom):
        centre = bottom[np.argmin(profile["reference_r_mm"][bottom])]
        axes.annotate(f"centre: z = {profile['z_mm'][centre]:.4g} mm",
                      (profile["r_mm"][centre], profile["z_mm"][centre]), (14, 16),
                      textcoords="offset points",
                      fontsize=9, arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.8})
    radius = np.nan
    if "contact_radius_mm" in history:
        radius = history["contact_radius_mm"][np.argmin(np.abs(history["time_s"] - time))]
    if math.isfinite(radius) and radius > 0:
        axes.axvline(radius, color=GREY, linewidth=0.8, linestyle=":")
        axes.annotate(f"contact radius\n{radius:.4g} mm", (radius, 0.88), (-5, 0), ha="right", va="top",
                      fontsize=9,
                      xycoords=("data", "axes fraction"), textcoords="offset points", color="#444444")
    axes.margins(x=0.02, y=0.12)
    axes.set_xlim(left=0)
    axes.set_xlabel("r  (mm)")
    axes.set_ylabel("z  (mm)")
    axes.set_title(f"Contact surfaces at the end of phase {phase}, t = {time:g} s  (z stretched)",
                   fontsize=10)
    axes.legend(fontsize=8.5, frameon=False, loc="best")
    frame(axes)


def draw_pressure(axes, run):
    """Contact pressure of the top (slave) surface at each phase end. Later curves are thinner, so that equal
    ones show."""
    profile = run.profile
    phases = [int(k) for k in np.unique(profile["phase"])]
    colours = plt.get_cmap("viridis")(np.linspace(0, 0.88, len(phases)))
    for index, phase in enumerate(phases):
        rows = surface_rows(profile, "top", phase)
        if len(rows) == 0:
            continue
        line = is_meridian(profile, rows)
        rank = len(phases) - 1 - index
        name = run.label(run.phases.index(phase)) if phase in run.phases else ""
        axes.plot(profile["r_mm"][rows], profile["pressure_MPa"][rows], linestyle="-" if line else "",
                  marker="" if line else ".", markersize=3, color=colours[index], linewidth=1.3 + 1.1 * rank,
                  label=f"phase {phase}: {name}")
        rolled = rolled_rows(profile, phase)
        axes.plot(profile["r_mm"][rolled], profile["pressure_MPa"][rolled],
                  ":" if is_meridian(profile, rolled) else "",
                  marker=".", markersize=3, color=colours[index], linewidth=1.3)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]))
    axes.set_xlabel("r  (mm)")
    axes.set_ylabel("contact pressure  (MPa)")
    axes.set_title("Pressure at the phase ends", fontsize=10)
    axes.legend(fontsize=8.5, frameon=False, loc="lower left")
    frame(axes)


def draw(run):
    """The whole figure; rows without data are left out."""
    h = run.history
    torque = without_round_off(h["torque_Nmm"], np.nanmax(np.abs(h["normal_force_N"])))
    quantities = [("axial force N  (N)", [(h["normal_force_N"], "", BLUE, "-")]),
                  ("torque T  (N mm)", [(torque, "", RED, "-")])]
    coefficients = [(without_round_off(h[name], 1), label, colour, style)
                    for name, label, colour, style in COEFFICIENTS if run.has(name)]
    if coefficients:
        quantities.append(("friction coefficient  (1)", coefficients))
    surfaces = run.profile is not None and (run.profile["surface"] == "top").any()
    law = friction_law(run.directory)
    heights = [1.0] * len(quantities) + ([1.25] if surfaces or law else [])
    figure = plt.figure(figsize=(14, 1.0 + 3.5 * sum(heights)), layout="constrained")
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights, width_ratios=(1, 1.7), hspace=0.06,
                               wspace=0.03)
    stretched = stretched_time(run)
    for row, (label, curves) in enumerate(quantities):
        left, right = figure.add_subplot(grid[row, 0]), figure.add_subplot(grid[row, 1])
        draw_over_time(left, run, curves)
        left.set_ylabel(label)
        if len(curves) > 1:
            left.legend(fontsize=8.5, frameon=False, loc="upper left")
        if not label.startswith("axial"):
            decade_scale(right, np.concatenate([values[run.ends] for values, *_ in curves]))
        draw_by_phase(right, run, curves, stretched, row == 0)
    panels = [lambda axes: draw_law(axes, law)] if law else []
    if surfaces:
        panels += [lambda axes: draw_pressure(axes, run), lambda axes: draw_surfaces(axes, run)]
    if panels:
        widths = (1, 1, 1.4)[-len(panels):] if surfaces else (1,)
        last = grid[-1, :].subgridspec(1, len(panels), width_ratios=widths)
        for column, panel in enumerate(panels):
            panel(figure.add_subplot(last[0, column]))
    figure.align_ylabels()
    figure.suptitle(f"{run.directory.resolve().name}:  {len(run.phases)} phase{'s' * (len(run.phases) > 1)}, "
                    f"{len(h['time_s']) - 1} steps, t = {h['time_s'][-1]:g} s", fontsize=12)
    return figure


def save(figure, base, dpi):
    """As base.png and base.pdf."""
    for ending in (".png", ".pdf"):
        try:
            figure.savefig(f"{base}{ending}", dpi=dpi)
        except OSError as error:
            raise BadInput(f"cannot write {base}{ending}: {error.strerror}") from None
    plt.close(figure)


def main(words):
    parser = Parser("plot", __doc__)
    parser.add_argument("run_directory", metavar="RUN_DIRECTORY")
    parser.add_argument("--output", metavar="PATH", help="default: RUN_DIRECTORY/picture")
    arguments = parser.parse_args(words)
    run = History(arguments.run_directory)
    base = pathlib.Path(arguments.output) if arguments.output else run.directory / "picture"
    base = base.with_suffix("") if base.suffix in (".png", ".pdf") else base
    save(draw(run), base, dpi=110)
    print(f"picture: {base}.png (and .pdf)")
    return 0
