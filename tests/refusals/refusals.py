#!/usr/bin/python3
"""Bad input is refused: exit status 2, one line on stderr that names the option, the value and what is
allowed, and nothing is written. What is merely odd runs, with a warning or a note.

  tests/refusals/refusals.py TRIBOGEL [--mpirun MPIRUN]

With --mpirun some refusals are repeated on two processes. Each run has a directory of its own. The page
options/README.md must be what -help markdown prints.
"""
import argparse
import concurrent.futures
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))
from tribogel_tools.refusal import contents, faults_of_refusal, start  # noqa: E402

TIMEOUT = 120  # s
ALLOWED = "allowed: "

# A scene that is over in a moment, for what must run.
SMALL = ["-specimens", "bottom", "-element_order", "1", "-elements_radial", "2", "-schedule_end_times", "1",
         "-schedule_approach", "0.05", "-schedule_rates", "0"]

SOLID = ["-model", "solid"]
BRIEF = ["-element_order", "1", "-schedule_end_times", "1", "-schedule_approach", "0.01", "-schedule_rates",
         "0"]

# name, words on the command line, what the line must contain besides "allowed: "
REFUSALS = [
    ("misspelt option", ["-fricton_coefficients", "0,1e-3"], ["-fricton_coefficients = 0,1e-3",
                                                              "nearest is -friction_coefficients"]),
    ("two dashes", ["--top_radius", "9"], ["--top_radius = 9", "nearest is -top_radius"]),
    ("error estimate neither true nor false", ["-error_estimate", "0.1"], ["-error_estimate = 0.1"]),
    ("restart of nothing", ["-restart", "old"], ["-restart = old", "does not exist"]),
    ("restart of a run without checkpoint", ["-restart", "a_run"], ["-restart = a_run", "does not exist"]),
    ("restart of a text", ["-restart", "a_text"], ["-restart = a_text", "no whole HDF5 file"]),
    ("restart where nothing is named", ["-restart"], ["-restart", "value missing"]),
    ("checkpoints back in time", ["-checkpoint_every", "-1"], ["-checkpoint_every = -1", ">= 0"]),
    ("no wall time", ["-wall_time", "0"], ["-wall_time = 0", "> 0"]),
    ("misspelt solver option", ["-ksp_typ", "gmres"], ["-ksp_typ = gmres", "nearest is -ksp_type"]),
    ("unknown solver", ["-ksp_type", "gmrs"], ["-ksp_type = gmrs"]),
    ("solver number that is none", ["-snes_rtol", "small"], ["-snes_rtol = small"]),
    ("number of a solver that is not there", ["-ksp_rtol", "1e-5x"], ["-ksp_rtol = 1e-5x", "0 to 1"]),
    ("negative modulus", ["-top_ogden_moduli", "-0.75,0.45,0.18"], ["-top_ogden_moduli = -0.75,0.45,0.18"]),
    ("negative bulk modulus", ["-bottom_bulk_modulus", "-200"], ["-bottom_bulk_modulus = -200"]),
    ("unequal lengths", ["-friction_coefficients", "1,2,3"], ["-friction_coefficients = 1,2,3 has 3",
                                                              "-friction_exponents = 0,1 (default) has 2"]),
    ("blanks for commas", ["-friction_coefficients", "0", "8e-4"], ["-friction_coefficients = 0", "8e-4"]),
    ("blanks in one word", ["-friction_coefficients", "0 8e-4"],
     ["-friction_coefficients = 0 8e-4", "comma"]),
    ("empty place in a list", ["-friction_coefficients", "0,,1"], ["-friction_coefficients = 0,,1"]),
    ("comma at the end", ["-friction_coefficients", "0,1,"], ["-friction_coefficients = 0,1,"]),
    ("missing value", ["-top_radius", "-top_height", "4"], ["-top_radius", "value missing"]),
    ("missing value at the end", ["-schedule_approach"], ["-schedule_approach", "value missing"]),
    ("NaN", ["-top_height", "nan"], ["-top_height = nan", "finite"]),
    ("negative NaN", ["-initial_gap", "-nan"], ["-initial_gap = -nan"]),
    ("infinity", ["-bottom_radius", "inf"], ["-bottom_radius = inf"]),
    ("hexadecimal", ["-bottom_radius", "0x10"], ["-bottom_radius = 0x10"]),
    ("overflow", ["-top_bulk_modulus", "1e999"], ["-top_bulk_modulus = 1e999"]),
    ("integer overflow", ["-elements_radial", "99999999999999999999"],
     ["-elements_radial = 99999999999999999999"]),
    ("no whole number", ["-element_order", "1.5"], ["-element_order = 1.5"]),
    ("end times not increasing", ["-schedule_end_times", "27,3600,3600,5400,6300"],
     ["-schedule_end_times = 27,3600,3600,5400,6300", "increasing"]),
    ("missing options file", ["-options_file", "no/such.opts"], ["-options_file = no/such.opts"]),
    ("options file that is a directory", ["-options_file", "."], ["-options_file = .", "directory"]),
    ("options file not named", ["-options_file"], ["-options_file", "value missing"]),
    ("blanks for commas in a file", ["-options_file", "blanks.opts"],
     ["blanks.opts line 2", "-friction_coefficients = 0", "8e-4"]),
    ("word without a dash in a file", ["-options_file", "bare.opts"], ["bare.opts line 1", "top_radius"]),
    ("wrong value in a file", ["-options_file", "zero.opts"], ["-top_height = 0", "zero.opts line 1"]),
    ("wrong value after a lone CR", ["-options_file", "old_mac.opts"],
     ["-top_height = 0", "old_mac.opts line 2"]),
    ("UTF-16", ["-options_file", "utf16.opts"], ["-options_file = utf16.opts", "UTF-8"]),
    ("line separator in a remark", ["-options_file", "separator.opts"],
     ["separator.opts: line 1", "line separator (U+2028)"]),
    ("minus sign that is none", ["-schedule_rates", "0,0,0,0,\u22121"],
     ["-schedule_rates = 0,0,0,0,", "minus sign (U+2212)"]),
    ("dash that is none", ["\u2013top_radius", "8"], ["stray", "en dash (U+2013)"]),
    ("bytes that are no text", ["-output_directory", b"\xff"], ["-output_directory = ?", "0xFF"]),
    ("empty word", ["-overwrite", ""], ["-overwrite: value missing, an empty word"]),
    ("output below a regular file", ["-output_directory", "a_file/run"], ["-output_directory = a_file/run",
                                                                          "not a directory"]),
    ("output with too long a name", ["-output_directory", "new/" + "x" * 300],
     ["-output_directory = new/x", "name too long"]),
    ("output onto a regular file", ["-output_directory", "a_file"], ["-output_directory = a_file"]),
    ("existing run", ["-output_directory", "a_run"], ["-output_directory = a_run", "-overwrite"]),
    ("options file that is a device", ["-options_file", "/dev/zero"],
     ["-options_file = /dev/zero", "device"]),
    ("options file that cannot be read", ["-options_file", "/proc/self/mem"],
     ["-options_file = /proc/self/mem"]),
    ("equals sign", ["-options_file", "equals.opts"], ["-task=simulate: unknown"]),
    ("solver option without its number", ["-snes_rtol"], ["-snes_rtol: value missing"]),
    ("another time span", ["-ts_time_span", "0,5,9"], ["-ts_time_span = 0,5,9", "use -schedule_end_times"]),
    ("another beginning", ["-ts_init_time", "5"], ["-ts_init_time = 5", "-restart"]),
    ("another end", ["-ts_max_time", "5"], ["-ts_max_time = 5", "use -schedule_end_times"]),
    ("an end that is not met", ["-ts_exact_final_time", "stepover"],
     ["-ts_exact_final_time = stepover", "matchstep"]),
    ("shortest step", ["-ts_adapt_dt_min", "1"], ["-ts_adapt_dt_min = 1", "-ts_dt"]),
    ("step control that needs what is not there", ["-ts_adapt_type", "glee"],
     ["-ts_adapt_type = glee", "basic or dsp or none"]),
    ("another test of convergence in a file", ["-options_file", "skip.opts"],
     ["-snes_convergence_test = skip", "-snes_rtol", "skip.opts line 2"]),
    ("what PETSc cannot take", ["-initial_gap", "0", "-ts_adapt_dt_max", "0"],
     ["error: -ts_adapt_dt_max = 0: "]),
    ("unknown step control", ["-ts_adapt_type", "fast"], ["-ts_adapt_type = fast"]),
    ("file with a byte 0", ["-options_file", "zero_byte.opts"], ["zero_byte.opts", "line 1 is no text"]),
    ("wrong YAML", ["-options_file", "wrong.yaml"], ["-options_file = wrong.yaml", "YAML"]),
    ("control characters", ["-top_height", "\x1b[2J"], ["-top_height = ?[2J"]),
    ("an endless value", ["-top_height", "9x" * 30000], ["-top_height = 9x9x9x", "9x..."]),
    ("1e11 elements", ["-elements_radial", "330000"], ["-elements_radial = 330000", "e+11 elements"]),
    ("stray word", ["fig06.opts"], ["fig06.opts", "stray"]),
    ("options file without its option", ["zero.opts"], ["zero.opts", "stray", "-options_file zero.opts"]),
    ("run without its option", ["a_text"], ["a_text", "stray", "-restart a_text"]),
    ("word after a flag", ["-overwrite", "a_run"], ["-overwrite = a_run"]),
    ("zero height", ["-top_height", "0"], ["-top_height = 0", "> 0"]),
    ("top wider than bottom", ["-top_radius", "13"],
     ["-top_radius = 13", "-bottom_radius", "exchange the two"]),
    ("more approach than height", ["-schedule_approach", "1,1,1,1,9"],
     ["-schedule_approach = 1,1,1,1,9", "8.4 mm"]),
    ("model that is none", ["-model", "spherical"], ["-model = spherical", "axisymmetric"]),
    ("negative exponent", ["-friction_exponents", "0,-0.5"], ["-friction_exponents = 0,-0.5", ">= 0"]),
    ("weakening below exponent 1", ["-friction_coefficients", "1,-0.2", "-friction_exponents", "0,0.5"],
     ["-friction_coefficients = 1,-0.2", "-0.2 with exponent 0.5", ">= 0"]),
    ("offset in the half plane", ["-top_offset", "1,0"],
     ["-top_offset = 1,0", "0,0 with -model axisymmetric"]),
    ("offset of one number", ["-model", "solid", "-top_offset", "1"], ["-top_offset = 1"]),
    ("offset beyond the bottom gel", ["-model", "solid", "-top_offset", "9,9"],
     ["-top_offset = 9,9", "-bottom_radius = 12.5"]),
    ("offset over the edge", ["-model", "solid", "-top_offset", "0,5"],
     ["-top_offset = 0,5", "% of the top gel's face lies beyond the bottom gel", "at most 10 %",
      "offset of 2.5 mm"]),
    ("tilt in the half plane", ["-top_tilt", "0.01"], ["-top_tilt = 0.01", "0 with -model axisymmetric"]),
    ("tilt in degrees", ["-model", "solid", "-top_tilt", "2"], ["-top_tilt = 2"]),
    ("steady state of an offset gel", ["-model", "solid", "-top_offset", "1,0", "-schedule_kind", "steady"],
     ["-schedule_kind = steady", "-top_offset"]),
    ("one long step of a tilted gel", ["-model", "solid", "-top_tilt", "0.01", "-phase_end_tolerance", "1"],
     ["-phase_end_tolerance = 1", "-top_tilt"]),
    ("Gauss points in the half plane", ["-contact_integration", "elements"],
     ["-contact_integration = elements", "segments with -model axisymmetric"]),
    ("one cell for a circle", ["-model", "solid", "-elements_radial", "1"],
     ["-elements_radial = 1", "at least 2"]),
    ("pressure exponent", ["-friction_pressure_exponent", "1.2"],
     ["-friction_pressure_exponent = 1.2", "0 to 1"]),
    ("pressure floor", ["-friction_pressure_floor", "0"], ["-friction_pressure_floor = 0", "> 0"]),
    ("gap in the branches", ["-top_maxwell3_viscosities", "4,5"], ["-top_maxwell3_viscosities = 4,5"]),
    ("incomplete branch", ["-top_maxwell2_viscosities", "4,5"], ["-top_maxwell2_ogden_moduli"]),
    ("cells whose volume is no number", ["-model", "solid", "-elements_radial", "3", "-mesh_grading", "5"] +
     [word for size in ("top_radius", "top_height", "bottom_radius", "bottom_height")
      for word in ("-" + size, "1e-110")] +
     ["-schedule_approach", ",".join(5 * ["1e-120"])],
     ["error: the mesh has a degenerate cell at x = "]),  # and not "-help = -mesh_grading: "
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
    ("rigid plane under a gel on both plates", ["-specimens", "bottom", "-counterface", "rigid"],
     ["-counterface = rigid", "gel with -specimens bottom"]),
    ("offset from a rigid plane", ["-model", "solid", "-counterface", "rigid", "-top_offset", "1,0"],
     ["-top_offset = 1,0", "0,0 with -counterface rigid"]),
    ("more approach than the gel's height on a rigid plane",
     ["-counterface", "rigid", "-schedule_approach", "4.5"],
     ["-schedule_approach = 4.5", "less than 4.4 mm", "top specimen"]),
    ("unknown kind of help", ["-help", "me"], ["-help = me", "petsc"]),
]

# These take different ways through the program; they are repeated on two processes.
ON_TWO_PROCESSES = {"misspelt option", "wrong value after a lone CR", "misspelt solver option",
                    "unknown solver", "blanks for commas", "NaN",
                    "missing options file", "blanks for commas in a file", "output below a regular file",
                    "existing run", "stray word", "restart of a text", "mesh file that is none",
                    "more approach than the mesh file's height", "mesh file without a contact face"}

# name, words, exit status 0 and this on stdout
RUNS = [
    ("K below G", ["-bottom_bulk_modulus", "0.9"] + SMALL, ["warning: -bottom_bulk_modulus = 0.9"]),
    ("relaxation far below the phase", ["-bottom_maxwell_viscosities", "1e-7,1e-5"] + SMALL,
     ["warning: -bottom_maxwell_viscosities", "relaxation time"]),
    ("friction without a second gel", ["-friction_coefficients", "0,2e-4"] + SMALL,
     ["note: without effect with -specimens bottom: -friction_coefficients"]),
    ("second gel in the place of a rigid plane",
     ["-counterface", "rigid", "-bottom_radius", "3", "-elements_radial", "2", "-schedule_end_times", "1",
      "-schedule_approach", "0.01", "-schedule_rates", "0"],
     ["note: without effect with -counterface rigid: -bottom_radius", "pressed on a rigid plane"]),
    ("mesh file on a rigid plane", SOLID + ["-mesh_file", "good.msh", "-counterface", "rigid"] + BRIEF,
     ["One gel, bonded to the top plate", "not in the physical volume top are left out"]),
    ("branch of a hyperelastic gel",
     ["-bottom_material", "hyperelastic", "-bottom_maxwell_bulk_modulus", "90"] + SMALL,
     ["note: without effect with -bottom_material hyperelastic: -bottom_maxwell_bulk_modulus"]),
    ("existing run, to be replaced", ["-output_directory", "a_run", "-overwrite"] + SMALL, ["a_run"]),
    ("unused solver option in a file", ["-options_file", "unused.opts"] + SMALL, ["warning: -pc_hypre_type"]),
    ("mesh file with a face that is meant to be free", SOLID + ["-mesh_file", "free.msh"] + BRIEF,
     ["warning: -mesh_file = free.msh: top_contact lacks faces of top: 78.54 mm^2, 25 %", "'free'"]),
    ("mesh file with sizes",
     SOLID + ["-mesh_file", "good.msh", "-top_radius", "3", "-mesh_grading", "9"] + BRIEF,
     ["note: without effect with -mesh_file: -top_radius, -mesh_grading", "mesh of good.msh"]),
    ("twists after the rates of a file",
     SMALL[:-2] + ["-options_file", "rates.opts", "-schedule_twists", "0.2"],
     ["note: -schedule_rates = 0.1 (in options file rates.opts line 2) gives way to -schedule_twists = 0.2",
      " 0.2    0.03183\n"]),
    ("rates of a file after twists", SMALL[:-2] + ["-schedule_twists", "0.2", "-options_file", "rates.opts"],
     ["gives way to -schedule_rates = 0.1", " 0.1    0.01592\n"]),
    ("time rule of PETSc that is ours",
     ["-ts_exact_final_time", "matchstep", "-ts_adapt_type", "dsp", "-snes_type", "newtontr"]
     + SMALL, ["complete; files in"]),
    ("help of PETSc beside a run", ["-help", "petsc", "-output_directory", "a_run"],
     ["-snes_max_it", "-friction_law"]),
    ("mesh file in micrometres", SOLID + ["-mesh_file", "micrometres.msh"] + BRIEF,
     ["warning: -mesh_file = micrometres.msh stands for -top_radius = 1e+04 mm, -top_height = 4400 mm, "
      "-bottom_radius = ",
      "micrometres?"]),
    ("mesh file beside the axis", SOLID + ["-mesh_file", "beside.msh"] + BRIEF,
     ["warning: -mesh_file = beside.msh: the plates' axis x = y = 0 lies outside of top_contact, which has "
      "its centroid at (30, 40) mm"]),
    ("gel in micrometres", ["-bottom_radius", "10000"] + SMALL,
     ["warning: -bottom_radius = 1e+04 mm: lengths are in mm"]),
    ("help", ["-help"], ["-friction_coefficients", "default: 0,8e-4", "MPa s"]),
    ("version", ["-version"], ["tribogel "]),
]


def prepare(directory):
    """What the cases expect to find."""
    (directory / "a_file").write_text("mine\n")
    (directory / "a_run").mkdir()
    (directory / "a_run" / "history.csv").write_text("an older run\n")
    (directory / "a_run" / "remarks.txt").write_text("mine\n")
    (directory / "a_text").mkdir()
    (directory / "a_text" / "checkpoint.h5").write_text("not HDF5\n")
    (directory / "blanks.opts").write_text("# the list below has a blank\n-friction_coefficients 0 8e-4\n")
    (directory / "bare.opts").write_text("top_radius 9\n")
    (directory / "zero.opts").write_text("-top_height 0 # mm\n")
    (directory / "equals.opts").write_text("-task=simulate\n")
    (directory / "zero_byte.opts").write_text("-top_height 4\0 5\n")
    (directory / "wrong.yaml").write_text("top_height: [4\n")
    (directory / "old_mac.opts").write_bytes(b"# mine\r-top_height 0\r")
    (directory / "utf16.opts").write_bytes("-top_height 4\n".encode("utf-16"))
    (directory / "separator.opts").write_text("# mine\u2028-top_height 4\n", encoding="utf-8")
    (directory / "skip.opts").write_text("# no test\n-snes_convergence_test skip\n")
    (directory / "rates.opts").write_bytes(b"\xef\xbb\xbf# mine\r-schedule_rates 0.1\r")
    (directory / "unused.opts").write_text("-pc_hypre_type boomeramg\n")
    prepare_meshes(directory)


def prepare_meshes(directory):
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


def judge_refusal(command, expected):
    """What is wrong with the refusal, as a list of lines."""
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        prepare(directory)
        before = contents(directory)
        done = start(command, directory, TIMEOUT)
        wrong = faults_of_refusal(done, before, directory)
        return wrong + [f"'{part}' is not in {done.stderr!r}" for part in [ALLOWED] + expected
                        if part not in done.stderr]


def judge_run(command, expected):
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        prepare(directory)
        done = start(command, directory, TIMEOUT)
        wrong = [f"exit status {done.returncode}, not 0: {done.stderr}"] if done.returncode != 0 else []
        wrong += [f"'{part}' is not on stdout" for part in expected if part not in done.stdout]
        if (directory / "a_run" / "remarks.txt").read_text() != "mine\n":
            wrong.append("a file that is not ours was changed")
        return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tribogel", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--mpirun", help="launcher for two processes")
    arguments = parser.parse_args()
    # -q: without the launcher's own remark that a process has ended with a status other than 0
    commands = [("", [arguments.tribogel])]
    if arguments.mpirun:
        commands.append((" on two processes", [arguments.mpirun, "-q", "-n", "2", arguments.tribogel]))

    cases = [(name + where, judge_refusal, command + words, expected) for where, command in commands
             for name, words, expected in REFUSALS if not where or name in ON_TWO_PROCESSES]
    cases += [(name, judge_run, commands[0][1] + words, expected) for name, words, expected in RUNS]
    failures = 0
    with concurrent.futures.ThreadPoolExecutor(4) as pool:  # starting a program is three quarters waiting
        for (name, *_), wrong in zip(cases, pool.map(lambda case: case[1](*case[2:]), cases)):
            for line in wrong:
                failures += 1
                print(f"FAILED {name}: {line}")
    page = pathlib.Path(__file__).resolve().parents[2] / "options" / "README.md"
    if start([arguments.tribogel, "-help", "markdown"], page.parent, TIMEOUT).stdout != page.read_text():
        failures += 1
        print(f"FAILED page of options: {page} is not what '-help markdown' prints")
    print(f"{len(cases) + 1} cases, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
