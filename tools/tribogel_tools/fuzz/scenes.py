"""Scenes for tools/fuzz: the options as the program lists them, and sensible scenes that are over in a
moment."""
import dataclasses
import math
import re

PHASES_AT_MOST = 3


@dataclasses.dataclass(frozen=True)
class Option:
    """A row of the page that -help markdown prints."""
    name: str
    kind: str  # real, integer, reals, choice, flag, path
    low: float  # of numbers; excluded when low_excluded
    high: float
    low_excluded: bool
    count: int  # of numbers in a list; 0: any
    choices: tuple
    default: str


def options_of(page):
    """The options in the tables of the page; a row that is not understood raises ValueError."""
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            for line in page.splitlines() if line.startswith("| `-")]
    options = [parsed(row) for row in rows]
    if not options:
        raise ValueError("the program lists no options")
    return options


def parsed(row):
    name, _, _, allowed, default, _ = row
    name, default = name.strip("`"), default.strip("`")
    kinds = (("a real number", "real"), ("a whole number", "integer"), ("real numbers", "reals"),
             ("nothing, true or false", "flag"), ("a path", "path"))
    count = re.match(r"(\d+) real numbers", allowed)
    text = allowed[len(count.group(1)) + 1:] if count else allowed
    kind = next((kind for start, kind in kinds if text.startswith(start)), "choice")
    bounds = None
    if kind in ("real", "reals", "integer"):
        bounds = re.match(r"[a-z ]*(?:(>=?) (\S+)|(\S+) to ([\d.e+]+))", text)
    low, high, excluded = -math.inf, math.inf, False
    if bounds and bounds.group(1) and "where" not in bounds.group(0):
        low, excluded = float(bounds.group(2).rstrip(",")), bounds.group(1) == ">"
    elif bounds and bounds.group(3):
        low, high = float(bounds.group(3)), float(bounds.group(4))
    choices = tuple(text.split(" or ")) if kind == "choice" else ()
    return Option(name, kind, low, high, excluded, int(count.group(1)) if count else 0, choices, default)


def number(value):
    return f"{value:.6g}"


def listed(values):
    return ",".join(number(value) for value in values)


def between(random, low, high):
    """Uniform in the logarithm."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def ogden(random, stem, bulk):
    """Moduli and exponents of up to three terms with G_r alpha_r > 0, and a bulk modulus well above G."""
    terms = random.randint(1, 3)
    exponents = [random.choice((1.3, 2, 5, -2, 3)) for _ in range(terms)]
    moduli = [math.copysign(between(random, 0.05, 0.8), alpha) for alpha in exponents]
    stiffness = sum(g * alpha for g, alpha in zip(moduli, exponents)) / 2
    return {f"{stem}_ogden_moduli": listed(moduli), f"{stem}_ogden_exponents": listed(exponents),
            bulk: number(stiffness * between(random, 10, 300))}


def material(random, body):
    settings = ogden(random, f"-{body}", f"-{body}_bulk_modulus")
    if random.random() < 0.2:
        return settings | {f"-{body}_material": "hyperelastic"}
    for branch in range(1, random.choice((1, 1, 2, 3)) + 1):
        stem = f"-{body}_maxwell{branch if branch > 1 else ''}"
        settings |= ogden(random, stem, f"{stem}_bulk_modulus")
        settings[f"{stem}_viscosities"] = listed([between(random, 0.5, 20), between(random, 20, 500)])
    return settings


def friction(random, steady):
    """A law that grows with the speed; without a part at rest where a steady state is asked for."""
    if random.random() < 0.1:
        return {"-friction_law": "none"}
    exponents = [random.choice((0, 1, 2) if not steady else (1, 2)) for _ in range(random.randint(1, 3))]
    settings = {"-friction_exponents": listed(exponents),
                "-friction_coefficients": listed([between(random, 1e-6, 5e-3) for _ in exponents])}
    if random.random() < 0.2:
        settings["-friction_pressure_exponent"] = number(random.uniform(0.5, 1))
    if random.random() < 0.2:
        settings["-friction_speed_range"] = f"0,{number(between(random, 1e-3, 10))}"
    return settings


def schedule(random, height, steady):
    """Pressed by up to 8 % of the height, and turned slowly."""
    phases = random.randint(1, PHASES_AT_MOST)
    time, ends = 0, []
    for _ in range(phases):
        time += between(random, 1, 30)
        ends.append(time)
    approach = [height * random.uniform(0.02, 0.08)] * phases
    settings = {"-schedule_end_times": listed(ends), "-schedule_approach": listed(approach)}
    turning = [random.choice((0, 1)) * random.uniform(0, 0.02) for _ in ends]
    if random.random() < 0.2:
        settings["-schedule_twists"] = listed(turning)
    else:
        settings["-schedule_rates"] = listed(turning)
    if steady:
        settings["-schedule_kind"] = "steady"
    return settings


def sensible(random):
    """Settings of a scene that a user may well ask for, on a mesh of a few elements; it must run."""
    steady = random.random() < 0.5
    radius = between(random, 5, 12)
    top, bottom = radius * random.uniform(0.3, 0.6), radius * random.uniform(0.3, 0.6)
    settings = {"-top_radius": number(radius), "-top_height": number(top),
                "-bottom_radius": number(radius * random.uniform(1.1, 1.5)), "-bottom_height": number(bottom),
                "-element_order": random.choice("12"), "-elements_radial": random.choice("123"),
                "-mesh_grading": number(between(random, 1, 30)),
                "-time_tolerance": number(between(random, 0.3, 5))}
    alone = random.random() < 0.25
    if alone:
        settings["-specimens"] = "bottom"
    on_rigid = not alone and random.random() < 0.25
    if on_rigid:
        settings["-counterface"] = "rigid"
    height = bottom if alone else top if on_rigid else top + bottom
    settings |= material(random, "bottom") | schedule(random, height, steady)
    if not alone:
        settings |= material(random, "top") | friction(random, steady)
    extras = {"-plate_contact": random.choice(("true", "false", None)),
              "-checkpoint_every": random.choice(("0", "600")),
              "-maxwell_integrator": random.choice(("sdirk2", "exponential_euler")), "-overwrite": None,
              "-phase_end_tolerance": number(random.uniform(0, 2)), "-model": "axisymmetric",
              "-task": "simulate",
              "-wall_time": number(between(random, 0.05, 50)),
              "-bottom_elements_radial": random.choice("0123"),
              "-contact_integration": "segments",
              "-output_directory": random.choice(("run", "a/b/c", "with blank"))}
    for name in random.sample(sorted(extras), random.randint(0, 4)):
        settings[name] = extras[name]
    return settings


def elements_of(settings, default):
    """About how many elements the mesh of these settings has, or infinity when that cannot be said."""
    def value(name):
        return float(settings.get(name, default[name]))
    try:
        alone = settings.get("-specimens") == "bottom"
        radius = value("-bottom_radius" if alone else "-top_radius")
        along = max(value("-elements_radial"),
                    value("-bottom_elements_radial")) * 2**value("-mesh_refinements")
        heights = value("-top_height") + value("-bottom_height")
        return 2 * along**2 * max(1, heights / radius) * max(1, value("-bottom_radius") / radius)
    except (TypeError, ValueError, ArithmeticError):
        return math.inf
