"""The parameters of a scene, and how each is moved."""
import dataclasses
import math
import re


def text_of(values):
    return ",".join(f"{value:.17g}" for value in values)


def numbers_of(text):
    return [float(word) for word in text.split(",")]


@dataclasses.dataclass(frozen=True)
class Scaled:
    """Entries of one or several options that are scaled together. entry None: all of a list."""
    name: str
    meaning: str
    options: tuple
    entry: int | None = None
    length: bool = False
    central, unit = True, "% per %"

    def moved(self, scene, step):
        words = []
        for option in self.options:
            values = numbers_of(scene.options[option])
            chosen = range(len(values)) if self.entry is None else (self.entry,)
            for k in chosen:
                values[k] *= 1 + step
            words += [f"-{option}", text_of(values)]
        return words

    def weight(self, scene, rate):
        return 1.0


@dataclasses.dataclass(frozen=True)
class Term:
    """A term b v^m of the friction law whose coefficient is 0. It is moved by `step` times mu at the mean
    speed of the contact, v = 2/3 omega R, in the fastest phase. The sensitivity is per cent of T over per
    cent of mu at the mean speed of the phase at hand: what a term does that adds 1 % to mu there. It can be
    compared with that of b1, which is then 1."""
    name: str
    meaning: str
    exponent: float
    length = False
    unit = "per cent of it by a term that adds 1 % to mu at the mean speed, 2/3 omega R, of the phase"

    @property
    def central(self):
        return self.exponent > 0  # less than no friction at rest is refused

    def coefficient(self, scene, step):
        speed = scene.mean_speed(scene.fastest)
        return step * scene.friction(speed) / speed**self.exponent

    def moved(self, scene, step):
        coefficients, exponents = scene.law
        exponents, coefficients = list(exponents), list(coefficients)
        if self.exponent not in exponents:
            exponents.append(self.exponent)
            coefficients.append(0.0)
        coefficients[exponents.index(self.exponent)] += self.coefficient(scene, step)
        return ["-friction_coefficients", text_of(coefficients), "-friction_exponents", text_of(exponents)]

    def weight(self, scene, rate):
        """The change of mu at the mean speed of a phase, relative to mu there, for a step of 1. The absolute
        sensitivity is per unit of mu at that speed."""
        speed = scene.mean_speed(rate)
        if not speed:
            return math.nan
        return self.coefficient(scene, 1.0) * speed**self.exponent / scene.friction(speed)


class SceneOptions:
    """The options of a run as summary.json resolves them."""

    def __init__(self, summary):
        self.options, self.phases = summary["options"], summary["phases"]
        self.both = self.options["specimens"] == "both"
        self.bodies = ("top", "bottom") if self.both else ("bottom",)
        self.fastest = max((abs(phase["rate_rad_per_s"]) for phase in self.phases), default=0.0)
        friction = self.both and self.options["friction_law"] == "polynomial"
        self.law = tuple(tuple(numbers_of(self.options[name])) if friction else ()
                         for name in ("friction_coefficients", "friction_exponents"))

    def mean_speed(self, rate):
        return 2 / 3 * abs(rate) * float(self.options["top_radius"])

    def friction(self, speed):
        return sum(b * speed**m for b, m in zip(*self.law))

    def of_bodies(self, pattern):
        """The options of that name of all bodies that have them."""
        found = [name for name in self.options for body in self.bodies
                 if re.fullmatch(f"{body}_{pattern}", name)
                 and self.options[name]
                 and not ("maxwell" in name and self.options[f"{body}_material"] == "hyperelastic")]
        return tuple(sorted(found, reverse=True))  # top before bottom


def geometry(scene):
    if scene.options.get("mesh_file"):
        return []
    found = [Scaled(f"{body} {size}", f"{size} of the {body} gel", (f"{body}_{size}",), length=True)
             for size in ("height", "radius") for body in scene.bodies]
    return found + [Scaled("approach", "approach in all phases", ("schedule_approach",), length=True)]


def materials(scene):
    equilibrium, branch = scene.of_bodies("ogden_moduli"), scene.of_bodies(r"maxwell\d*_ogden_moduli")
    found = [Scaled("G", "all shear moduli, both parts", equilibrium + branch),
             Scaled("G equilibrium", "all moduli of the equilibrium part", equilibrium)]
    if scene.both:
        found += [Scaled(f"G {body}", f"all moduli of the {body} gel",
                         tuple(o for o in equilibrium + branch if o.startswith(body)))
                  for body in scene.bodies]
    terms = {len(numbers_of(scene.options[option])) for option in equilibrium}
    if len(terms) == 1 and terms != {1}:
        for k in range(*terms):
            found.append(Scaled(f"G{k + 1}", f"equilibrium, modulus of term {k + 1}", equilibrium, k))
        for k in range(*terms):
            found.append(Scaled(f"alpha{k + 1}", f"equilibrium, exponent of term {k + 1}",
                                scene.of_bodies("ogden_exponents"), k))
    found.append(Scaled("K", "bulk modulus of the equilibrium part", scene.of_bodies("bulk_modulus")))
    if branch:
        viscosities = scene.of_bodies(r"maxwell\d*_viscosities")
        found += [Scaled("G branch", "all moduli of the Maxwell branch", branch),
                  Scaled("K branch", "bulk modulus of the branch",
                         scene.of_bodies(r"maxwell\d*_bulk_modulus")),
                  Scaled("eta_D", "deviatoric viscosity", viscosities, 0),
                  Scaled("eta_V", "volumetric viscosity", viscosities, 1)]
    return found


def friction_terms(scene):
    coefficients, exponents = scene.law
    found = [Scaled(f"b (v^{m:g})", f"coefficient of v^{m:g}", ("friction_coefficients",), k)
             for k, (b, m) in enumerate(zip(coefficients, exponents)) if b]
    given = {m for b, m in zip(coefficients, exponents) if b}
    if scene.fastest and found:
        found += [Term(f"b (v^{m})", f"a term with v^{m}, there is none", m) for m in (0, 1, 2)
                  if m not in given]
    return found


def parameters_of(scene):
    return geometry(scene) + materials(scene) + friction_terms(scene)
