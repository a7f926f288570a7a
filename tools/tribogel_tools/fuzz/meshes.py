"""Mesh files for tools/fuzz: two small gels of solids as tools/specimen-mesh makes them, written as other
programs may write the same mesh, or spoiled."""
import argparse
import io

from .scenes import between, number
from .spoilers import Case
from ..specimen_mesh import GROUPS, specimens

BRICKS = {5: 8, 17: 20, 12: 27}  # Gmsh's types of hexahedra: nodes
TURN = (1, 2, 3, 0, 5, 6, 7, 4)  # the corners of a brick turned by a quarter about its own axis
ENDS = ("\n", "\r\n", "\r")


def gels(random):
    """The mesh, and the options of its scene."""
    order, top, bottom = random.choice((1, 1, 2)), between(random, 2, 5), between(random, 2, 5)
    shape = argparse.Namespace(shape=random.choice(("round", "square", "ellipse")),
                               radius=between(random, 6, 10), height=top,
                               bottom_radius=16, bottom_height=bottom, gap=0, ratio=random.uniform(1, 1.3),
                               elements=2,
                               layers=random.choice((1, 2)), order=order)
    approach = number((top + bottom) * random.uniform(0.01, 0.04))
    settings = {"-model": "solid", "-mesh_file": "gels.msh", "-element_order": str(order),
                "-plate_contact": "false", "-top_material": "hyperelastic",
                "-bottom_material": "hyperelastic", "-friction_coefficients": "1e-3",
                "-friction_exponents": "1", "-schedule_end_times": "1", "-schedule_approach": approach,
                "-schedule_rates": "0", "-time_tolerance": "5"}
    return specimens(shape), settings


def text_of(mesh):
    stream = io.StringIO()
    mesh.write(stream)
    return stream.getvalue()


def bricks_of(mesh, group=None):
    return [k for k, (kind, at, _) in enumerate(mesh.elements)
            if kind in BRICKS and (group is None or GROUPS[at - 1] == group)]


def faces_of(mesh, group):
    return [k for k, (_, at, _) in enumerate(mesh.elements) if GROUPS[at - 1] == group]


# The same mesh in other words: each takes the mesh and changes it or the text it will have.

def renumbered(random, mesh):
    order = list(range(len(mesh.nodes)))
    random.shuffle(order)
    new = {old + 1: at + 1 for at, old in enumerate(order)}
    mesh.nodes = [mesh.nodes[old] for old in order]
    mesh.elements = [(kind, group, [new[node] for node in nodes]) for kind, group, nodes in mesh.elements]
    return text_of(mesh)


def in_any_order(random, mesh):
    random.shuffle(mesh.elements)
    return text_of(mesh)


def turned_bricks(random, mesh):
    """Elements of order 1 may begin at any corner."""
    for k in bricks_of(mesh):
        kind, group, nodes = mesh.elements[k]
        if kind == 5 and random.random() < 0.5:
            mesh.elements[k] = (kind, group, [nodes[c] for c in TURN])
    return text_of(mesh)


def with_more_nodes(random, mesh):
    """Nodes that no element has."""
    for _ in range(random.randint(1, 5)):
        mesh.nodes.append((random.uniform(-99, 99), 0, random.uniform(-99, 99)))
    return text_of(mesh)


def names_last(_, mesh):
    text = text_of(mesh)
    begin, end = text.index("$PhysicalNames"), text.index("$Nodes")
    return text[:begin] + text[end:] + text[begin:end]


def with_remarks(random, mesh):
    text = text_of(mesh)
    more = random.choice(("$Comments\nmade by hand\n$EndComments\n", "$Periodic\n0\n$EndPeriodic\n"))
    return text.replace("$Nodes", more + "$Nodes", 1) if random.random() < 0.5 else text + more


def other_line_ends(random, mesh):
    return text_of(mesh).replace("\n", random.choice(ENDS[:2]))


# Spoiled: each returns the text and names one of which a refusal must hold.

def loosened(random, mesh):
    """Some bricks of one gel get nodes of their own where they had those of their neighbours."""
    body = random.choice(("top", "bottom"))
    bricks = bricks_of(mesh, body)
    own = {}
    for k in random.sample(bricks, random.randint(1, len(bricks) - 1)):
        kind, group, nodes = mesh.elements[k]
        for node in nodes:
            if node not in own:
                mesh.nodes.append(mesh.nodes[node - 1])
                own[node] = len(mesh.nodes)
        mesh.elements[k] = (kind, group, [own[node] for node in nodes])
    return text_of(mesh), (body, "element", "plate", "contact")


def other_name(random, mesh):
    name = random.choice(GROUPS)
    other = random.choice((name.upper(), name.title(), name + " ", " " + name, name[:-1], name + "2"))
    return text_of(mesh).replace(f'"{name}"', f'"{other}"'), (name,)


def folded(random, mesh):
    kind, _, nodes = mesh.elements[random.choice(bricks_of(mesh))]
    a, b = random.sample(nodes[:8] if kind == 5 else nodes[:8], 2)
    mesh.nodes[a - 1], mesh.nodes[b - 1] = mesh.nodes[b - 1], mesh.nodes[a - 1]
    return text_of(mesh), ("element", "top", "bottom")


def far_middle(random, mesh):
    """A node of order 2 in the middle of nowhere."""
    _, _, nodes = mesh.elements[random.choice(bricks_of(mesh))]
    if len(nodes) == 8:
        return folded(random, mesh)
    mesh.nodes[random.choice(nodes[8:]) - 1] = (0, 0, random.uniform(20, 50))
    return text_of(mesh), ("element", "top", "bottom")


def other_elements(random, mesh):
    kind = random.choice((2, 4, 6, 7, 11, 999, -5))
    at = random.choice(bricks_of(mesh))
    _, group, nodes = mesh.elements[at]
    mesh.elements[at] = (kind, group, nodes)
    return text_of(mesh), ("type", "line", "element")


def without_last_lines(random, mesh):
    lines = text_of(mesh).splitlines(keepends=True)
    left = "".join(lines[:random.randrange(len(lines) - 1)])
    return left, ("line", "$", "physical", "node", "element", "ends")


def no_such_node(random, mesh):
    _, _, nodes = mesh.elements[random.choice(bricks_of(mesh))]
    nodes[random.randrange(len(nodes))] = len(mesh.nodes) + random.randint(1, 9)
    return text_of(mesh), ("node",)


# Suspicious: refused, or told of.

def without_faces(random, mesh):
    """Some faces of one group are in none."""
    group = random.choice(GROUPS[2:])
    faces = faces_of(mesh, group)
    gone = set(random.sample(faces, random.randint(1, len(faces) - 1)))
    mesh.elements = [element for k, element in enumerate(mesh.elements) if k not in gone]
    return text_of(mesh), (group,)


def moved(random, mesh):
    """In micrometres, or the axis far outside."""
    shift, scale = random.choice(((0, 1000), (60, 1), (0, 1e-3)))
    mesh.nodes = [(scale * (x + shift), scale * y, scale * z) for x, y, z in mesh.nodes]
    return text_of(mesh), ("mm",)


SAME = (renumbered, in_any_order, turned_bricks, with_more_nodes, names_last, with_remarks, other_line_ends)
SPOILED = (loosened, other_name, folded, far_middle, other_elements, without_last_lines, no_such_node)
SUSPICIOUS = (without_faces, moved)


def same_mesh(random, _):
    """N must be that of the mesh as it was."""
    mesh, settings = gels(random)
    before, how = text_of(mesh), random.choice(SAME)
    words = [word for pair in settings.items() for word in pair]
    return Case(f"mesh {how.__name__.replace('_', ' ')}", "runs", words=[*words, "-output_directory", "run"],
                first=[*words, "-output_directory", "first"], files={"gels.msh": before.encode()},
                change={"gels.msh": how(random, mesh).encode()}, same_as_first=True)


def spoiled_mesh(random, _):
    mesh, settings = gels(random)
    how = random.choice(SPOILED)
    text, names = how(random, mesh)
    return Case(f"mesh {how.__name__.replace('_', ' ')}", "refused", list(settings.items()),
                names=(*names, "-mesh_file"),
                files={"gels.msh": text.encode()})


def suspicious_mesh(random, _):
    mesh, settings = gels(random)
    how = random.choice(SUSPICIOUS)
    text, names = how(random, mesh)
    return Case(f"mesh {how.__name__.replace('_', ' ')}", "told", list(settings.items()), names=names,
                files={"gels.msh": text.encode()})


def damaged_mesh(random, _):
    """Bytes that are others: what it then says may be right or wrong."""
    mesh, settings = gels(random)
    text = bytearray(text_of(mesh).encode())
    for _ in range(random.randint(1, 4)):
        text[random.randrange(len(text))] = random.choice((random.randrange(256), *b"0123456789 -.\n"))
    return Case("mesh with bytes changed", "either", list((settings | {"-wall_time": "5"}).items()),
                files={"gels.msh": bytes(text)})
