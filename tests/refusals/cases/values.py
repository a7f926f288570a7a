"""How names and values are written."""
REFUSALS = [
    ("misspelt option", ["-fricton_coefficients", "0,1e-3"], ["-fricton_coefficients = 0,1e-3",
                                                              "nearest is -friction_coefficients"]),
    ("two dashes", ["--top_radius", "9"], ["--top_radius = 9", "nearest is -top_radius"]),
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
    ("minus sign that is none", ["-schedule_rates", "0,0,0,0,\u22121"],
     ["-schedule_rates = 0,0,0,0,", "minus sign (U+2212)"]),
    ("dash that is none", ["\u2013top_radius", "8"], ["stray", "en dash (U+2013)"]),
    ("bytes that are no text", ["-output_directory", b"\xff"], ["-output_directory = ?", "0xFF"]),
    ("empty word", ["-overwrite", ""], ["-overwrite: value missing, an empty word"]),
    ("control characters", ["-top_height", "\x1b[2J"], ["-top_height = ?[2J"]),
    ("an endless value", ["-top_height", "9x" * 30000], ["-top_height = 9x9x9x", "9x..."]),
    ("stray word", ["fig06.opts"], ["fig06.opts", "stray"]),
    ("unknown kind of help", ["-help", "me"], ["-help = me", "petsc"]),
]

ON_TWO_PROCESSES = {"misspelt option", "blanks for commas", "NaN", "stray word"}

RUNS = [
    ("help", ["-help"], ["-friction_coefficients", "default: 0,8e-4", "MPa s"]),
    ("version", ["-version"], ["tribogel "]),
]


def prepare(_):
    """The cases need no files."""
