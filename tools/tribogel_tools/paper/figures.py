"""The paper's figures 5 to 13, drawn from the runs in the paper's own normalisation."""
import matplotlib.pyplot as plt
import numpy as np

from .. import plot
from . import rheometer, runs

BLUE, RED, GREEN, GREY, ORANGE = "#1f5a99", "#b3372b", "#2f7d4f", "#777777", "#d98c1f"
STYLES = ((BLUE, "-"), (RED, "--"), (GREEN, "-."))
HOUR, PHASE = 3600.0, 900.0  # s: the paper's tau of Fig. 5 and of the others
LEVELS = ("ω₁ = 0.01", "ω₂ = 0.10", "ω₃ = 1.00 rad/s")
FIT_DEGREE = 6  # of the polynomial in Fig. 8; the paper does not name its own
TABLE2 = {"case 1": "table2_case1", "case 2": "table2_case2", "case 3": "table2_case3"}
PAIRS = {"viscoelastic / viscoelastic": "fig12_ve_ve", "hyperelastic / viscoelastic": "fig12_he_ve",
         "hyperelastic / hyperelastic": "fig12_he_he"}


def new_figure(columns, height=3.3, rows=1, **how):
    figure, axes = plt.subplots(rows, columns, figsize=(9.6, height * rows), layout="constrained",
                                squeeze=False, **how)
    return figure, axes.ravel()


def finish(figure, results, name):
    """Writes the picture beside the report."""
    path = results.output / "figures" / f"{name}.png"
    path.parent.mkdir(parents=True, exist_ok=True)
    for axes in figure.axes:
        plot.frame(axes)
    figure.savefig(path, dpi=150)
    plt.close(figure)
    return path


def titled(axes, title, abscissa, ordinate):
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(abscissa)
    axes.set_ylabel(ordinate)


def normalised(run):
    """t, N/Nref and T/Tref: Nref is the long-time value of N, Tref = Nref Rmin. What is left of a torque
    before any rotation is round-off and drawn as zero."""
    history = run.history
    reference = run.force()
    torque = plot.without_round_off(history["torque_Nmm"], reference * run.radius)
    return history["time_s"], history["normal_force_N"] / reference, torque / (reference * run.radius)


def first_minutes(axes, cases, results, seconds=120):
    """N while the gels are pressed and relax, which the long axis does not show, in an inset."""
    inset = axes.inset_axes((0.2, 0.13, 0.72, 0.55))
    for case, (colour, style) in zip(cases.values(), STYLES):
        time, force, _ = normalised(results.shown(case))
        inset.plot(time, force, style, color=colour, linewidth=1.3)
    inset.set(xlim=(0, seconds), ylim=(0, None))
    inset.set_xlabel("t  (s)", fontsize=8, labelpad=1)
    inset.tick_params(labelsize=8)


def mark_levels(axes, start, names=LEVELS):
    """The phases of rotation, as the paper marks them."""
    for k, name in enumerate(names):
        axes.axvline(start + k, color="#bbbbbb", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
        axes.annotate(name, (start + k + 0.5, 0.985), ha="center", va="top", fontsize=8, color="#444444",
                      xycoords=("data", "axes fraction"))


def force_and_torque(cases, results, name, until=7):
    """N and T of several runs over t/tau, as in Figs. 6, 10 and 12, and the beginning of the last jump."""
    figure, (left, right) = new_figure(2)
    for (label, case), (colour, style) in zip(cases.items(), STYLES):
        time, force, torque = normalised(results.shown(case))
        left.plot(time / PHASE, force, style, color=colour, label=label)
        right.plot(time / PHASE, torque * 1e3, style, color=colour, label=label)
    titled(left, "axial force", "t / τ,  τ = 900 s", "N / Nref")
    titled(right, "torque", "t / τ,  τ = 900 s", "T / Tref  (10⁻³)")
    left.set(xlim=(0, until), ylim=(0, None))
    right.set(xlim=(4, until))
    right.set_ylim(0, right.get_ylim()[1] * 1.12)
    for k in range(4, until):
        left.axvline(k, color="#bbbbbb", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
    mark_levels(right, 4)
    first_minutes(left, cases, results)
    if len(cases) > 1:
        right.legend(frameon=False, fontsize=8.5, loc="center left")
    return finish(figure, results, name)


def figure5(results):
    """One gel, and where its force rises when the torque comes."""
    figure, (force, torque, rise, square) = new_figure(2, rows=2)
    run = results.shown("fig05")
    time, N, T = normalised(run)
    force.plot(time / HOUR, N, color=BLUE)
    torque.plot(time / HOUR, T, color=RED)
    titled(force, "axial force", "t / τ,  τ = 3600 s", "N / Nref")
    titled(torque, "torque", "t / τ,  τ = 3600 s", "T / Tref")
    for axes in (force, torque):
        axes.set_xlim(0, time[-1] / HOUR)
        axes.set_ylim(0, None)
    rows = np.concatenate((run.drawn.rows[2], run.drawn.rows[3][1:]))
    rows = rows[time[rows] < HOUR + 120]
    before = run.force(2)
    rise.plot(time[rows] - HOUR, 100 * (run.history["normal_force_N"][rows] / before - 1), "o-", color=BLUE,
              markersize=3)
    rise.axhline(100 * (run.force() / before - 1), color=GREY, linewidth=0.9, linestyle="--")
    rise.annotate("long-time value", (0.98, 100 * (run.force() / before - 1)), (0, -4), va="top", ha="right",
                  fontsize=8,
                  xycoords=("axes fraction", "data"), textcoords="offset points", color="#444444")
    titled(rise, "N when the twist comes (27 s) and stays", "time since the twist began  (s)",
           "rise of N  (%)")
    relaxed = results.of("torsion/1")
    twist = np.array(runs.TWISTS)
    rises = np.array([relaxed.force(k + 1) - relaxed.force(1) for k in range(len(twist))])
    stiffening = torsional_stiffening(relaxed)
    angle = np.linspace(0, twist[-1], 60)
    square.plot(angle, 0.5 * angle**2 * stiffening, color=GREY,
                label="½ θ² dk/d(approach), from torques alone")
    square.plot(twist, rises, "o", color=BLUE, label="relaxed states")
    titled(square, "long-time rise of N", "twist θ  (rad)", "rise of N  (N)")
    square.legend(frameon=False, fontsize=8.5)
    return finish(figure, results, "fig05")


def torsional_stiffening(relaxed):
    """dk/d(approach) of the torsional stiffness k = T/theta [N mm/rad per mm], from the last two phases of
    `torsion`."""
    return (relaxed.torque(-2) - relaxed.torque(-1)) / (2 * runs.APPROACH_STEP * runs.TWISTS[2])


def figure7(results):
    figure, (left, right) = new_figure(2, height=3.6)
    run = results.shown("fig06")
    history = run.history
    turning = history["rate_rad_per_s"] > 0
    for name, label, colour, style in plot.COEFFICIENTS:
        left.plot(history["time_s"][turning] / PHASE, history[name][turning] * 1e3, style, color=colour,
                  label=label)
    titled(left, "friction coefficient", "t / τ,  τ = 900 s", "μ  (10⁻³)")
    left.set(xlim=(4, 7))
    left.set_ylim(0, left.get_ylim()[1] * 1.08)
    mark_levels(left, 4)
    left.legend(frameon=False, fontsize=8.5, loc="center left")
    weights = ("mu_mean", "mu_area_weighted", "mu_pressure_weighted")
    names = ("mean over\nthe nodes", "weighted\nby area", "weighted\nby pressure")
    ratios = [100 * (run.end(-1, "mu_apparent") / run.end(-1, name) - 1) for name in weights]
    bars = right.bar(names, ratios, color=[GREY, GREEN, BLUE], width=0.55)
    right.bar_label(bars, [f"{ratio:+.2f} %" for ratio in ratios], fontsize=9, padding=2)
    right.axhline(0, color="#222222", linewidth=0.8)
    right.margins(y=0.15)
    titled(right, "(3.11) over the converged coefficient at 1 rad/s", "", "difference  (%)")
    return finish(figure, results, "fig07")


def surface_fit(run):
    """Fig. 8's bottom surface at the end of the phase at rest: r and u_z of its nodes over Rmin, and a
    polynomial."""
    surface = run.surface("bottom", 2)
    r = surface["r_mm"] / run.radius
    u = (surface["z_mm"] - surface["reference_z_mm"]) / run.radius
    return r, u, np.polynomial.Polynomial.fit(r, u, FIT_DEGREE)


def figure8(results):
    figure, (axes,) = new_figure(1, height=4.0)
    run = results.shown("fig06")
    r, u, polynomial = surface_fit(run)
    fine = np.linspace(0, r[-1], 300)
    axes.plot(fine, polynomial(fine), color=RED, linewidth=1.2,
              label=f"deformed surface (polynomial fit, degree {FIT_DEGREE})")
    axes.plot(r, u, "o", color=BLUE, markersize=3.5, markerfacecolor="white",
              label="deformed surface (nodal values)")
    axes.plot((0, float(run.summary["options"]["bottom_radius"]) / run.radius), (0, 0), "--", color="#222222",
              linewidth=1.2, label="undeformed surface")
    contact = run.end(2, "contact_radius_mm") / run.radius
    axes.axvline(contact, color=GREY, linewidth=0.8, linestyle=":")
    axes.annotate(f"contact radius {contact * run.radius:.3f} mm", (contact, 0.55), (-6, 0), ha="right",
                  fontsize=8.5,
                  xycoords=("data", "axes fraction"), textcoords="offset points", color="#444444")
    for place, value in ((0, -0.031151), (contact, -0.012338)):
        axes.plot(place, value, "x", color="#222222", markersize=8, markeredgewidth=1.6, zorder=5,
                  label="the paper's centre and outer nodes" if place == 0 else None)
    axes.set(xlim=(0, 1.4), ylim=(-0.035, 0.005))
    titled(axes, "deformed and undeformed surface at rest", "r / Rmin", "u_z / Rmin")
    axes.legend(frameon=False, fontsize=8.5, loc="lower right")
    return finish(figure, results, "fig08")


def figure9(results):
    figure, (axes,) = new_figure(1, height=3.3)
    speed = np.linspace(0, 10, 101)
    for (label, case), (colour, style) in zip(TABLE2.items(), STYLES):
        b, m = results.shown(case).law
        law = " + ".join(f"{bi:.3g}{('', ' v', ' v²')[int(mi)]}" for bi, mi in zip(b, m) if bi)
        axes.plot(speed, 1e3 * rheometer.coefficient(b, m, speed), style, color=colour,
                  label=f"{label}: {law}")
    titled(axes, "local friction laws", "sliding speed v  (mm/s)", "μ  (10⁻³)")
    axes.set(xlim=(0, 10), ylim=(0, None))
    axes.legend(frameon=False, fontsize=8.5)
    return finish(figure, results, "fig09")


def coefficients(cases, results, name):
    """Apparent coefficient of several runs, Figs. 11 and 13."""
    figure, (axes,) = new_figure(1, height=3.3)
    for (label, case), (colour, style) in zip(cases.items(), STYLES):
        history = results.shown(case).history
        turning = history["rate_rad_per_s"] > 0
        axes.plot(history["time_s"][turning] / PHASE, 1e3 * history["mu_apparent"][turning], style,
                  color=colour,
                  label=label)
    titled(axes, "apparent friction coefficient", "t / τ,  τ = 900 s", "μ apparent  (10⁻³)")
    axes.set(xlim=(4, 7))
    axes.set_ylim(0, axes.get_ylim()[1] * 1.1)
    mark_levels(axes, 4)
    axes.legend(frameon=False, fontsize=8.5, loc="center left")
    return finish(figure, results, name)
