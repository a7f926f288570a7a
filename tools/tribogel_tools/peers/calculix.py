"""Two cylinders in CalculiX: an input file from our own mesh, and what its output files say.

Bonded plates are prescribed displacements; the turn is made of several steps, because within a step they are
linear in time, so that each node moves along a chord. Mortar contact with hard pressure and regularised
Coulomb friction."""
import math
import re
import subprocess

import numpy

TURN_STEPS = 4
# of the friction, shear stress over slip in stick [MPa/mm]: 200 times the shear modulus over 1 mm
STICK_SLOPE = 100
# From lexicographic nodes to CalculiX's numbering.
CORNERS = (0, 1, 3, 2, 4, 5, 7, 6)
TWENTY = (0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15)
ELEMENTS = {"C3D8": 1, "C3D8I": 1, "C3D20": 2, "C3D20R": 2}


def listed(numbers, ids):
    flat = [str(ids[n]) for n in numbers]
    return "".join(", ".join(flat[k:k + 12]) + ("," if k + 12 < len(flat) else "") + "\n"
                   for k in range(0, len(flat), 12))


def write_input(path, bodies, scene, element):
    """Returns the free displacements."""
    order, used, lines = ELEMENTS[element], TWENTY if ELEMENTS[element] == 2 else CORNERS, []
    ids, count, cell_count = [], 0, 0
    faces = {}
    lines.append("*NODE, NSET=ALL\n")
    for body in bodies:
        taken = numpy.unique(body.cells[:, used])
        ids.append({int(n): count + k + 1 for k, n in enumerate(taken)})
        count += len(taken)
        lines += [f"{ids[-1][int(n)]}, " + ", ".join(f"{x:.15g}" for x in body.nodes[n]) + "\n"
                  for n in taken]
    for name, body, own, height in (("BOTTOM", bodies[0], ids[0], 0), ("TOP", bodies[1], ids[1], 0)):
        lines.append(f"*ELEMENT, TYPE={element}, ELSET={name}\n")
        faces[name] = []
        for cell in body.cells:
            cell_count += 1
            nodes = [str(own[int(cell[k])]) for k in used]
            lines += [f"{cell_count}, " + ", ".join(nodes[:10])
                      + (",\n" + ", ".join(nodes[10:]) if order == 2 else "") + "\n"]
            on = numpy.abs(body.nodes[cell][:, 2] - height) < 1e-9
            if on.sum() == (order + 1) ** 2:
                faces[name].append((cell_count, "S1" if on[0] else "S2"))
    plates = []
    for name, body, own, height in (("BOTTOMPLATE", bodies[0], ids[0], -scene["bottom_height"]),
                                    ("TOPPLATE", bodies[1], ids[1], scene["top_height"])):
        plates.append([int(n) for n in body.at(height) if int(n) in own])
        lines += [f"*NSET, NSET={name}\n", listed(plates[-1], own)]
    for name in ("BOTTOM", "TOP"):
        lines += [f"*SURFACE, NAME={name}FACE\n", *(f"{cell}, {face}\n" for cell, face in faces[name])]
        lines += [f"*MATERIAL, NAME={name}\n*HYPERELASTIC, NEO HOOKE\n{scene['G'] / 2:.15g}, "
                  f"{2 / scene['K']:.15g}\n",
                  f"*SOLID SECTION, ELSET={name}, MATERIAL={name}\n"]
    lines.append("*SURFACE INTERACTION, NAME=CONTACT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n"
                 f"*FRICTION\n{scene['mu']:.15g}, {STICK_SLOPE}\n"
                 "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=MORTAR\nTOPFACE, BOTTOMFACE\n")
    for step in range(TURN_STEPS + 1):
        angle = scene["turn"] * step / TURN_STEPS
        first = 0.25 if step == 0 else 0.5
        lines.append(f"*STEP, NLGEOM, INC=200\n*STATIC, SOLVER=SPOOLES\n{first}, 1., 1e-3, "
                     f"{first}\n*BOUNDARY\nBOTTOMPLATE, 1, 3, 0.\n")
        for n in plates[1]:
            x, y, _ = bodies[1].nodes[n]
            moved = (math.cos(angle) * x - math.sin(angle) * y - x,
                     math.sin(angle) * x + math.cos(angle) * y - y,
                     -scene["approach"])
            lines += [f"{ids[1][n]}, {i + 1}, {i + 1}, {u:.15g}\n" for i, u in enumerate(moved)]
        lines.append("*NODE PRINT, NSET=TOPPLATE, FREQUENCY=1000\nRF\n*END STEP\n")
    path.write_text("".join(lines), encoding="utf-8")
    return 3 * (count - len(plates[0]) - len(plates[1])), {ids[1][n]: bodies[1].nodes[n] for n in plates[1]}


def forces(path, plate, scene):
    """N and T of the last complete turn in a .dat file."""
    blocks = re.split(r"\n forces[^\n]*TOPPLATE and time\s+(\S+)\n", path.read_text(encoding="utf-8"))
    if len(blocks) < 2 * (TURN_STEPS + 1) + 1:
        raise ValueError("no forces at the end")
    N = T = 0.0
    c, s = math.cos(scene["turn"]), math.sin(scene["turn"])
    for line in blocks[-1].splitlines():
        words = line.split()
        if len(words) != 4:
            continue
        x, y, _ = plate[int(words[0])]
        f = [float(w) for w in words[1:]]
        N -= f[2]
        T += (c * x - s * y) * f[1] - (s * x + c * y) * f[0]
    return N, T


def run(directory, bodies, scene, element, timeout, environment):
    """Free displacements, N, T, Newton iterations and what went wrong (None: nothing)."""
    unknowns, plate = write_input(directory / "scene.inp", bodies, scene, element)
    try:
        with open(directory / "program.log", "w", encoding="utf-8") as log:
            done = subprocess.run(["ccx", "scene"], cwd=directory, stdout=log, stderr=subprocess.STDOUT,
                                  timeout=timeout,
                                  stdin=subprocess.DEVNULL, env=environment, check=False)
        failure = f"status {done.returncode}" if done.returncode else None
    except subprocess.TimeoutExpired:
        failure = f"stopped after {timeout:g} s"
    iterations, said = 0, (directory / "program.log").read_text(encoding="utf-8", errors="replace")
    cvg = directory / "scene.cvg"
    if cvg.is_file():
        iterations = sum(1 for line in cvg.read_text(encoding="utf-8").splitlines()
                         if re.match(r"\s+\d", line))
    N = T = math.nan
    try:
        N, T = forces(directory / "scene.dat", plate, scene)
    except (OSError, ValueError) as error:
        errors = [line.strip() for line in said.splitlines() if "*ERROR" in line]
        failure = failure or (errors[-1] if errors else str(error))
    return unknowns, N, T, iterations, failure
