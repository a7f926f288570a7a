"""The cases of tools/fuzz: sensible scenes, spoiled ones, damaged files, and chaos, each put on the command
line, into options files, .petscrc and PETSC_OPTIONS in some mixture."""
import math

from .meshes import damaged_mesh, same_mesh, spoiled_mesh, suspicious_mesh
from .runs import damaged, goes_on, goes_on_changed, no_room, other_mesh, unusual_line_ends
from .scenes import between, elements_of, number, sensible
from .spoilers import NO_LISTS, NO_NUMBERS, SPOILERS, Case, wrong_values

ELEMENTS_AT_MOST = 400  # of scenes that may run: more would take long without being wrong
HARMLESS = (["-log_view"], ["-ts_monitor"], ["-options_left"], ["-snes_converged_reason"],
            ["-ksp_converged_reason"],
            ["-snes_max_it", "60"], ["-malloc_debug"], ["-options_view"], ["-memory_view"], ["-snes_monitor"],
            ["-mat_view", "::ascii_info"], ["-ksp_view"], ["-ts_view"])
LINE_ENDS, BLANKS = "\v\f\x85\u2028\u2029", "\xa0\u2003\u200b\u3000"  # that are none here
SOLVER_NAMES = ("-snes_rtol", "-snes_atol", "-snes_stol", "-snes_max_it", "-snes_divergence_tolerance",
                "-snes_max_funcs", "-ksp_rtol", "-ksp_atol", "-ksp_max_it", "-ts_dt", "-ts_max_steps",
                "-ts_max_time", "-ts_init_time", "-ts_adapt_dt_min", "-ts_adapt_dt_max", "-ts_adapt_safety",
                "-ts_adapt_clip", "-ts_max_reject", "-ts_max_snes_failures", "-ts_exact_final_time",
                "-ts_adapt_type", "-snes_lag_jacobian", "-snes_lag_preconditioner", "-pc_factor_shift_type",
                "-pc_factor_levels", "-snes_linesearch_maxstep", "-snes_linesearch_damping",
                "-snes_linesearch_type", "-snes_type", "-ksp_type", "-pc_type", "-mat_type", "-vec_type",
                "-snes_mf", "-snes_fd", "-snes_test_jacobian", "-ksp_gmres_restart", "-ts_rtol", "-ts_atol",
                "-pc_factor_mat_solver_type", "-mat_mumps_icntl_14", "-ts_time_step", "-ts_adapt_monitor",
                "-snes_force_iteration", "-ts_theta_theta", "-options_file_yaml", "-options_string_yaml",
                "-dm_vec_type", "-nox", "-help")
SOLVER_VALUES = ("0", "1", "-1", "2", "1e-300", "1e300", "0.5", "nan", "inf", "true", "false", "none", "lu",
                 "cg", "preonly", "basic", "newtontr", "nleqerr", "richardson", "ilu", "jacobi", "dense",
                 "aij", "umfpack", "mumps", "cp", "l2", "matchstep", "interpolate", "-5", "2147483647",
                 "2147483648", "x", "1,2", ":", "/", "decide", "default")


def fits_a_file(name, value):
    def odd(c):
        return c.isspace() or c in "#\"'!%" or not c.isprintable()
    return value is None or (value and not any(map(odd, name + value)) and len(value) < 1000)


def as_file(random, settings):
    """The text of an options file, with some of the liberties that people take."""
    lines = []
    for name, value in settings:
        line = random.choice(("", "", "  ", "\t")) + name
        line += random.choice((" ", "   ", "\t")) + value if value is not None else ""
        lines.append(line + random.choice(("", "", " # remark", "   ", "#")) if value is not None else line)
        if random.random() < 0.2:
            lines.append(random.choice(("", "# remark", "#", "   ", "# -top_radius 8", "#" * 300)))
    text = random.choice(("\n", "\n", "\r\n", "\r")).join(lines) + random.choice(("\n", ""))
    return text.encode(random.choice(("utf-8", "utf-8", "utf-8-sig")))


def words_of(settings):
    return [word for name, value in settings for word in (name, value) if word is not None]


def deliver(random, case):
    """The settings of a case, in any order, into files, the environment and words before its own."""
    settings = list(case.settings)
    random.shuffle(settings)
    way = random.random()
    movable = [entry for entry in settings if fits_a_file(*entry)]
    if way < 0.5:
        moved = random.sample(movable, random.randint(0, len(movable)))
        place = random.choice(("first.opts", "first.opts", "first.opts", ".petscrc", "environment"))
        settings = [entry for entry in settings if entry not in moved]
        if place == "environment" and "PETSC_OPTIONS" not in case.variables:
            case.variables["PETSC_OPTIONS"] = " ".join(words_of(moved))
        elif place not in case.files and place != "environment":
            case.files[place] = as_file(random, moved)
            settings.insert(random.randint(0, len(settings)),
                            ("-options_file", place)) if place != ".petscrc" else None
        else:
            settings += moved
    case.words = words_of(settings) + case.words
    return case


def scene_that_runs(random, options):
    settings = sensible(random)
    case = Case("sensible", "runs", list(settings.items()))
    kind = random.random()
    if kind < 0.25:
        case.about, case.words = "sensible with options of PETSC", list(random.choice(HARMLESS))
    elif kind < 0.35:
        name = random.choice(sorted(settings))
        spoiled = next((wrong_values(random, option) for option in options if option.name == name), None)
        case.about = f"{name} is wrong first and right later"
        if spoiled and settings[name] is not None and fits_a_file(name, spoiled):
            case.files["wrong.opts"] = f"{name} {spoiled}\n".encode()
            case.words = ["-options_file", "wrong.opts", *words_of(case.settings)]
            case.settings = []
    elif kind < 0.45:
        depth = random.randint(1, 40)
        case.about = "files that name files"
        for level in range(depth):
            case.files[f"{level}.opts"] = f"-options_file {level + 1}.opts\n".encode()
        case.files[f"{depth}.opts"] = as_file(random, [entry for entry in case.settings
                                                       if fits_a_file(*entry)])
        case.words = ["-options_file", "0.opts",
                      *words_of(entry for entry in case.settings if not fits_a_file(*entry))]
        case.settings = []
    return case


def spoiled_scene(random, options):
    return random.choice(SPOILERS)(random, options, sensible(random))


def noise(random, size):
    return bytes(random.randrange(256) for _ in range(size))


def damaged_file(random, options):
    """An options file that must be refused; the name of the file or of an option in it must be said."""
    settings = [entry for entry in sensible(random).items() if fits_a_file(*entry) and entry[1] is not None]
    good, path = as_file(random, settings), "bad.opts"
    name, value = random.choice([entry for entry in settings
                                 if entry[0] not in ("-overwrite", "-plate_contact")])
    endless = "-top_radius 9 " + "word " * random.choice((1, 30000))
    kinds = {
        "binary bytes": b"\x7fELF" + noise(random, random.randint(1, 3000)),
        "binary bytes after options": good + b"\n\x80\xfe" + noise(random, 300),
        "a byte 0": good
        + random.choice((b"\n-top_height 3\0", b"\n\0", b"\n-top_radius 1\x000\n", b"\n-top\0_radius 8\n")),
        "bytes of control": good
        + random.choice((b"\n-top_height 4\x1b\n", b"\n-top_\x07height 4\n", b"\n\x01\n")),
        "UTF-16": good.decode().encode("utf-16"),
        "a byte-order mark within": good + b"\n\xef\xbb\xbf-top_radius 9\n",
        "line ends of other programs": good + f"\n# remark{random.choice(LINE_ENDS)}-top_radius 9\n".encode(),
        "blanks that are none": good + f"\n-top_radius{random.choice(BLANKS)}9\n".encode(),
        "three words in a line": good + f"\n{name} {value} {value}\n".encode(),
        "a list with blanks": good + b"\n-friction_coefficients 0, 1e-3\n",
        "a bare word": good
        + random.choice((b"\nword\n", b"\n=\n", b"\ntop_radius = 9\n", b"\n- top_radius 9\n", b"\n--\n")),
        "cut after a name": good + f"\n{name}".encode(),
        "cut within a name": good + (b"\n-top" if name[:-1] in {o.name for o in options}
                                     else f"\n{name[:-1]}".encode()),
        "an equals sign": good + f"\n{name}={value}\n".encode(),
        "JSON": b'{"top_radius": 9}\n',
        "a question": good + random.choice((b"\n-help\n", b"\n-version\n", b"\n-h\n")),
        "an endless line": endless.encode(),
        "an endless value": b"-top_radius " + b"9x" * random.choice((300, 5000, 500000)) + b"\n",
        "an endless name": b"-top_" + b"x" * random.choice((500, 506, 507, 508, 5000, 500000)) + b" 1\n",
        "itself": b"-options_file bad.opts\n",
        "a circle": b"-options_file other.opts\n",
        "a missing file": b"-options_file missing.opts\n",
        "no file": b"-options_file\n",
        "a directory": b"-options_file .\n",
    }
    about = random.choice([*kinds, "no such file", "a device", "no YAML", "wrong YAML"])
    case = Case(f"file with {about}", "refused",
                names=(path, "-top", "other.opts", "-friction_coefficients", name[:12]))
    if about in kinds:
        case.files = {path: kinds[about], "other.opts": b"-options_file ./bad.opts\n"}
    elif about == "a device":
        path = random.choice(("/dev/null/x", "/dev/zero", "/dev/stdin", "/proc/self/mem", "a_file/x"))
    elif about == "no such file":
        path = random.choice(("bad.opts", "x" * 300, "\n", "\x1b[2J", "a_run"))
    else:
        path = "bad.yaml"
        case.files = {path: random.choice((b"a: [1,\n", b"{", b"\t- :", noise(random, 100),
                                           b"top_radius: nan\n", b"top_radius: [1, 2]\n", b"top_radiu: 9\n",
                                           b"top:\n  radius: x\n"))}
    case.names += (path[:40].strip() or "-options_file", "-options_file")
    case.words = ["-options_file", path]
    if random.random() < 0.2 and about in kinds and about not in ("itself", "a circle"):
        case.files = {".petscrc": case.files[path]}
        case.words, case.names = [], case.names + (".petscrc",)
        case.about += " as .petscrc"
    return case


def some_value(random, option, now):
    """A value of the right kind, mostly; of lists mostly as many as there are."""
    if option.kind == "choice" and random.random() < 0.7:
        return random.choice(option.choices)
    def one():
        return random.choice((number(between(random, 1e-3, 1e3)), number(-between(random, 1e-3, 1e3)),
                              str(random.randint(0, 4)),
                              random.choice(("0", "-0", "1e-300", "1e300", "1e-12", "1e12", "0.5", "+4",
                                             ".5", "5e-324"))))
    if option.kind == "reals":
        count = len(now.split(",")) if now and random.random() < 0.8 else random.choice((1, 2, 2, 3, 3, 5))
        old = now.split(",") if now else []
        return ",".join(old[k] if k < len(old) and random.random() < 0.5 else one() for k in range(count))
    if option.kind == "flag":
        return random.choice(("true", "false", None))
    return one() if random.random() < 0.9 else random.choice(NO_NUMBERS + NO_LISTS)


def chaos(random, options):
    """Options of ours and of PETSc with any values: refused, given up in order or run, but nothing worse."""
    default = {option.name: option.default for option in options}
    settings = sensible(random) | {"-wall_time": "2"}
    for _ in range(50):
        tried = dict(settings)
        for _ in range(random.randint(1, 3)):
            option = random.choice([o for o in options if o.kind != "path" and o.name != "-wall_time"])
            tried[option.name] = some_value(random, option, settings.get(option.name))
        if elements_of(tried, default) < ELEMENTS_AT_MOST:
            break
    else:
        tried = settings
    case = Case("chaos", "either", list(tried.items()))
    if random.random() < 0.4:
        case.about = "chaos with options of PETSc"
        for _ in range(random.randint(1, 3)):
            case.words += [random.choice(SOLVER_NAMES), random.choice(SOLVER_VALUES)]
    return case


def cut_file(random, _):
    """A file that ends anywhere: what it then says may be right or wrong."""
    whole = as_file(random, [entry for entry in sensible(random).items() if fits_a_file(*entry)])
    damaged = bytearray(whole[:random.randrange(len(whole))])
    if random.random() < 0.5 and damaged:
        damaged[random.randrange(len(damaged))] = random.randrange(256)
        return Case("file with one byte changed", "either",
                    words=["-options_file", "cut.opts", "-wall_time", "2"],
                    files={"cut.opts": bytes(damaged) + whole[len(damaged):]})
    return Case("file cut short", "either",
                words=["-options_file", "cut.opts", "-elements_radial", "2", "-wall_time", "2"],
                files={"cut.opts": bytes(damaged)})


MAKERS = (scene_that_runs,) * 6 + (spoiled_scene,) * 9 + (damaged_file,) * 3 + (chaos,) * 4 + (
    cut_file, unusual_line_ends, same_mesh, spoiled_mesh, suspicious_mesh, damaged_mesh, goes_on,
    goes_on_changed, damaged, other_mesh, no_room)


def case_of(random, options):
    case = deliver(random, random.choice(MAKERS)(random, options))
    if case.expected == "runs" and not math.isfinite(elements_of(dict(case.settings),
                                                                 {o.name: o.default for o in options})):
        raise AssertionError("a sensible scene has a mesh")
    return case
