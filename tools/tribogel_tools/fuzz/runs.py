"""Runs for tools/fuzz that are interrupted, go on after a change, or have no room for their files."""
from .meshes import gels, renumbered, text_of
from .scenes import sensible
from .spoilers import Case

STOPPED = ["-wall_time", "1e-9", "-checkpoint_every", "0"]  # after the first step


def words_of(settings):
    return [word for pair in settings.items() for word in pair if word is not None]


def scene(random):
    """A sensible one that is not stopped by itself, in the directory `run`."""
    settings = sensible(random)
    for name in ("-wall_time", "-output_directory", "-overwrite", "-checkpoint_every"):
        settings.pop(name, None)
    return settings


def goes_on(random, _):
    """Continued as it was, or with what may change."""
    settings = scene(random)
    more = random.choice(([], ["-checkpoint_every", "5"], ["-snes_max_it", "40"], ["-wall_time", "1000"],
                          ["-log_view"]))
    return Case("restart", "runs", words=["-restart", "run", *more],
                first=[*words_of(settings), "-output_directory", "run", *STOPPED])


def goes_on_changed(random, _):
    """Continued as another scene."""
    settings = scene(random)
    name, text = random.choice((("-top_radius", "3"), ("-bottom_height", "1.25"),
                                ("-schedule_end_times", "1e4"), ("-element_order", None),
                                ("-elements_radial", "5"), ("-bottom_bulk_modulus", "777"),
                                ("-model", "solid")))
    if text is None:
        text = "2" if settings["-element_order"] == "1" else "1"
    if settings.get("-specimens") == "bottom" and name == "-top_radius":
        name, text = "-bottom_radius", "3"
    return Case(f"restart with another {name}", "refused", words=["-restart", "run", name, text],
                names=(name,),
                first=[*words_of(settings), "-output_directory", "run", *STOPPED])


def damaged(random, _):
    """The checkpoint or the history of the run has lost its end, or bytes are others."""
    settings = scene(random)
    file = random.choice(("checkpoint.h5", "history.csv"))
    part = random.random()

    def cut(content):
        return content[:int(part * (len(content) - 1))]
    return Case(f"restart from a shorter {file}", "refused", words=["-restart", "run"], names=("-restart",),
                first=[*words_of(settings), "-output_directory", "run", *STOPPED],
                change={f"run/{file}": cut})


def other_mesh(random, _):
    """Continued with the mesh in other words, elsewhere, or with another one."""
    mesh, settings = gels(random)
    before, path = text_of(mesh), "gels.msh"
    about, expected = random.choice((("a node moved", "refused"), ("elements in another order", "refused"),
                                     ("nodes renumbered", "runs"), ("the same mesh elsewhere", "runs")))
    if about == "a node moved":
        at = random.randrange(len(mesh.nodes))
        mesh.nodes[at] = tuple(x * (1 + 1e-3 * random.random()) + 1e-4 for x in mesh.nodes[at])
    elif about == "elements in another order":
        mesh.elements.reverse()
    elif about == "the same mesh elsewhere":
        path = "there/other.msh"
    after = renumbered(random, mesh) if about == "nodes renumbered" else text_of(mesh)
    return Case(f"restart with {about}", expected, names=("mesh",), files={"gels.msh": before.encode()},
                first=[*words_of(settings), "-output_directory", "run", *STOPPED],
                change={path: after.encode()},
                words=["-restart", "run", *(["-mesh_file", path] if path != "gels.msh" else [])])


def no_room(random, _):
    """A file of the run may grow to so many bytes and no further."""
    settings = scene(random)
    return Case("no room for a file", "either",
                list((settings | {"-checkpoint_every": random.choice(("0", "600")),
                                  "-output_directory": "run"}).items()),
                room=random.choice((0, random.randint(1, 3000), random.randint(3000, 60000))))


def unusual_line_ends(random, _):
    """Read as lines, or refused by the file's name; never the rest of the file as a remark."""
    end = random.choice(("\r", "\u2028", "\u2029", "\u0085", "\v", "\f", "\r\r\n"))
    mark, settings = random.choice(("", "", "\ufeff")), scene(random)
    lines = [" ".join(filter(None, pair)) for pair in settings.items()]
    text = mark + end.join(["# a scene", *lines]) + end
    return Case(f"file with lines that end in {end!r}{' after a mark' if mark else ''}", "either",
                names=("unusual.opts",),
                words=["-options_file", "unusual.opts"], files={"unusual.opts": text.encode()},
                asked=settings)
