"""Meshes from files."""
import functools
import pathlib
import re
import subprocess

from .scenes import BRIEF, SOLID

TOOLS = pathlib.Path(__file__).resolve().parents[3] / "tools"

REFUSALS = [
    ("mesh file that is not there", SOLID + ["-mesh_file", "no/such.msh"],
     ["-mesh_file = no/such.msh", "does not exist", "working directory"]),
    ("mesh file that is a directory", SOLID + ["-mesh_file", "a_run"],
     ["-mesh_file = a_run", "no regular file"]),
    ("mesh file that is none", SOLID + ["-mesh_file", "a_file"],
     ["-mesh_file = a_file: line 1", "format 2.2 or 4.1"]),
    ("mesh file not named", SOLID + ["-mesh_file"], ["-mesh_file: value missing"]),
    ("mesh file of tetrahedra", SOLID + ["-mesh_file", "tetrahedra.msh"],
     ["-mesh_file = tetrahedra.msh: line ", "type 4 (tetrahedron)", "hexahedra"]),
    ("mesh file without a group", SOLID + ["-mesh_file", "nameless.msh"],
     ["-mesh_file = nameless.msh: no physical surface 'top_contact'; there is a surface 'Top contact': "
      "names are taken to the letter; the file has volumes 'top', 'bottom' and surfaces 'top_plate', "]),
    ("mesh file with an inner face", SOLID + ["-mesh_file", "inner.msh"],
     ["-mesh_file = inner.msh: element ", "of top_contact is not on the boundary of top"]),
    ("mesh file with an inclined plate", SOLID + ["-mesh_file", "inclined.msh"],
     ["-mesh_file = inclined.msh: bottom_plate reaches from z = -4", "horizontal plane"]),
    ("mesh file that is too low", SOLID + ["-mesh_file", "low.msh"],
     ["-mesh_file = low.msh: bottom_contact has its highest point at z = -1 mm", "z = 0"]),
    ("mesh file of overlapping gels", SOLID + ["-mesh_file", "overlapping.msh"],
     ["-mesh_file = overlapping.msh: top_contact has its lowest point at z = -0.5 mm", "z >= 0"]),
    ("mesh file of a gel over the edge", SOLID + ["-mesh_file", "over_the_edge.msh"],
     ["-mesh_file = over_the_edge.msh: before the gels are pressed, ", "above the bottom gel's"]),
    ("mesh file of a gel over the edge by the offset",
     SOLID + ["-mesh_file", "good.msh", "-top_offset", "12,0"],
     ["-top_offset = 12,0: before the gels are pressed, "]),
    ("mesh file of parts that are not joined", SOLID + ["-mesh_file", "apart.msh"],
     ["-mesh_file = apart.msh: faces of bottom lie on other faces of it", "(8, e.g. that of element"]),
    ("mesh file without a contact face", SOLID + ["-mesh_file", "lacking.msh"],
     ["-mesh_file = lacking.msh: top_contact lacks faces of top: 78.54 mm^2, 25 %"]),  # of 100 pi
    ("mesh file of two gels for one", SOLID + ["-mesh_file", "good.msh", "-specimens", "bottom"],
     ["-mesh_file = good.msh: element ", "of top_plate is not on the boundary of bottom"]),
    ("more approach than the mesh file's height",
     SOLID + ["-mesh_file", "good.msh", "-schedule_approach", "9,9,9,9,9"],
     ["-schedule_approach = 9,9,9,9,9", "8.4 mm"]),
    ("mesh file in the half plane", ["-mesh_file", "good.msh"], ["-mesh_file = good.msh", "-model solid"]),
    ("steady state of a mesh file", SOLID + ["-mesh_file", "good.msh", "-schedule_kind", "steady"],
     ["-schedule_kind = steady", "-mesh_file", "transient"]),
]

ON_TWO_PROCESSES = {"mesh file that is none", "mesh file without a contact face",
                    "more approach than the mesh file's height"}

RUNS = [
    ("mesh file with a face that is meant to be free", SOLID + ["-mesh_file", "free.msh"] + BRIEF,
     ["warning: -mesh_file = free.msh: top_contact lacks faces of top: 78.54 mm^2, 25 %", "'free'"]),
    ("mesh file with sizes",
     SOLID + ["-mesh_file", "good.msh", "-top_radius", "3", "-mesh_grading", "9"] + BRIEF,
     ["note: without effect with -mesh_file: -top_radius, -mesh_grading", "mesh of good.msh"]),
    ("mesh file on a rigid plane", SOLID + ["-mesh_file", "good.msh", "-counterface", "rigid"] + BRIEF,
     ["One gel, bonded to the top plate", "not in the physical volume top are left out"]),
    ("mesh file in micrometres", SOLID + ["-mesh_file", "micrometres.msh"] + BRIEF,
     ["warning: -mesh_file = micrometres.msh stands for -top_radius = 1e+04 mm, -top_height = 4400 mm, "
      "-bottom_radius = ",
      "micrometres?"]),
    ("mesh file beside the axis", SOLID + ["-mesh_file", "beside.msh"] + BRIEF,
     ["warning: -mesh_file = beside.msh: the plates' axis x = y = 0 lies outside of top_contact, which has "
      "its centroid at (30, 40) mm"]),
]


def prepare(directory):
    for name, text in meshes().items():
        (directory / f"{name}.msh").write_text(text)


@functools.cache
def meshes():
    """A mesh file, and ways to spoil it: 27 nodes of the bottom specimen, 27 of the top one, 9 a layer."""
    made = subprocess.run([TOOLS / "specimen-mesh", "square", "--elements", "1", "--bottom-radius", "14"],
                          capture_output=True, text=True, check=True)
    good = made.stdout
    head, tail = good.index("$Nodes\n54\n") + 10, good.index("$EndNodes")

    def moved(where):
        """With `where` of a node's number and place."""
        nodes = [line.split() for line in good[head:tail].splitlines()]
        places = [(n, where(int(n), float(x), float(y), float(z))) for n, x, y, z in nodes]
        return good[:head] + "".join(f"{n} {x} {y} {z}\n" for n, (x, y, z) in places) + good[tail:]

    def apart():
        """The upper layer of the bottom specimen on nodes 55 to 63 in place of 10 to 18."""
        layer = [line.split() for line in good[head:tail].splitlines()[9:18]]
        copies = "".join(f"{int(n) + 45} {x} {y} {z}\n" for n, x, y, z in layer)
        text = good[:tail].replace("$Nodes\n54\n", "$Nodes\n63\n") + copies + good[tail:]
        return re.sub(r"( 5 2 2 2) (1\d) (1\d) (1\d) (1\d)", lambda found: found.group(1) + "".join(
            f" {int(node) + 45}" for node in found.groups()[1:]), text)

    contact = re.search(" 3 2 5 5( .*)", good).group()  # the first face of top_contact
    free = good.replace(contact, contact.replace(" 5 5", " 7 7"))
    inner = " 3 2 5 5 " + " ".join(str(int(node) + 9) for node in contact.split()[4:])
    return {"good": good, "nameless": good.replace('"top_contact"', '"Top contact"'),
            "tetrahedra": good.replace(" 5 2 1 1 ", " 4 2 1 1 ", 1), "inner": good.replace(contact, inner),
            "inclined": moved(lambda n, x, y, z: (x, y, z - 0.1 if n == 1 else z)),
            "low": moved(lambda n, x, y, z: (x, y, z - 1 if n < 28 else z)),
            "overlapping": moved(lambda n, x, y, z: (x, y, z - 0.5 if n > 27 else z)),
            "over_the_edge": moved(lambda n, x, y, z: (x + 12 if n > 27 else x, y, z)),
            "beside": moved(lambda n, x, y, z: (x + 30, y + 40, z)),
            "micrometres": moved(lambda n, x, y, z: (1000 * x, 1000 * y, 1000 * z)),
            "apart": apart(), "lacking": free,
            "free": free.replace("$PhysicalNames\n6\n", '$PhysicalNames\n7\n2 7 "free"\n')}
