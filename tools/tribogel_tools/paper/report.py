"""The report: findings first, then a section for each figure and table, then what the paper leaves open."""
from . import findings, further, rheometer, runs, sections, sensitivity
from .document import Findings, Heading, Table, Text, write_html
from .pages import write_pdf

TITLE = "Stanciulescu, Laursen et al., Int. J. Solids Struct. 46 (2009) 1334-1344, reproduced with tribogel"
DOUBTS = (
    ("heights of the gels, compression", "4.0 (bottom), 4.4 (top), 0.79 mm",
     "calibrated to Fig. 8's three numbers; not unique"),
    ("units of Table 1's moduli", "MPa for all G, K = 200 MPa",
     "literally Poisson's ratio would be -0.17 and the contact would become narrower"),
    ("units of the viscosities", "MPa s", "literally relaxation takes 28 µs; Figs. 5 and 6 show seconds"),
    ("bulk modulus of the Maxwell branch", "that of the equilibrium part", "Table 1 has none"),
    ("sliding speed in the laws", "mm/s", "no units in Table 2; Fig. 9's axis runs to 10, ω Rmin at 1 rad/s"),
    ("mesh and steps", "ours, with errors", "“spatially-converged” is all that is said"),
    ("(3.11), denominator", "b0 R/3", "printed b0/3; (3.13) and the dimension ask for R"),
    ("weights of Fig. 7's average", "all three shown",
     "“quadrature weights”; with the area's the statement is not true here"),
    ("Fig. 5: size, compression, twist, duration", "10 × 4.4 mm, 0.414 mm, 0.1 rad in 27 s, to 7200 s",
     "not given"),
    ("which gel is hyperelastic in the mixed pair", "the top one", "“either the top or bottom specimen”"),
    ("hold “over t = 3600 s” after 27 s, rotation from 3600 s", "hold to 3600 s", "both cannot be true"),
    ("which plate turns", "the top one",
     "section 2 says the bottom one, section 5 the top one; only the difference matters"),
    ("side walls at the plates", "may touch, not penetrate", "not mentioned; without, N does not converge"),
    ("Figs. 2 and 4: measurements", "nothing compared", "not printed as numbers"),
)


def fitted_coefficients(results):
    """Coefficients of each assumed form from the hidden law's T/N at the measured rates."""
    hidden = results.of("fit/hidden")
    ratios = [hidden.torque_over_force(k + 1) for k in range(len(runs.FIT_RATES))]
    return {form: rheometer.fit(m, hidden.radius, runs.FIT_RATES, ratios) for form, m in runs.FORMS.items()}


def doubts():
    return [Heading("What cannot be replayed because the paper does not say it", "doubts"),
            Table(("open", "chosen here", "why"), list(DOUBTS)),
            Text("src/PAPER.md in the repository says where each equation of the paper is in the program, "
                 "which test holds it, and more on each choice.")]


def opening(results):
    count, cpu, steps = runs.cost_of(results.output)
    program = results.shown("fig06").summary["program"]
    return [
        Text(f"Every number below comes from {count} runs of tribogel {program['version']} ({cpu:.0f} CPU "
             f"seconds, {steps} steps) that the same command wrote beside this page, below runs/; each "
             "figure is drawn from them. Units: mm, N, s, MPa, rad. A number is followed by its errors: ± "
             "(mesh) from two meshes, ± (time) from two step tolerances; no ± (time) where it is less than "
             "a hundredth of the other."),
        Heading("In short", "findings"),
        Findings(findings.all_of_them(results)),
        Text("holds: what the paper says comes out. does not hold: it does not, under the reading named. "
             "sensitive: it hangs on a choice, by as much as is said. not given: nothing to compare with."),
    ]


def write(results):
    blocks = opening(results)
    for section in (sections.figure5, sections.figure6, sections.figure7, sections.figure8, sections.figure9,
                    sections.figures10_11, sections.figures12_13, further.fits, sensitivity.section,
                    further.profiles, further.energy, further.errors, further.in_space, further.readings,
                    further.four_rates):
        blocks += section(results)
    blocks += doubts()
    write_html(TITLE, blocks, results.output / "report.html")
    write_pdf(TITLE, blocks, results.output / "report.pdf")
