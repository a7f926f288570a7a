"""PETSc's options."""
from .scenes import SMALL

REFUSALS = [
    ("misspelt solver option", ["-ksp_typ", "gmres"], ["-ksp_typ = gmres", "nearest is -ksp_type"]),
    ("unknown solver", ["-ksp_type", "gmrs"], ["-ksp_type = gmrs"]),
    ("solver number that is none", ["-snes_rtol", "small"], ["-snes_rtol = small"]),
    ("number of a solver that is not there", ["-ksp_rtol", "1e-5x"], ["-ksp_rtol = 1e-5x", "0 to 1"]),
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
]

ON_TWO_PROCESSES = {"misspelt solver option", "unknown solver"}

RUNS = [
    ("unused solver option in a file", ["-options_file", "unused.opts"] + SMALL, ["warning: -pc_hypre_type"]),
    ("time rule of PETSc that is ours",
     ["-ts_exact_final_time", "matchstep", "-ts_adapt_type", "dsp", "-snes_type", "newtontr"]
     + SMALL, ["complete; files in"]),
    ("help of PETSc beside a run", ["-help", "petsc", "-output_directory", "a_run"],
     ["-snes_max_it", "-friction_law"]),
]


def prepare(directory):
    (directory / "skip.opts").write_text("# no test\n-snes_convergence_test skip\n")
    (directory / "unused.opts").write_text("-pc_hypre_type boomeramg\n")
