"""Two gel cylinders, pressed together and turned, in tribogel, CalculiX and GetFEM: error against cost.

  tools/compare-peers [--ratios 10,100] [--ours 1:4,6,8 --ours 2:2,3] [--calculix C3D8:6,8]
                      [--getfem Q1/P0:4,6] [-- -option value ...]

The scene is options/solid/two_cylinders.opts: hyperelastic, quasi-static, Coulomb friction. All programs get
the same meshes: those of `-model solid -mesh_grading 1`, made again; ELEMENT:N,N,... are an element and edges
along the top radius. One after the other, each with one thread; CPU seconds are user and system time of the
program and its children, meshes and files included. Errors are against the axisymmetric model on the finest
of --limit, which is no exact value: how much it still moves with its mesh is said below the table.

Dofs: free displacements, and multipliers and pressures that the program solves for; iterations: of Newton's
method, those of steps that failed included. Installs calculix-ccx and python3-getfem (tools/install --peers)
unless --installed. Writes compare-peers.md, compare-peers.csv and the runs below --output.
Status: 0, 1 when a run of tribogel did not complete, 2 bad input.
"""
import importlib.util
import json
import math
import os
import shutil
import subprocess
import sys

import numpy

from ..command_line import BadInput, Parser, positives, progress, series_of
from ..program import OPTIONS, cpu_seconds, install, program_of, run
from ..tables import markdown, write_csv
from . import calculix, disc_mesh, peer_getfem

OPTIONS_FILE = OPTIONS / "solid" / "two_cylinders.opts"
ONE_THREAD = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
GETFEM_STEPS = 4  # load steps of the press and of the turn
HEADER = ("K/G", "program", "element", "edges", "dofs", "N [N]", "T [N mm]", "error N [%]", "error T [%]",
          "CPU s", "Newton", "completed")


def scene_of(path, ratio):
    """What the other programs need to know of the options file."""
    words = dict(line.split()[:2] for line in path.read_text(encoding="utf-8").splitlines()
                 if line.startswith("-"))
    number = {name[1:]: float(value.split(",")[-1]) for name, value in words.items()
              if value.replace(",", "").replace(".", "").replace("-", "").isdigit()}
    return {**{name: number[name] for name in ("top_radius", "top_height", "bottom_radius", "bottom_height")},
            "approach": number["schedule_approach"], "turn": number["schedule_twists"],
            "G": number["top_ogden_moduli"], "mu": number["friction_coefficients"],
            "K": ratio * number["top_ogden_moduli"]}


def nothing(why):
    """Of a run without numbers."""
    return 0, math.nan, math.nan, 0, why


class Comparison:
    def __init__(self, arguments, program):
        self.a, self.program, self.rows, self.whole = arguments, program, [], True

    def ours(self, model, order, elements, ratio):
        """Dofs, N, T, iterations, failure."""
        directory = self.a.output / f"tribogel-{model}-{order}-{elements}-{ratio:g}"
        bulk = f"{ratio * scene_of(OPTIONS_FILE, 1)['G']:.12g}"
        words = ["-options_file", OPTIONS_FILE, "-model", model, "-element_order", order, "-elements_radial",
                 str(elements),
                 "-top_bulk_modulus", bulk, "-bottom_bulk_modulus", bulk, *self.a.further]
        ended = run(self.program, words, directory, time_limit=self.a.timeout)
        summary = ended.summary()
        if ended.timed_out or not summary:
            return nothing(ended.failure or "no summary")
        counts, end = summary["counts"], {} if ended.status else summary["phases"][-1]
        return (counts["unknowns"], end.get("normal_force_N", math.nan), end.get("torque_Nmm", math.nan),
                counts["newton_iterations"], ended.failure)

    def calculix(self, element, elements, scene):
        if not shutil.which("ccx"):
            return nothing("not installed")
        directory = self.a.output / f"calculix-{element}-{elements}-{scene['K'] / scene['G']:g}"
        directory.mkdir(parents=True, exist_ok=True)
        bodies = disc_mesh.two_cylinders(scene, elements, calculix.ELEMENTS[element])
        return calculix.run(directory, bodies, scene, element, self.a.timeout, ONE_THREAD)

    def getfem(self, element, elements, scene):
        if not importlib.util.find_spec("getfem"):
            return nothing("not installed")
        path = self.a.output / f"getfem-{element.replace('/', '')}-{elements}-{scene['K'] / scene['G']:g}.npz"
        arrays = {}
        for k, body in enumerate(disc_mesh.two_cylinders(scene, elements, peer_getfem.ELEMENTS[element])):
            arrays |= {f"nodes{k}": body.nodes, f"cells{k}": body.cells}
        numpy.savez(path, scene=json.dumps(scene), **arrays)
        try:
            done = subprocess.run([sys.executable, peer_getfem.__file__, path, element, str(GETFEM_STEPS)],
                                  capture_output=True, text=True, timeout=self.a.timeout, env=ONE_THREAD,
                                  check=False)
            report = json.loads(done.stdout.splitlines()[-1])
        except subprocess.TimeoutExpired:
            return nothing(f"stopped after {self.a.timeout:g} s")
        except (IndexError, ValueError):
            return nothing((done.stderr.strip().splitlines() or ["nothing said"])[-1])
        return report["unknowns"], report["N"], report["T"], report["iterations"], report["failure"]

    def row(self, ratio, program, element, edges, limit, measured):
        cpu, (dofs, N, T, iterations, failure) = measured
        errors = [f"{100 * (x / exact - 1):+.2f}" if limit and x == x else "-"
                  for x, exact in zip((N, T), limit or (0, 0))]
        self.rows.append((f"{ratio:g}", program, element, str(edges), str(dofs), f"{N:.3f}", f"{T:.3f}",
                          *errors, f"{cpu:.1f}",
                          str(iterations), failure or "yes"))
        progress(*self.rows[-1])
        if program == "tribogel" and failure:
            self.whole = False
        return N, T

    def run(self, ratio):
        """Rows of one K/G; the remark on its limit."""
        scene, limit, moved = scene_of(OPTIONS_FILE, ratio), None, ""
        for elements in self.a.limit:
            last, limit = limit, self.row(ratio, "tribogel", "axisymmetric 2", elements, None,
                                          cpu_seconds(self.ours, "axisymmetric", "2", elements, ratio))
            if last:
                moved = (f"K/G = {ratio:g}: N and T are taken to be {limit[0]:.3f} N and {limit[1]:.3f} N "
                         f"mm; they differ by {100 * (limit[0] / last[0] - 1):+.3f} % and "
                         f"{100 * (limit[1] / last[1] - 1):+.3f} % from those of the mesh before.")
        for element, elements in self.a.ours:
            self.row(ratio, "tribogel", f"order {element}", elements, limit,
                     cpu_seconds(self.ours, "solid", element, elements, ratio))
        for program, list_of_runs, start in (("CalculiX", self.a.calculix, self.calculix),
                                             ("GetFEM", self.a.getfem, self.getfem)):
            for element, elements in list_of_runs:
                self.row(ratio, program, element, elements, limit,
                         cpu_seconds(start, element, elements, scene))
        return moved


def parse(words):
    parser = Parser("compare-peers", __doc__)
    add = parser.add_argument
    add("--ratios", default="10,100", help="K/G (default: %(default)s)")
    add("--limit", type=positives, default=[24, 48], help="edges of the axisymmetric meshes (default: 24,48)")
    add("--ours", action="append", metavar="ORDER:N,...", help="default: 1:4,6,8 and 2:2,3")
    add("--calculix", action="append", metavar="ELEMENT:N,...",
        help="default: C3D8:6,8, C3D8I:6 and C3D20R:3; none: :")
    add("--getfem", action="append", metavar="ELEMENT:N,...", help="default: Q1/P0:4,6 and Q2:2,3; none: :")
    add("--timeout", type=float, default=900, help="of each run, wall seconds (default: %(default)s)")
    parser.add_program()
    add("--installed", action="store_true", help="take the other programs as they are, do not install them")
    parser.add_output("compare-peers")
    a = parser.parse(words)
    try:
        a.ratios = [float(word) for word in a.ratios.split(",")]
    except ValueError as error:
        raise BadInput(f"--ratios: {error}") from None
    if min(a.ratios) <= 0:
        raise BadInput("--ratios: allowed: numbers > 0")
    for name, fallback, allowed in (("ours", ["1:4,6,8", "2:2,3"], ("1", "2")),
                                    ("calculix", ["C3D8:6,8", "C3D8I:6", "C3D20R:3"],
                                     tuple(calculix.ELEMENTS)),
                                    ("getfem", ["Q1/P0:4,6", "Q2:2,3"], tuple(peer_getfem.ELEMENTS))):
        setattr(a, name, series_of(getattr(a, name) or fallback, f"--{name}", allowed))
    a.output = a.output.resolve()
    return a


def main(words):
    a = parse(words)
    if (a.calculix or a.getfem) and not a.installed and not install("--peers"):
        progress("compare-peers: the other programs cannot be installed here")
    comparison = Comparison(a, program_of(a.program))
    a.output.mkdir(parents=True, exist_ok=True)
    moved = [comparison.run(ratio) for ratio in a.ratios]
    text = "\n\n".join([markdown(HEADER, comparison.rows, padded=True), *filter(None, moved)]) + "\n"
    (a.output / "compare-peers.md").write_text(text, encoding="utf-8")
    write_csv(a.output / "compare-peers.csv", HEADER, comparison.rows)
    print(text, end="")
    return 0 if comparison.whole else 1
