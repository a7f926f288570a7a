"""Models, specimens, materials, friction, schedules and meshes of cylinders."""
from .scenes import SMALL

LAW = "-friction_rate_and_state_"
WITHOUT_LENGTH = ["-friction_law", "rate_and_state", LAW + "coefficient", "0.3", LAW + "direct_effect", "0.01",
                  LAW + "evolution_effect", "0.015", LAW + "speed", "1", LAW + "initial_age", "1"]
RATE_AND_STATE = WITHOUT_LENGTH + [LAW + "length", "0.1"]

REFUSALS = [
    ("negative modulus", ["-top_ogden_moduli", "-0.75,0.45,0.18"], ["-top_ogden_moduli = -0.75,0.45,0.18"]),
    ("negative bulk modulus", ["-bottom_bulk_modulus", "-200"], ["-bottom_bulk_modulus = -200"]),
    ("end times not increasing", ["-schedule_end_times", "27,3600,3600,5400,6300"],
     ["-schedule_end_times = 27,3600,3600,5400,6300", "increasing"]),
    ("1e11 elements", ["-elements_radial", "330000"], ["-elements_radial = 330000", "e+11 elements"]),
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
    ("no length of a law with memory", WITHOUT_LENGTH,
     ["-friction_rate_and_state_length: not given", "> 0"]),
    ("steady state at rest, weakening", RATE_AND_STATE + ["-schedule_kind", "steady"],
     ["-schedule_kind = steady", "phase 1 is at rest"]),
    ("steady state in space, weakening", RATE_AND_STATE + ["-schedule_kind", "steady", "-model", "solid"],
     ["-schedule_kind = steady", "in space", "b < a"]),
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
    ("rigid plane under a gel on both plates", ["-specimens", "bottom", "-counterface", "rigid"],
     ["-counterface = rigid", "gel with -specimens bottom"]),
    ("offset from a rigid plane", ["-model", "solid", "-counterface", "rigid", "-top_offset", "1,0"],
     ["-top_offset = 1,0", "0,0 with -counterface rigid"]),
    ("more approach than the gel's height on a rigid plane",
     ["-counterface", "rigid", "-schedule_approach", "4.5"],
     ["-schedule_approach = 4.5", "less than 4.4 mm", "top specimen"]),
]

ON_TWO_PROCESSES = set()

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
    ("branch of a hyperelastic gel",
     ["-bottom_material", "hyperelastic", "-bottom_maxwell_bulk_modulus", "90"] + SMALL,
     ["note: without effect with -bottom_material hyperelastic: -bottom_maxwell_bulk_modulus"]),
    ("gel in micrometres", ["-bottom_radius", "10000"] + SMALL,
     ["warning: -bottom_radius = 1e+04 mm: lengths are in mm"]),
]


def prepare(_):
    """The cases need no files."""
