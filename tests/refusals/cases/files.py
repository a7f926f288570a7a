"""Options files, directories of output, runs that go on."""
from .scenes import SMALL

REFUSALS = [
    ("error estimate neither true nor false", ["-error_estimate", "0.1"], ["-error_estimate = 0.1"]),
    ("restart of nothing", ["-restart", "old"], ["-restart = old", "does not exist"]),
    ("restart of a run without checkpoint", ["-restart", "a_run"], ["-restart = a_run", "does not exist"]),
    ("restart of a text", ["-restart", "a_text"], ["-restart = a_text", "no whole HDF5 file"]),
    ("restart where nothing is named", ["-restart"], ["-restart", "value missing"]),
    ("checkpoints back in time", ["-checkpoint_every", "-1"], ["-checkpoint_every = -1", ">= 0"]),
    ("no wall time", ["-wall_time", "0"], ["-wall_time = 0", "> 0"]),
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
    ("file with a byte 0", ["-options_file", "zero_byte.opts"], ["zero_byte.opts", "line 1 is no text"]),
    ("wrong YAML", ["-options_file", "wrong.yaml"], ["-options_file = wrong.yaml", "YAML"]),
    ("options file without its option", ["zero.opts"], ["zero.opts", "stray", "-options_file zero.opts"]),
    ("run without its option", ["a_text"], ["a_text", "stray", "-restart a_text"]),
    ("word after a flag", ["-overwrite", "a_run"], ["-overwrite = a_run"]),
]

ON_TWO_PROCESSES = {"restart of a text", "missing options file", "blanks for commas in a file",
                    "wrong value after a lone CR", "output below a regular file", "existing run"}

RUNS = [
    ("existing run, to be replaced", ["-output_directory", "a_run", "-overwrite"] + SMALL, ["a_run"]),
    ("twists after the rates of a file",
     SMALL[:-2] + ["-options_file", "rates.opts", "-schedule_twists", "0.2"],
     ["note: -schedule_rates = 0.1 (in options file rates.opts line 2) gives way to -schedule_twists = 0.2",
      " 0.2    0.03183\n"]),
    ("rates of a file after twists", SMALL[:-2] + ["-schedule_twists", "0.2", "-options_file", "rates.opts"],
     ["gives way to -schedule_rates = 0.1", " 0.1    0.01592\n"]),
]


def prepare(directory):
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
    (directory / "rates.opts").write_bytes(b"\xef\xbb\xbf# mine\r-schedule_rates 0.1\r")
