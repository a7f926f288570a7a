"""The report's first table: what the paper says, whether it comes out, and by how much. Rows of verdict,
statement, measured and the section where more is said."""
from . import runs, sensitivity
from .sections import per_cent, reduced_torque
from .values import peak, rise_time

CENTRE, RIM = (f"bottom_surface_{place}_displacement_mm" for place in ("centre", "rim"))
LAWS = ("table2_case1", "table2_case2", "table2_case3")
PAIRS = ("fig12_ve_ve", "fig12_he_ve", "fig12_he_he")
RIGHT_FORMS = ("b0_b1", "b0_b1_b2")  # these can be the hidden law


def verdict(true):
    return "holds" if true else "does not hold"


def of_forces(results):
    gel, run = results.shown("fig05"), results.shown("fig06")
    error = results.number("fig06", lambda r: r.force(5)).error
    forces = [results.shown(case).force(5)
              for case in (*LAWS, "fig06")] + [results.of("frictionless/1").force(5)]
    spread = max(forces) - min(forces)
    change = run.force(5) - run.force(2)
    jumps = [run.torque(k) / run.torque(k - 1) for k in (4, 5)]
    slowest = max(rise_time(run, k) for k in (3, 4, 5))
    rise = gel.force(4) - gel.force(2)
    return [
        (verdict(rise > 0), "Fig. 5: N rises when the torque is applied",
         f"by {rise:.3f} N, {100 * rise / gel.force(2):.2f} %, for 0.1 rad; as the square of the twist",
         "fig05"),
        (verdict(abs(change) < error), "Fig. 6: N stays constant when rotation is applied",
         f"changes by {change:.4f} N; error of N {error:.2g} N", "fig06"),
        (verdict(min(jumps) > 9.9 and slowest < 9), "Fig. 6: T jumps with the rate",
         f"by factors {jumps[0]:.3f} and {jumps[1]:.3f}, within {1e3 * slowest:.0f} ms of phases of 900 s",
         "fig06"),
        (verdict(spread < error), "Fig. 10: N does not depend on the friction",
         f"laws of Table 2, of Fig. 6 and none: within {spread:.4f} N; error of N {error:.2g} N", "fig10"),
    ]


def of_coefficients(results):
    run, constant = results.shown("fig06"), results.shown("table2_case3")
    over = {name: run.end(5, "mu_apparent") / run.end(5, f"mu_{name}")
            for name in ("pressure_weighted", "area_weighted", "mean")}
    at_low_rate = constant.end(3, "mu_apparent") / constant.end(3, "mu_pressure_weighted")
    return [
        (verdict(1 < over["pressure_weighted"] < 1.05),
         "Fig. 7: (3.11) slightly overestimates the weighted coefficient: weights p dA",
         per_cent(over["pressure_weighted"]), "fig07"),
        (verdict(over["area_weighted"] > 1), "the same: weights dA", per_cent(over["area_weighted"]),
         "fig07"),
        (verdict(over["mean"] > 1), "the same: mean over the nodes",
         per_cent(over["mean"]) + ", depends on the mesh",
         "fig07"),
        ("sensitive", "the same, to the law: where b0 rules (case 3 at 0.01 rad/s), weights p dA",
         per_cent(at_low_rate),
         "fig07"),
    ]


def of_friction(results):
    tops = [reduced_torque()(results.shown(case)) for case in LAWS]
    listed = ", ".join(f"{1e3 * top:.3f}" for top in tops)
    pairs = [results.shown(case) for case in PAIRS]
    spread = max(abs(run.end(k, column) / pairs[0].end(k, column) - 1) for k in (3, 4, 5) for run in pairs
                 for column in ("normal_force_N", "torque_Nmm", "mu_apparent"))
    peaks = [peak(run) / run.force() for run in pairs]
    return [
        (verdict(max(tops) > 2 * min(tops)), "Fig. 10: T depends strongly on the law",
         f"T/Tref at 1 rad/s: {listed} · 10⁻³", "fig10"),
        (verdict(max(tops) > 2e-3), "Fig. 10's torque axis, to 2.5·10⁻³, fits Table 2",
         f"Table 2 gives no more than {1e3 * max(tops):.2f} · 10⁻³, in any gel", "fig10"),
        (verdict(spread < 1e-4), "Figs. 12, 13: long-time values do not depend on the viscosity",
         f"N, T, μ of the three pairs within {spread:.0e}, relative", "fig12"),
        (verdict(peaks[2] < 1.01 < peaks[0]), "Fig. 12: hyperelastic gels cannot show the relaxation",
         "largest N/Nref " + ", ".join(f"{p:.3f}" for p in peaks), "fig12"),
    ]


def of_assumptions(results):
    run, printed, softer = (results.shown(case)
                            for case in ("fig06", "table1_as_printed", "table1_reading_c"))
    off = [abs(run.end(2, column) / value - 1) for column, value in ((CENTRE, 0.31151), (RIM, 0.12338))]
    hidden, right = results.of("fit/hidden"), results.of("fit/b0_b1")
    to_height = sensitivity.read(results.output)["top height"][1]
    worst = max(abs(fitted.torque_over_force(k + 1) / hidden.torque_over_force(k + 1) - 1)
                for form, fitted in results.fits().items() if form not in RIGHT_FORMS
                for k in range(len(runs.FIT_RATES)))
    bias = ", ".join(per_cent(b / h, 1) for b, h in zip(right.law[0], hidden.law[0]))
    return [
        (verdict(max(off) < 0.02), "Fig. 8: centre 0.31151, rim 0.12338 mm, radius about 10.9 mm",
         f"{run.end(2, CENTRE):.4f}, {run.end(2, RIM):.4f}, {run.end(2, 'contact_radius_mm'):.2f} mm; "
         "heights were chosen for it", "fig08"),
        (verdict(printed.end(2, "contact_radius_mm") > 10.5), "Table 1 with its printed units",
         f"contact radius {printed.end(2, 'contact_radius_mm'):.2f} mm, largest N/Nref "
         f"{peak(printed) / printed.force():.3f}", "readings"),
        ("sensitive", "N, to G2 and G3 in Pa instead of MPa",
         f"{softer.force():.1f} N instead of {run.force():.1f}; T/Tref "
         + per_cent(reduced_torque()(softer) / reduced_torque()(run)), "readings"),
        ("sensitive", "N and T, to the height of the top gel",
         f"{to_height['N', 3][0]:+.2f} and {to_height['T', 3][0]:+.2f} % per %", "sensitivity"),
        (verdict(worst > 0.1), "Section 5: the assumed form of the law biases what is found",
         f"wrong forms miss measured torques by up to {100 * worst:.0f} %; the right one finds b0, b1 to "
         f"{bias}", "fits"),
        ("not given",
         "heights, compression, mesh, steps, branch's bulk modulus, Fig. 5's twist, all measurements",
         "assumed, or not compared", "doubts"),
    ]


def all_of_them(results):
    return [row for part in (of_forces, of_coefficients, of_friction, of_assumptions)
            for row in part(results)]
