"""The paper's rheometer in space against the axisymmetric model: steady states on several meshes.

  tools/solid-table [--meshes 1:4 1:6 1:8 2:2 2:3 2:4] [--output DIRECTORY] [-- -option value ...]

A mesh is ORDER:ELEMENTS, the elements along the top radius, uniform. Each run has the paper's three rates and
then nine angles over the turn of one facet of the top gel's rim: what T changes by there is the ripple of
facets that do not match, a torque that hardly depends on the friction and has no mean. Errors are against the
axisymmetric model's default mesh (printed first); in brackets, the axisymmetric model on the same radii and
heights. The observed orders are those of the two last errors of each order of elements. Further options go to
all runs.
Status: 0 when all runs completed, 1 when not, 2 bad input.
"""
import argparse
import math

from .command_line import Parser, progress
from .program import RunFailed, program_of, run
from .tables import row, rule

RATES = (0.01, 0.1, 1)
ANGLES = 8  # of a facet's turn
HEADER = ("order", "elements", "N [N]", *(f"T at {rate} [N mm]" for rate in RATES), "centre [mm]",
          "rim [mm]", "radius [mm]", "error N [%]", "error T [%]", "ripple T [N mm]", "unknowns", "Newton",
          "most", "linear", "CPU [s]", "MB")


def schedule(elements):
    """Steady states at the three rates, then the last one again at angles over the turn of a facet on the
    rim."""
    facets = 8 * max(1, math.ceil(elements / 2))  # on the circumference (src/mesh/cylinder.hpp)
    ends, rates = [100.0, 200.0, 300.0], list(RATES)
    for k in range(ANGLES):
        ends.append(300 + 2 * math.pi / facets * (k + 1) / ANGLES)
        rates.append(1)

    def listed(values):
        return ",".join(f"{value:.17g}" for value in values)
    return ["-schedule_kind", "steady", "-schedule_end_times", listed(ends), "-schedule_rates", listed(rates),
            "-schedule_approach", listed([0.79] * len(ends))]


def solve(program, directory, words):
    ended = run(program, words, directory)
    if ended.status:
        raise RunFailed(f"{directory}: status {ended.status}: {ended.failure}")
    return ended.summary()


def per_cent(value, reference):
    return 100 * (value / reference - 1)


def cells_of(order, elements, solid, flat, limit):
    phases, counts = solid["phases"], solid["counts"]
    torques = [phase["torque_Nmm"] for phase in phases[2:]]
    error = {}
    for name in ("normal_force_N", "torque_Nmm"):
        error[name] = per_cent(phases[2][name], limit["phases"][2][name])
        error[name + "_flat"] = per_cent(flat["phases"][2][name], limit["phases"][2][name])
    cells = (order, elements, f"{phases[2]['normal_force_N']:.2f}",
             *(f"{phase['torque_Nmm']:.4f}" for phase in phases[:3]),
             f"{phases[2]['bottom_surface_centre_displacement_mm']:.4f}",
             f"{phases[2]['bottom_surface_rim_displacement_mm']:.4f}",
             f"{phases[2]['contact_radius_mm']:.3f}",
             f"{error['normal_force_N']:.2f} ({error['normal_force_N_flat']:.2f})",
             f"{error['torque_Nmm']:.2f} ({error['torque_Nmm_flat']:.2f})",
             f"{max(torques) - min(torques):.4f}", counts["unknowns"], counts["newton_iterations"],
             counts["largest_newton_iterations"], counts["linear_iterations"],
             f"{solid['cost']['cpu_s']:.1f}", f"{solid['cost']['peak_memory_MB']:.0f}")
    return cells, [error["normal_force_N"], error["torque_Nmm"]]


def mesh_of(text):
    order, _, elements = text.partition(":")
    if order not in ("1", "2") or not elements.isdigit() or int(elements) < 2:
        raise argparse.ArgumentTypeError(f"{text}: allowed: ORDER:ELEMENTS, order 1 or 2, elements from 2")
    return int(order), int(elements)


def print_table(program, meshes, output, further):
    limit = solve(program, output / "limit", [*schedule(12), *further])
    last = limit["phases"][2]
    print(f"limit: N = {last['normal_force_N']:.3f} N, T = {last['torque_Nmm']:.4f} N mm, centre "
          f"{last['bottom_surface_centre_displacement_mm']:.4f} mm, rim "
          f"{last['bottom_surface_rim_displacement_mm']:.4f} mm, radius {last['contact_radius_mm']:.3f} mm\n")
    print(row(HEADER) + "\n" + rule(len(HEADER)), flush=True)
    errors = {}
    for order, elements in meshes:
        mesh = ["-element_order", str(order), "-elements_radial", str(elements), "-mesh_grading", "1"]
        name = f"order{order}-elements{elements}"
        solid = solve(program, output / name, [*schedule(elements), *mesh, "-model", "solid", *further])
        flat = solve(program, output / (name + "-axisymmetric"), [*schedule(elements), *mesh, *further])
        cells, error = cells_of(order, elements, solid, flat, limit)
        print(row(cells), flush=True)
        errors.setdefault(order, []).append((elements, error))
    return errors


def print_orders(errors):
    for order, rows in errors.items():
        if len(rows) < 2:
            continue
        (coarse, before), (fine, after) = rows[-2:]
        n, t = (math.log(abs(b / a)) / math.log(fine / coarse) for b, a in zip(before, after))
        print(f"\norder {order}, {coarse} to {fine} elements: observed order of N {n:.1f}, of T {t:.1f}")


def main(words):
    parser = Parser("solid-table", __doc__)
    parser.add_argument("--meshes", type=mesh_of, nargs="+",
                        default=[(1, 4), (1, 6), (1, 8), (2, 2), (2, 3), (2, 4)],
                        metavar="ORDER:ELEMENTS")
    parser.add_program()
    parser.add_output("tribogel-solid-table")
    arguments = parser.parse(words)
    program = program_of(arguments.program)
    try:
        print_orders(print_table(program, arguments.meshes, arguments.output, arguments.further))
    except RunFailed as error:
        progress(f"solid-table: {error}")
        return 1
    return 0
