"""The report: findings first, then a section for each figure and table, then what the paper leaves open."""
from . import further, rheometer, runs, sections
from .document import Findings, Heading, Table, Text, write_html
from .pages import write_pdf
from .sections import per_cent, reduced_torque
from .values import peak, rise_time

TITLE = "Stanciulescu, Laursen et al., Int. J. Solids Struct. 46 (2009) 1334-1344, reproduced with tribogel"
DOUBTS = (
    ("heights of the gels, compression", "4.0 (bottom), 4.4 (top), 0.79 mm", "calibrated to Fig. 8's three numbers; not unique"),
    ("units of Table 1's moduli", "MPa for all G, K = 200 MPa", "literally Poisson's ratio would be -0.17 and the contact would become narrower"),
    ("units of the viscosities", "MPa s", "literally relaxation takes 28 µs; Figs. 5 and 6 show seconds"),
    ("bulk modulus of the Maxwell branch", "that of the equilibrium part", "Table 1 has none"),
    ("sliding speed in the laws", "mm/s", "no units in Table 2; Fig. 9's axis runs to 10, ω Rmin at 1 rad/s"),
    ("mesh and steps", "ours, with errors", "“spatially-converged” is all that is said"),
    ("(3.11), denominator", "b0 R/3", "printed b0/3; (3.13) and the dimension ask for R"),
    ("weights of Fig. 7's average", "all three shown", "“quadrature weights”; with the area's the statement is not true here"),
    ("Fig. 5: size, compression, twist, duration", "10 × 4.4 mm, 0.414 mm, 0.1 rad in 27 s, to 7200 s", "not given"),
    ("which gel is hyperelastic in the mixed pair", "the top one", "“either the top or bottom specimen”"),
    ("hold “over t = 3600 s” after 27 s, rotation from 3600 s", "hold to 3600 s", "both cannot be true"),
    ("which plate turns", "the top one", "section 2 says the bottom one, section 5 the top one; only the difference matters"),
    ("side walls at the plates", "may touch, not penetrate", "not mentioned; without, N does not converge"),
    ("Figs. 2 and 4: measurements", "nothing compared", "not printed as numbers"),
)


def fitted_coefficients(results):
    """Coefficients of each assumed form from the hidden law's T/N at the measured rates."""
    hidden = results.of("fit/hidden")
    ratios = [hidden.torque_over_force(k + 1) for k in range(len(runs.FIT_RATES))]
    return {form: rheometer.fit(m, hidden.radius, runs.FIT_RATES, ratios) for form, m in runs.FORMS.items()}


def verdict(true):
    return "holds" if true else "does not hold"


def findings_of_forces(results):
    fig5, fig6 = results.shown("fig05"), results.shown("fig06")
    error = results.number("fig06", lambda r: r.force(5)).error
    laws = ("table2_case1", "table2_case2", "table2_case3", "fig06")
    forces = [results.shown(case).force(5) for case in laws] + [results.of("frictionless/1").force(5)]
    spread = max(forces) - min(forces)
    change = fig6.force(5) - fig6.force(2)
    jumps = [fig6.torque(k) / fig6.torque(k - 1) for k in (4, 5)]
    slow = max(rise_time(fig6, k) for k in (3, 4, 5))
    rise = fig5.force(4) - fig5.force(2)
    return [
        (verdict(rise > 0), "Fig. 5: N rises when the torque is applied", f"by {rise:.3f} N, {100 * rise / fig5.force(2):.2f} %, for 0.1 rad; as the square of the twist", "fig05"),
        (verdict(abs(change) < error), "Fig. 6: N stays constant when rotation is applied", f"changes by {change:.4f} N; error of N {error:.2g} N", "fig06"),
        (verdict(min(jumps) > 9.9 and slow < 90), "Fig. 6: T jumps with the rate", f"by factors {jumps[0]:.3f} and {jumps[1]:.3f}, within {1e3 * slow:.0f} ms of phases of 900 s", "fig06"),
        (verdict(spread < error), "Fig. 10: N does not depend on the friction", f"laws of Table 2, of Fig. 6 and none: within {spread:.4f} N; error of N {error:.2g} N", "fig10"),
    ]


def findings_of_friction(results):
    run = results.shown("fig06")
    over = {name: run.end(5, "mu_apparent") / run.end(5, f"mu_{name}") for name in ("pressure_weighted", "area_weighted", "mean")}
    tops = [results.shown(case).torque() / (results.shown(case).force() * 10) for case in ("table2_case1", "table2_case2", "table2_case3")]
    pairs = ("fig12_ve_ve", "fig12_he_ve", "fig12_he_he")
    spread = max(abs(results.shown(case).end(k, column) / results.shown(pairs[0]).end(k, column) - 1) for k in (3, 4, 5)
                 for case in pairs for column in ("normal_force_N", "torque_Nmm", "mu_apparent"))
    constant = results.shown("table2_case3").end(3, "mu_apparent") / results.shown("table2_case3").end(3, "mu_pressure_weighted")
    peaks = [peak(results.shown(case)) / results.shown(case).force() for case in pairs]
    return [
        (verdict(1 < over["pressure_weighted"] < 1.05), "Fig. 7: (3.11) slightly overestimates the weighted coefficient: weights p dA", per_cent(over["pressure_weighted"]), "fig07"),
        (verdict(over["area_weighted"] > 1), "the same: weights dA", per_cent(over["area_weighted"]), "fig07"),
        (verdict(over["mean"] > 1), "the same: mean over the nodes", per_cent(over["mean"]) + ", depends on the mesh", "fig07"),
        (verdict(max(tops) > 2 * min(tops)), "Fig. 10: T depends strongly on the law", f"T/Tref at 1 rad/s: {', '.join(f'{1e3 * t:.3f}' for t in tops)} · 10⁻³", "fig10"),
        ("sensitive", "the same, to the law: where b0 rules (case 3 at 0.01 rad/s), weights p dA", per_cent(constant), "fig07"),
        (verdict(max(tops) > 2e-3), "Fig. 10's torque axis, to 2.5·10⁻³, fits Table 2", f"Table 2 gives no more than {1e3 * max(tops):.2f} · 10⁻³, in any gel", "fig10"),
        (verdict(spread < 1e-4), "Figs. 12, 13: long-time values do not depend on the viscosity", f"N, T, μ of the three pairs within {spread:.0e}, relative", "fig12"),
        (verdict(peaks[2] < 1.01 < peaks[0]), "Fig. 12: hyperelastic gels cannot show the relaxation", "largest N/Nref " + ", ".join(f"{p:.3f}" for p in peaks), "fig12"),
    ]


def findings_of_assumptions(results):
    run, printed, third = (results.shown(case) for case in ("fig06", "table1_as_printed", "table1_reading_c"))
    column = "bottom_surface_{}_displacement_mm"
    off = [run.end(2, column.format(place)) / value - 1 for place, value in (("centre", 0.31151), ("rim", 0.12338))]
    hidden = results.of("fit/hidden")
    worst = max(abs(r.torque_over_force(k + 1) / hidden.torque_over_force(k + 1) - 1)
                for form, r in results.fits().items() if form != "b0_b1" and form != "b0_b1_b2" for k in range(len(runs.FIT_RATES)))
    right = results.of("fit/b0_b1")
    bias = [b / h - 1 for b, h in zip(right.law[0], hidden.law[0])]
    return [
        ("holds" if max(map(abs, off)) < 0.02 else "does not hold", "Fig. 8: centre 0.31151, rim 0.12338 mm, radius about 10.9 mm",
         f"{run.end(2, column.format('centre')):.4f}, {run.end(2, column.format('rim')):.4f}, {run.end(2, 'contact_radius_mm'):.2f} mm; heights were chosen for it", "fig08"),
        ("does not hold", "Table 1 with its printed units", f"contact radius {printed.end(2, 'contact_radius_mm'):.2f} mm, largest N/Nref {peak(printed) / printed.force():.3f}", "readings")
        if printed.end(2, "contact_radius_mm") < 10.5 else ("holds", "Table 1 with its printed units", "", "readings"),
        ("sensitive", "N, with G2 and G3 in Pa instead of MPa", f"{third.force():.1f} N instead of {run.force():.1f}; T/Tref {per_cent(reduced_torque()(third) / reduced_torque()(run))}", "readings"),
        (verdict(worst > 0.1), "Section 5: the assumed form of the law biases what is found", f"wrong forms miss measured torques by up to {100 * worst:.0f} %; the right one finds b0, b1 to "
         f"{100 * bias[0]:+.1f}, {100 * bias[1]:+.1f} %", "fits"),
        ("not given", "heights, compression, mesh, steps, branch's bulk modulus, Fig. 5's twist, all measurements", "assumed, or not compared", "doubts"),
    ]


def doubts():
    return [Heading("What cannot be replayed because the paper does not say it", "doubts"),
            Table(("open", "chosen here", "why"), list(DOUBTS)),
            Text("src/PAPER.md in the repository says where each equation of the paper is in the program, which test holds it, and more on each choice.")]


def opening(results):
    count, cpu, steps = runs.cost_of(results.output)
    program = results.shown("fig06").summary["program"]
    return [
        Text(f"Every number below comes from {count} runs of tribogel {program['version']} ({cpu:.0f} CPU seconds, {steps} steps) that the same command wrote beside this page, "
             f"below runs/; each figure is drawn from them. Units: mm, N, s, MPa, rad. A number is followed by its errors: ± (mesh) from two meshes, "
             f"± (time) from two step tolerances; no ± (time) where it is less than a hundredth of the other."),
        Heading("In short", "findings"),
        Findings(findings_of_forces(results) + findings_of_friction(results) + findings_of_assumptions(results)),
        Text("holds: what the paper says comes out. does not hold: it does not, under the reading named. sensitive: it hangs on a choice, by as much as is said. "
             "not given: nothing to compare with."),
    ]


def write(results):
    blocks = opening(results)
    for section in (sections.figure5, sections.figure6, sections.figure7, sections.figure8, sections.figure9, sections.figures10_11,
                    sections.figures12_13, further.fits, further.profiles, further.energy, further.errors, further.in_space,
                    further.readings, further.four_rates):
        blocks += section(results)
    blocks += doubts()
    write_html(TITLE, blocks, results.output / "report.html")
    write_pdf(TITLE, blocks, results.output / "report.pdf")
