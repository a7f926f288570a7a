"""What the paper does not show: profiles over the patch, energy, errors, readings of Table 1, the fits of
section 5."""
import numpy as np

from . import rheometer, runs
from .figures import BLUE, GREEN, GREY, HOUR, ORANGE, PHASE, RED, finish, new_figure, normalised, titled

READINGS = {"one unit, MPa (fig06.opts)": "fig06", "G₂, G₃ in Pa (table1_reading_c)": "table1_reading_c",
            "as printed, N, m, s (table1_as_printed)": "table1_as_printed"}
FORM_NAMES = {"b1": "b₁ v", "b2": "b₂ v²", "b0_b1": "b₀ + b₁ v", "b0_b2": "b₀ + b₂ v²",
              "b0_b1_b2": "b₀ + b₁ v + b₂ v²"}
FORM_STYLES = {"b1": (RED, "--"), "b2": (ORANGE, ":"), "b0_b1": (GREEN, "-"), "b0_b2": (BLUE, "-."),
               "b0_b1_b2": (GREY, (0, (6, 2)))}


def profiles(results):
    """Pressure and sliding speed over the patch at the end of the phases at rest and of fig06.opts' rates."""
    figure, (pressure, speed, stress) = new_figure(3, height=3.6)
    run = results.shown("fig06")
    mean = run.force(2) / (np.pi * run.radius**2)
    for phase, (colour, width) in zip((1, 2, 5), ((GREY, 1.3), (BLUE, 3.0), (RED, 1.2))):
        surface = run.surface("top", phase)
        name = ("end of the approach", "at rest, 3600 s", "", "", "1 rad/s, 6300 s")[phase - 1]
        pressure.plot(surface["r_mm"], surface["pressure_MPa"] * 1e3, color=colour, linewidth=width,
                      label=name)
    pressure.axhline(mean * 1e3, color="#222222", linestyle=":", linewidth=1,
                     label="N/(π Rmin²), as (3.11) assumes")
    titled(pressure, "pressure", "r  (mm)", "p  (kPa)")
    for phase, colour in zip((3, 4, 5), (GREEN, BLUE, RED)):
        surface = run.surface("top", phase)
        rate = run.rates()[phase - 1]
        moving = surface["sliding_velocity_mm_per_s"] > 0
        r = surface["r_mm"][moving]
        speed.loglog(r, surface["sliding_velocity_mm_per_s"][moving], "o", color=colour, markersize=3,
                     markerfacecolor="white", label=f"{rate:g} rad/s")
        speed.plot(r, rate * r, color=colour, linewidth=0.8)
        stress.semilogy(r, np.hypot(surface["traction_circumferential_MPa"], 0)[moving] * 1e6, color=colour,
                        label=f"{rate:g} rad/s")
    titled(speed, "sliding speed; lines: ω r", "r  (mm)", "v  (mm/s)")
    titled(stress, "circumferential traction", "r  (mm)", "τ  (Pa)")
    pressure.set(xlim=(0, None), ylim=(0, None))
    stress.set_xlim(0, None)
    for axes in (pressure, speed, stress):
        axes.legend(frameon=False, fontsize=8)
    return finish(figure, results, "profiles")


def energy(results):
    figure, (left, right) = new_figure(2, height=3.5)
    history = results.shown("fig06").history
    time = history["time_s"]
    work = history["work_of_plates_Nmm"]
    fine = np.unique(np.concatenate((time, *(start + np.geomspace(0.1, 900, 60)
                                             for start in (3600, 4500, 5400)))))
    for column, label, colour, style in (("work_of_plates_Nmm", "work of the plates", "#222222", "-"),
                                         ("stored_energy_Nmm", "stored", BLUE, "-"),
                                         ("viscous_dissipation_Nmm", "viscous heat", GREEN, "--"),
                                         ("frictional_dissipation_Nmm", "frictional heat", RED, "--")):
        values = np.interp(fine, time, history[column])  # between rows heat grows linearly
        left.semilogy(fine / PHASE, np.where(values > 1e-3, values, np.nan), style, color=colour, label=label,
                      linewidth=2.5 if colour == "#222222" else 1.4)
    titled(left, "energies", "t / τ,  τ = 900 s", "N mm")
    left.legend(frameon=False, fontsize=8.5, loc="lower right")
    rest = work - history["stored_energy_Nmm"] - history["viscous_dissipation_Nmm"]
    rest = rest - history["frictional_dissipation_Nmm"]
    right.plot(time / PHASE, rest, color="#222222")
    titled(right, "work less the other three", "t / τ,  τ = 900 s", "N mm")
    return finish(figure, results, "energy")


def mesh_errors(results):
    """Departures from the extrapolated limits under refinement, and N(t), T(t) with a quarter of the step
    tolerance."""
    figure, (left, right) = new_figure(2, height=3.5)
    elements = results.detail.elements * 2 ** np.arange(results.detail.levels)
    for function, name, colour in ((lambda run: run.force(), "N", BLUE), (lambda run: run.torque(), "T", RED),
                                   (lambda run: run.end(-1, "mu_pressure_weighted"),
                                    "μ weighted by pressure", GREEN)):
        values, limit = results.mesh_series(function)
        order = f", order {limit.order:.1f}" if np.isfinite(limit.order) else ""
        left.loglog(elements, 100 * np.abs(np.array(values) / limit.value - 1), "o-", color=colour,
                    label=name + order)
    left.set_xticks(elements, [str(n) for n in elements])
    left.minorticks_off()
    titled(left, "meshes, 1 rad/s", "elements along the top radius", "departure from the limit  (%)")
    left.legend(frameon=False, fontsize=8.5)
    coarse, short = results.of("fig06/coarse"), results.of("fig06/coarse_short_steps")
    names = ("approach", "hold", "0.01 rad/s", "0.1 rad/s", "1 rad/s")
    for column, name, colour, first, side in (("normal_force_N", "N", BLUE, 1, -0.2),
                                              ("torque_Nmm", "T", RED, 3, 0.2)):
        phases = np.arange(first, len(names) + 1)
        change = [100 * abs(coarse.end(k, column) / short.end(k, column) - 1) for k in phases]
        right.bar(phases + side, change, 0.38, color=colour, label=name)
    right.set_yscale("log")
    right.set_xticks(range(1, len(names) + 1), names, fontsize=9)
    titled(right, "steps: a quarter of the tolerance", "end of", "change of the value there  (%)")
    right.legend(frameon=False, fontsize=8.5)
    return finish(figure, results, "errors")


def readings(results):
    figure, (left, right) = new_figure(2, height=3.4)
    for (label, case), (colour, style) in zip(READINGS.items(), ((BLUE, "-"), (RED, "--"), (GREEN, "-."))):
        run = results.shown(case)
        time, force, _ = normalised(run)
        left.plot(time, force, style, color=colour, label=label)
        surface = run.surface("bottom", 2)
        right.plot(surface["r_mm"], surface["z_mm"], style, color=colour, label=label)
        edge = run.end(2, "contact_radius_mm")
        right.plot(edge, np.interp(edge, surface["r_mm"], surface["z_mm"]), "o", color=colour, markersize=5)
    left.set(xlim=(0, 150), ylim=(0, 1.75))
    titled(left, "axial force", "t  (s)", "N / Nref")
    left.legend(frameon=False, fontsize=8, loc="upper left")
    titled(right, "bottom surface at rest; dots: end of the contact", "r  (mm)", "z  (mm)")
    return finish(figure, results, "readings")


def four_rates(results):
    figure, (left, right) = new_figure(2, height=3.3)
    run = results.shown("fig04_four_rates")
    time, force, torque = normalised(run)
    left.plot(time / HOUR, force, color=BLUE)
    titled(left, "axial force", "t  (h)", "N / Nref")
    turning = run.history["rate_rad_per_s"] > 0
    right.semilogy(time[turning] / HOUR, torque[turning], color=RED)
    titled(right, "torque, four rates", "t  (h)", "T / Tref")
    left.set_ylim(0, None)
    right.set_ylim(1e-5, 0.1)
    return finish(figure, results, "fig04")


def fits(results):
    """Section 5: the hidden law and the fitted ones, and the torques that they give."""
    figure, (law, data) = new_figure(2, height=3.8)
    speed = np.linspace(0, 12, 121)
    hidden = results.of("fit/hidden")
    b, m = hidden.law
    law.plot(speed, 1e3 * rheometer.coefficient(b, m, speed), color="#222222", linewidth=3, alpha=0.35,
             label="hidden law")
    rates = np.array(hidden.rates())
    measured = np.array([hidden.torque_over_force(k + 1) for k in range(len(rates))])
    data.axhspan(-1, 1, color="#eeeeee")
    for form, run in results.fits().items():
        colour, style = FORM_STYLES[form]
        b, m = run.law
        law.plot(speed, 1e3 * rheometer.coefficient(b, m, speed), linestyle=style, color=colour,
                 label=FORM_NAMES[form])
        found = np.array([run.torque_over_force(k + 1) for k in range(len(rates))])
        data.semilogx(rates, 100 * (found / measured - 1), marker="o", markersize=3.5, linestyle=style,
                      color=colour,
                      label=FORM_NAMES[form])
    titled(law, "local law", "sliding speed v  (mm/s)", "μ  (10⁻³)")
    titled(data, "T/N of the fitted law, simulated, against the measured", "rate  (rad/s)", "difference  (%)")
    data.set_yscale("symlog", linthresh=10)
    data.axvspan(runs.FIT_RATES[-1] * 1.8, runs.FURTHER_RATE * 1.5, color="#f3ead8", zorder=0)
    data.annotate("not measured", (runs.FURTHER_RATE * 0.55, 0.03), ha="center", fontsize=8,
                  xycoords=("data", "axes fraction"))
    data.yaxis.set_major_formatter(lambda y, _: f"{y:g}")
    law.set_ylim(0, None)
    law.legend(frameon=False, fontsize=8.5)
    plot_margin = data.get_xlim()
    data.set_xlim(plot_margin[0], runs.FURTHER_RATE * 1.5)
    return finish(figure, results, "fits")
