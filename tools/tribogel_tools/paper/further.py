"""What the paper does not show or only hints at: profiles, energy, errors, space, readings of Table 1, four
rates, fits."""
import math

import numpy as np

from . import further_figures, rheometer, runs
from .document import Figure, Heading, Quote, Table, Text
from .sections import ENDS, per_cent, reduced_torque
from .values import Value, peak


def profiles(results):
    run = results.shown("fig06")
    surface = run.surface("top", 5)
    r, v, mu, p = (surface[name] for name in ("r_mm", "sliding_velocity_mm_per_s", "mu", "pressure_MPa"))
    touching = (surface["status"] == "slip") & (surface["pressure_MPa"] > 0)
    rate = run.rates()[-1]
    planar = run.force() / (math.pi * run.radius**2)
    centre = results.number("fig06", lambda a: a.surface("top", 2)["pressure_MPa"][0])
    off = np.max(np.abs(v[touching] / (rate * r[touching]) - 1))
    return [
        Heading("Pressure and sliding speed over the patch", "profiles"),
        Text("Not in the paper. (3.11) assumes uniform pressure on a disc of the radius Rmin; this is what "
             "the simulation has instead."),
        Figure(further_figures.profiles(results),
               f"Left: the gels press {p[0] / np.nanmin(p[touching]):.1f} times as hard in the middle as "
               "near the rim; at the rim itself the top gel's edge makes a peak that grows under "
               "refinement. Middle: once the transient is over, v = ω r to round-off. Right: what turns the "
               "gels."),
        Table(("", "measured"), [
            ("pressure on the axis, at rest", centre.text("kPa", 1e3)),
            ("the same over N/(π Rmin²)", f"{centre.value / planar:.3f}"),
            ("largest departure of v from ω r at 6300 s", f"{off:.0e}"),
            ("largest sliding speed at 1 rad/s",
             f"{np.max(v[touching]):.3f} mm/s, where the law gives μ = {np.max(mu[touching]):.5f}"),
            ("T/(N b1 ω Rmin²): uniform pressure on Rmin 1/2", results.number(
                "fig06", lambda a: a.torque() / (a.force() * 8e-4 * a.radius**2)).text()),
        ]),
    ]


def energy(results):
    balance = results.shown("fig06").summary["balances"]
    rows = [(label, f"{balance[name]:.4g} N mm") for label, name in (
        ("work of the plates", "work_of_plates_Nmm"), ("stored at the end", "stored_energy_Nmm"),
        ("viscous heat", "viscous_dissipation_Nmm"), ("frictional heat", "frictional_dissipation_Nmm"))]
    force, torque = balance["max_normal_force_N"], balance["max_torque_Nmm"]
    return [
        Heading("Energy", "energy"),
        Figure(further_figures.energy(results),
               "Fig. 6's run. The work of the plates is summed independently of the other three."),
        Table(("Fig. 6, at 6300 s", ""), [*rows,
              ("work less the rest, relative", f"{balance['energy_residual_relative']:.0e}"),
              ("plate force against contact tractions, largest",
               f"{balance['max_force_mismatch_N'] / force:.0e} of N"),
              ("plate torque against contact tractions, largest",
               f"{balance['max_torque_mismatch_Nmm'] / torque:.0e} of T")]),
    ]


def errors(results):
    functions = (("N [N]", lambda r: r.force()), ("T [N mm]", lambda r: r.torque()),
                 ("contact radius [mm]", lambda r: r.end(-1, "contact_radius_mm")),
                 ("centre [mm]", lambda r: r.end(-1, "bottom_surface_centre_displacement_mm")),
                 ("rim [mm]", lambda r: r.end(-1, "bottom_surface_rim_displacement_mm")),
                 ("μ apparent [10⁻³]", lambda r: 1e3 * r.end(-1, "mu_apparent")),
                 ("μ, by pressure [10⁻³]", lambda r: 1e3 * r.end(-1, "mu_pressure_weighted")))
    rows = []
    for name, function in functions:
        values, limit = results.mesh_series(function)
        estimate = abs(values[1] - values[0])
        digits = Value(limit.value, limit.uncertainty).decimals()
        rows.append((name, *(f"{v:.{digits}f}" for v in values),
                     "-" if math.isnan(limit.order) else f"{limit.order:.1f}",
                     f"{limit.value:.{digits}f} ± {limit.uncertainty:.{digits}f}",
                     f"{abs(values[1] - limit.value):.1g}",
                     f"{estimate:.1g}"))
    elements = [results.detail.elements * 2**k for k in range(results.detail.levels)]
    return [
        Heading("Errors of mesh and step", "errors"),
        Quote("“All results provided represent spatially-converged numerical approximations to the solution "
              "of the associated boundary-value problem.” Neither mesh nor steps are given."),
        Figure(further_figures.mesh_errors(results),
               "Left: nested meshes against the limits extrapolated from them. Right: what a quarter of the "
               "step tolerance changes."),
        Table(("1 rad/s, Fig. 6", *(f"{n} elements" for n in elements), "order", "limit",
               f"{elements[1]} elements off by",
               "stated ± (mesh)"), rows,
              f"The mesh with {elements[1]} elements along the radius is the one shown throughout. Its ± in "
              "this report is its difference from the next coarser one, as if errors halved with the edge; "
              "where the order is higher, it is too large."),
        Text(f"Steps follow -time_tolerance {results.detail.tolerance:g} %; ± (time) is what a quarter of "
             "it changes, times 4/3, on the coarser mesh. At the ends of long phases it is far below the "
             "mesh's error; it matters for the largest N, while the gels relax. Each phase begins with a "
             f"step of {results.detail.first_step:g} s (-ts_dt), which follows the rise of T after a jump "
             "of the rate; with the program's own first step T overshoots for some milliseconds there, by "
             "2.6 % in Fig. 6."),
        *own_estimate(results),
    ]


def own_estimate(results):
    """What -error_estimate says beside what this report says: N and T at the phases' ends."""
    estimate, rows = results.of("estimate").summary["error_estimate"], []
    for phase, end in enumerate(ENDS, 1):
        cells = []
        for column in ("normal_force_N", "torque_Nmm"):
            here = results.number("fig06", lambda r, k=phase, c=column: r.end(k, c))
            there = estimate["phases"][phase - 1][column]
            # null where there is no companion to compare with
            own = [there[kind]["error"] for kind in ("mesh", "time")]
            pairs = ((here.mesh, own[0]), (here.time, own[1]))
            cells += ["-" if x is None or here.value == 0 else f"{x:.1g}" for pair in pairs for x in pair]
        rows.append((end, *cells))
    names = ("± (mesh)", "-error_estimate", "± (time)", "-error_estimate")
    return [
        Text("The program estimates the errors of N and T itself with -error_estimate, from "
             f"{len(estimate['companions'])} companions of the run that cost {estimate['cpu_s']:.1f} CPU s "
             f"beside its own {results.of('estimate').summary['cost']['cpu_s']:.1f}:"),
        Table(("at the end of", *(f"{quantity}: {name}" for quantity in "NT" for name in names)), rows),
    ]


def in_space(results):
    rows = []
    for case in runs.SOLID_CASES if results.detail.solid_elements else ():
        coarse, fine = (results.of(f"space/{case}_{n}") for n in results.detail.solid_elements)
        flat = results.of(f"space/{case}_{results.detail.solid_elements[-1]}_axisymmetric")
        shown = results.shown(case)
        for name, function in (("N [N]", lambda r: r.force()), ("T [N mm]", lambda r: r.torque())):
            value = Value(function(fine), abs(function(fine) - function(coarse)))
            rows.append((case if name.startswith("N") else "", name, value.text(), f"{function(flat):.4f}",
                         f"{function(shown):.4f}", per_cent(function(fine) / function(flat)),
                         per_cent(function(fine) / function(shown))))
    if not rows:
        return []
    cost = results.of(f"space/fig06_{results.detail.solid_elements[-1]}").summary
    return [
        Heading("In space", "space"),
        Quote("“The finite element formulations ... were implemented using three-dimensional domains "
              "partitioned into eight-node linear brick elements”, for problems that are axisymmetric."),
        Text("Steady states of three cases in space: 27-node hexahedra, "
             f"{results.detail.solid_elements[-1]} along the radius, uniform, {cost['counts']['unknowns']} "
             f"unknowns, {cost['cost']['cpu_s']:.0f} CPU s. Beside them the axisymmetric model on the same "
             "radii and heights, and on the mesh shown elsewhere."),
        Table(("case, 1 rad/s", "", "in space", "axisymmetric, same edges", "axisymmetric, shown",
               "space over same edges", "over shown"), rows),
        Text("Against the same edges in the half plane space differs by the polygons that stand for circles "
             "and by facets that do not match; against the mesh shown, by what coarse uniform edges make of "
             "the rims too. No result of the paper hangs on the third dimension."),
    ]


def readings(results):
    rows = []
    softer = results.shown("fig06").force() / results.shown("table1_reading_c").force()
    for label, case in further_figures.READINGS.items():
        places = [lambda r, c=f"bottom_surface_{c}_displacement_mm": r.end(2, c) for c in ("centre", "rim")]
        functions = (lambda r: r.force(), lambda r: peak(r) / r.force(),
                     lambda r: r.end(2, "contact_radius_mm"), *places)
        rows.append((label, *(results.number(case, function).text() for function in functions),
                     results.number(case, reduced_torque()).text(scale=1e3)))
    return [
        Heading("Table 1, read in three ways", "readings"),
        Quote("Table 1, “quantities are given using N, m, s units”: G1 = 7.5e5, G2 = 0.45, G3 = 0.18, K = "
              "2.0e5, viscosities 4.5 and 200."),
        Figure(further_figures.readings(results),
               "Left: with the viscosities as printed nothing relaxes that an hour could see. Right: with "
               "the moduli as printed (Poisson's ratio -0.17) the contact becomes narrower."),
        Table(("reading", "N [N]", "largest N/Nref", "contact radius [mm]", "centre [mm]", "rim [mm]",
               "T/Tref at 1 rad/s [10⁻³]"), rows,
              "The paper: radius about 10.9 mm, centre 0.31151 mm, rim 0.12338 mm; Fig. 10's axis of N/Nref "
              "ends at 1.4."),
        Text("As printed, K < G, the relaxation time is 28 µs against a hold of an hour, and Fig. 8 and the "
             "relaxation of Figs. 5 and 6 are out of reach. The other two readings both give Fig. 8; they "
             f"differ in N by a factor {softer:.2f} and in the overshoot of N, but not in T/Tref, which is "
             "why friction can be discussed without knowing which it was. An axis to 1.4 would suit an "
             "overshoot of 1.2 rather than one of 1.1: weak evidence for the second reading."),
    ]


def four_rates(results):
    rows = [(f"{rate:g} rad/s", results.number("fig04_four_rates", lambda r, k=k: r.force(k)).text(),
             results.number("fig04_four_rates", lambda r, k=k: r.torque(k)).text(),
             results.number("fig04_four_rates", lambda r, k=k: r.end(k, "mu_apparent")).text(scale=1e3))
            for k, rate in enumerate((*runs.RATES, 10.0), 3)]
    return [
        Heading("The experiments' fourth rate", "fig04"),
        Quote("Experiments “spanned four levels of angular velocity: 0.01, 0.1, 1 and 10 rad/s” (Figs. 2 "
              "and 4); the simulations stop at 1."),
        Figure(further_figures.four_rates(results),
               "Fig. 4's schedule with the law of Fig. 6. The measurements are not printed as numbers."),
        Table(("rate", "N [N]", "T [N mm]", "μ apparent [10⁻³]"), rows),
    ]


def fits(results):
    hidden = results.of("fit/hidden")
    rates = hidden.rates()
    measured = np.array([hidden.torque_over_force(k + 1) for k in range(len(rates))])
    b_hidden, m_hidden = hidden.law
    mu_hidden = rheometer.coefficient(b_hidden, m_hidden, np.array([1.0, 5, 10]))
    rows = []
    for form, run in results.fits().items():
        b, m = run.law
        estimate = np.array([rheometer.torque_ratio(b, m, run.radius, rate) for rate in rates])
        found = np.array([run.torque_over_force(k + 1) for k in range(len(rates))])
        inside = slice(0, len(runs.FIT_RATES))
        misfit = np.sqrt(np.mean((estimate[inside] - measured[inside]) ** 2)) / measured[inside][-1]
        law = rheometer.coefficient(b, m, np.array([1.0, 5, 10])) / mu_hidden
        rows.append((further_figures.FORM_NAMES[form], ", ".join(f"{x:.3g}" for x in b),
                     f"{100 * misfit:.2f} %",
                     *(per_cent(found[k] / measured[k], 1) for k in (0, 2, 4, 5)),
                     *(per_cent(x, 1) for x in law)))
    bias = " and ".join(per_cent(b / h, 1) for b, h in zip(results.of("fit/b0_b1").law[0], b_hidden))
    right, wrong = rows[list(runs.FORMS).index("b0_b1")], rows[list(runs.FORMS).index("b0_b2")]
    return [
        Heading("Section 5: coefficients from torques by least squares", "fits"),
        Quote("“One has first to make a hypothesis on the terms that are present in the friction law ... "
              "that initial assumption on the form of the independent terms one introduces in the law has a "
              "strong influence on the results obtained.”"),
        Text(f"The exercise: a hidden law, case 3 of Table 2, is simulated at {len(runs.FIT_RATES)} rates; "
             "to its T/N laws of assumed forms are fitted by least squares with the planar estimate behind "
             "(3.11), T/N = Σ 2 b ω^m R^(m+1)/(m+3), b ≥ 0; each fitted law is simulated in turn."),
        Figure(further_figures.fits(results),
               "Left: the hidden law (broad grey) and the fitted ones. Right: what the fitted laws give when "
               "simulated, linear within ±10 %, logarithmic beyond; 10 rad/s was not among the measured "
               "rates."),
        Table(("assumed form", "fitted b", "misfit of T/N", "T at 0.01", "T at 0.1", "T at 1",
               "T at 10 rad/s", "μ at 1 mm/s", "at 5", "at 10"), rows,
              "Misfit: root mean square over the measured rates, in per cent of the largest T/N; then "
              "differences from the hidden law, T/N simulated and μ."),
        Text(f"With the right form what is left is the planar estimate's own error, {right[2]} misfit and "
             f"yet b off by {bias}: pressure is not uniform and the contact is wider than Rmin. With the "
             f"wrong form b0 + b2 v² torques are met within {wrong[2]} of the largest; the law is off by "
             f"{wrong[-2]} and {wrong[-1]} at 5 and 10 mm/s, and its torque at 10 rad/s by {wrong[6]}. "
             "Forms without b0 cannot follow the slow rates at all. A term more than the law has does no "
             "harm here, where nothing is noisy."),
    ]
