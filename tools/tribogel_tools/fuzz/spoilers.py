"""Nonsense for tools/fuzz: each function takes a random generator, the options and the settings of a sensible
scene, and returns a Case that must be refused, with the names one of which the refusal must hold."""
import dataclasses
import math
import string

from .scenes import listed, number

NO_NUMBERS = ("nan", "-nan", "inf", "-inf", "infinity", "0x10", "1e999", "1.5.2", "3e", "--2", "one", "1_0",
              "1 2", " 1", "1 ", "", "٣", "½", "+-1", "1d3", "1f", ".", "%s%n", "1;2", "$HOME", "1\t",
              "\x1b[31m1", "a" * 70000)
NO_WHOLE_NUMBERS = ("1.5", "1e1", "99999999999999999999", "-99999999999999999999", "2147483648", "-1", "1,2")
NO_LISTS = (",", "1,,2", "1,2,", ",1", "1, 2", "1;2", "1:2", "1,2 ", "[1,2]", "1,nan", "1,inf", "1,1e999",
            "1,x", "", "1,2,3,")
NO_FLAGS = ("yes", "1", "0", "TRUE", "on", "truee", "true,false", "t")


@dataclasses.dataclass
class Case:
    """How the program is started, and what must come of it."""
    about: str
    expected: str  # refused, runs, told (refused, or run with a warning that has one of the names) or either
    # (name, value or None): put anywhere by the caller
    settings: list = dataclasses.field(default_factory=list)
    # on the command line, as they are, after the settings
    words: list = dataclasses.field(default_factory=list)
    names: tuple = ()  # one of them must be in a refusal
    files: dict = dataclasses.field(default_factory=dict)  # name: bytes
    variables: dict = dataclasses.field(default_factory=dict)  # of the environment
    # words of a run before it, which completes or is stopped
    first: list = dataclasses.field(default_factory=list)
    # files after that run: bytes, or a function of those there
    change: dict = dataclasses.field(default_factory=dict)
    same_as_first: bool = False  # N at the end is that of the first run
    asked: dict = dataclasses.field(default_factory=dict)  # options that summary.json must have, if it runs
    room: int | None = None  # bytes that a file may have


def refused(about, settings, *names, **more):
    return Case(about, "refused", list(settings.items()), names=names, **more)


def wrong_values(random, option):
    """A text that this option must refuse, or None when it takes any."""
    if option.kind == "choice":
        return random.choice(option.choices[0]
                             and (option.choices[0][:-1], option.choices[0] + "x", "", "0", "both,bottom"))
    if option.kind == "flag":
        return random.choice(NO_FLAGS)
    if option.kind == "path":
        return ""
    beyond = []
    if math.isfinite(option.low):
        beyond += [number(option.low - random.choice((1, 0.5, 1e9)))]
        beyond += ["0", "-0", "0.0"] if option.low_excluded else []
    if math.isfinite(option.high):
        beyond += [number(option.high * random.choice((1.5, 3, 1e5)) + 1)]
    if beyond and random.random() < 0.4:
        pair = option.kind == "reals" and option.count == 2
        return random.choice(beyond) + ("," + random.choice(beyond) if pair else "")
    if option.kind == "reals":
        return random.choice(NO_LISTS + NO_NUMBERS)
    return random.choice(NO_NUMBERS + (NO_WHOLE_NUMBERS if option.kind == "integer" else ("1,5",)))


def wrong_value(random, options, settings):
    option = random.choice(options)
    text = wrong_values(random, option)
    if option.name in ("-schedule_rates", "-schedule_twists"):
        settings.pop("-schedule_rates", None)
        settings.pop("-schedule_twists", None)
    return refused(f"wrong value of {option.name}", settings | {option.name: text}, option.name)


def wrong_number_in_list(random, options, settings):
    name = random.choice([o.name for o in options if o.kind == "reals" and o.name in settings])
    texts = settings[name].split(",")
    texts[random.randrange(len(texts))] = random.choice([text for text in NO_NUMBERS if "," not in text])
    return refused(f"wrong number in {name}", settings | {name: ",".join(texts)}, name)


def wrong_count(random, options, settings):
    """Lists that go together get different lengths."""
    names = [o.name for o in options if o.kind == "reals" and o.name in settings
             and o.name != "-friction_speed_range"]
    name = random.choice(names)
    if name == "-schedule_end_times" and "," not in settings[name]:
        name = "-schedule_approach"  # one number holds for all phases
    texts = settings[name].split(",")
    if name == "-schedule_end_times":
        texts += [number(float(texts[-1]) + 1)]
    else:
        texts += [texts[-1]]
    return refused(f"wrong count in {name}", settings | {name: ",".join(texts)}, name)


def misspelt(random, options, settings):
    """One letter of a name of ours is missing, double, another one, or in the wrong place."""
    known = {option.name for option in options}
    name, spoiled = random.choice(options).name, None
    while spoiled is None or spoiled in known or not spoiled[1].isalpha():
        at = random.randrange(1, len(name) - 1)
        spoiled = random.choice((name[:at] + name[at + 1:], name[:at] + name[at] + name[at:],
                                 name[:at] + random.choice(string.ascii_lowercase) + name[at + 1:],
                                 name[:at] + name[at + 1] + name[at] + name[at + 2:]))
    return refused(f"misspelt {name}", settings | {spoiled: settings.get(name, "1")}, spoiled)


def unknown(random, _, settings):
    name = "-q" + "".join(random.choices(string.ascii_letters + "_",
                                         k=random.choice((3, 12, 200, 511, 512, 600, 5000))))
    words = random.choice(([name], [name, "1"], ["-" + name, "1"]))
    return refused("unknown option", settings, name[:40], words=words)


def times_do_not_increase(random, _, settings):
    times = [float(text) for text in settings["-schedule_end_times"].split(",")] + [0]
    at = random.randrange(len(times))
    times[-1] = random.choice((times[at], times[at] / 2, -1, 0) if at < len(times) - 1 else (0, -1))
    for name in ("-schedule_approach", "-schedule_rates", "-schedule_twists"):
        if name in settings:
            settings[name] += ",0"
    return refused("times that do not increase", settings | {"-schedule_end_times": listed(times)},
                   "-schedule_end_times")


def rates_and_twists(_, __, settings):
    """The later counts."""
    turning = settings.get("-schedule_rates", settings.get("-schedule_twists"))
    return Case("rates and twists", "either",
                list((settings | {"-schedule_rates": turning, "-schedule_twists": turning}).items()))


def too_much_approach(random, _, settings):
    height = sum(float(settings[name]) for name in ("-top_height", "-bottom_height"))
    approach = settings["-schedule_approach"].split(",")
    approach[random.randrange(len(approach))] = number(height * random.choice((1.001, 2, 1e9, 1e300)))
    return refused("more approach than height", settings | {"-schedule_approach": ",".join(approach)},
                   "-schedule_approach")


def top_wider(random, _, settings):
    radius = float(settings["-bottom_radius"]) * random.choice((1.001, 3, 1e6))
    for name in ("-specimens", "-counterface"):
        settings.pop(name, None)
    settings.setdefault("-top_ogden_moduli", "1")
    settings.setdefault("-top_ogden_exponents", "2")
    return refused("top wider than bottom", settings | {"-top_radius": number(radius)}, "-top_radius")


def unstable_spring(random, _, settings):
    """A term with G_r alpha_r <= 0."""
    moduli = random.choice([name for name in settings if name.endswith("ogden_moduli")])
    name = random.choice((moduli, moduli.replace("moduli", "exponents")))
    texts = settings[name].split(",")
    at = random.randrange(len(texts))
    texts[at] = random.choice(("0", number(-float(texts[at]))))
    return refused("unstable Ogden term", settings | {name: ",".join(texts)}, name, moduli)


def branch_incomplete(random, _, settings):
    """One of the four options of a further branch, or of a branch after a gap."""
    branch, body = random.choice((2, 5)), random.choice(("top", "bottom"))
    settings = {name: value for name, value in settings.items() if "maxwell2" not in name
                and "maxwell3" not in name}
    stem = f"-{body}_maxwell{branch}"
    names = {"ogden_moduli": "1,2", "ogden_exponents": "2,3", "bulk_modulus": "50", "viscosities": "2,3"}
    missing = random.choice(sorted(names)) if branch == 2 else None
    settings |= {f"{stem}_{name}": text for name, text in names.items() if name != missing}
    return refused("incomplete branch", settings, stem)


def negative_friction(random, _, settings):
    law = random.choice((("1e-3,-1e-3", "1,0.5"), ("-1e-3", "0"), ("1e-3,-2e-3,1", "0,0,1"), ("-1", "1e-9")))
    settings |= {"-friction_coefficients": law[0], "-friction_exponents": law[1]}
    return refused("negative friction", settings, "-friction_coefficients")


def steady_at_rest(_, __, settings):
    settings.pop("-specimens", None)
    settings.pop("-schedule_twists", None)
    rates = ",".join("0" for _ in settings["-schedule_end_times"].split(","))
    settings |= {"-friction_law": "polynomial", "-friction_coefficients": "0.1", "-friction_exponents": "0",
                 "-schedule_kind": "steady", "-schedule_rates": rates}
    return refused("steady state of gels held by static friction", settings, "-schedule_kind")


def too_many_elements(random, _, settings):
    for name in ("-bottom_elements_radial", "-counterface"):  # what counts for a gel alone; no bottom gel
        settings.pop(name, None)
    settings |= random.choice(({"-elements_radial": "1000000"},
                               {"-elements_radial": "100000", "-mesh_refinements": "10"},
                               {"-elements_radial": "1000000", "-mesh_refinements": "10",
                                "-bottom_elements_radial": "1000000"},
                               {"-bottom_height": "1e300"}, {"-bottom_radius": "1e12", "-specimens": "both"}))
    return refused("too many elements", settings, "-elements_radial")


def bad_output(random, _, settings):
    settings.pop("-overwrite", None)
    where = random.choice(("a_file", "a_file/run", "a_run", "/dev/null", "/dev/null/run", "/proc/run",
                           "x" * 300, "new/" + "x" * 300, "new/" * 2000 + "run", "a_run/../a_run"))
    return refused("output that cannot be", settings | {"-output_directory": where}, "-output_directory")


def bad_restart(random, _, settings):
    settings.pop("-overwrite", None)
    settings.pop("-output_directory", None)
    where = random.choice(("nothing", "a_file", "a_run", "a_text", "an_hdf5", "", "a_run/history.csv",
                           "x" * 5000))
    return refused("restart of what is no run", settings, "-restart", words=["-restart", where])


def stray_word(random, _, settings):
    word = random.choice(("word", "-", "--", "1", "-5", "=", "top_radius=9", "--1", "-_x", "\n", "", "é",
                          "run.opts", "-1e5", "-inf"))
    return refused("stray word", {}, "stray",
                   words=[*random.choice((["-top_radius", "9"], [])), word, *flat(settings)])


def flat(settings):
    return [word for name, value in settings.items() for word in (name, value) if word is not None]


def question_with_value(random, _, __):
    words = random.choice((["-help", "me"], ["-version", "2"], ["-h", "0"], ["--help", "x"],
                           ["-help", "petscc"]))
    return refused("question with a value", {}, "-help", "-version", words=words)


def bad_prefix(random, _, settings):
    words = random.choice((["-prefix_pop"], ["-prefix_push", "a_", "-top_radius", "9", "-prefix_pop"],
                           ["-prefix_push", "a_", "-prefix_pop", "-prefix_pop"], ["-prefix_push"]))
    return refused("wrong prefix", settings, "-prefix_pop", "-prefix_push", "-a_top_radius", words=words)


SOLVER_MISTAKES = (
    ("-ksp_type", "gmrs"), ("-pc_type", "luu"), ("-snes_type", "newton"), ("-ts_type", "eulr"),
    ("-snes_rtol", "small"),
    ("-ksp_rtol", "1e-5x"), ("-snes_max_it", "1.5"), ("-snes_max_it", "many"), ("-ksp_max_it", "1,2"),
    ("-snes_atol", ""),
    ("-snes_linesearch_type", "bq"), ("-ts_adapt_type", "fast"), ("-ts_max_steps", "x"), ("-ts_dt", "soon"),
    ("-ksp_typ", "gmres"), ("-snes_rtoll", "1e-3"), ("-pc_factor_mat_solver_type", "mump"), ("-ts_dtt", "1"),
    ("-ts_max_snes_failures", "1e3.5"), ("-snes_rtol", "1 2"))


def solver_mistake(random, _, settings):
    name, value = random.choice(SOLVER_MISTAKES)
    return refused(f"solver mistake {name}", settings, name, words=[name, value])


def in_environment(random, _, settings):
    text, name = random.choice((("word", "word"), ("-top_radius 9 8", "-top_radius"), ("-help", "-help"),
                                ("-top_radiu 9", "-top_radiu"), ("-top_height nan", "-top_height"),
                                ("-snes_rtol x", "-snes_rtol")))
    settings = {key: value for key, value in settings.items() if key != text.split()[0]}
    return refused("mistake in PETSC_OPTIONS", settings, name, variables={"PETSC_OPTIONS": text})


SPOILERS = (wrong_value,) * 8 + (wrong_number_in_list, wrong_count, misspelt) * 2 + (
    unknown, times_do_not_increase, rates_and_twists, too_much_approach, top_wider, unstable_spring,
    branch_incomplete, negative_friction, steady_at_rest, too_many_elements, bad_output, bad_restart,
    stray_word, question_with_value, bad_prefix, solver_mistake, in_environment)
