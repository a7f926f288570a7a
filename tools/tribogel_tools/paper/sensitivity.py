"""What each parameter of the scene of Fig. 6 does to N and T: the runs of tools/sensitivity, its table and a
picture."""
import pathlib

import numpy as np

from ..command_line import progress
from ..program import OPTIONS, RunFailed
from ..sensitivity.study import Study, shown
from ..tables import read_csv
from . import runs
from .document import Figure, Heading, Table, Text
from .figures import BLUE, GREY, RED, finish, new_figure, titled

SCHEDULE = ("-schedule_end_times", "27,3600,4500", "-schedule_approach", "0.79,0.79,0.79", "-schedule_rates",
            "0,0,1")
COLUMNS = (("N", 1, "N, 27 s"), ("N", 3, "N, 1 rad/s"), ("T", 3, "T, 1 rad/s"))
STEP_TOLERANCE = 0.3  # of the transients' own: differences of two runs are small


def directory(output):
    return pathlib.Path(output) / "runs" / "sensitivity"


def run(program, output, detail, jobs):
    """About a hundred runs on the coarse mesh, two phases of rotation left out: their numbers follow from the
    third's."""
    words = (*SCHEDULE, *runs.mesh_words(detail, 0), "-time_tolerance",
             f"{STEP_TOLERANCE * detail.tolerance:.12g}")
    study = Study(program, [OPTIONS / "paper" / "fig06.opts"], words, directory(output), jobs=jobs,
                  only=detail.parameters, said=progress)
    study.run()
    study.write()
    if study.failures:
        raise RunFailed("\n".join(study.failures))


def read(output):
    """Parameter: its meaning, and (quantity, phase): sensitivity and its error."""
    found = {}
    for row in read_csv(directory(output) / "sensitivity.csv"):
        meaning = row["meaning"] + ("" if row["mesh_kept"] == "True" else " (other mesh)")
        numbers = found.setdefault(row["parameter"], (meaning, {}))[1]
        numbers[row["quantity"], int(row["phase"])] = (float(row["sensitivity"]), float(row["error"]))
    return found


def figure(results, found):
    picture, (axes,) = new_figure(1, height=1.8 + 0.2 * len(found))
    places = np.arange(len(found))[::-1]
    for (quantity, phase, label), colour, side in zip(COLUMNS, (GREY, BLUE, RED), (0.27, 0, -0.27)):
        values = [numbers.get((quantity, phase), (np.nan,))[0] for _, numbers in found.values()]
        axes.barh(places + side, values, 0.27, color=colour, label=label)
    axes.set_yticks(places, list(found), fontsize=8.5)
    axes.axvline(0, color="#222222", linewidth=0.8)
    axes.margins(y=0.01)
    axes.legend(frameon=False, fontsize=8.5, loc="lower right")
    titled(axes, "sensitivities", "per cent per per cent", "")
    return finish(picture, results, "sensitivity")


def section(results):
    found = read(results.output)
    rows = [(name, meaning, *(shown(*numbers.get((quantity, phase), (np.nan, 0.0)))
                              for quantity, phase, _ in COLUMNS))
            for name, (meaning, numbers) in found.items()]
    return [
        Heading("What each parameter does", "sensitivity"),
        Text("The paper hints at a “strong sensitivity”. Here the change of N and T in per cent when a "
             "parameter grows by one, in the scene of Fig. 6: mesh of the coarse runs, central differences "
             "of 4 and 2 %."),
        Figure(figure(results, found),
               "Relative sensitivities. Without a top or bottom in its name a parameter is both gels'."),
        Table(("parameter", "", *(label for *_, label in COLUMNS)), rows,
              "In brackets the error of the last digit. b (v^0), b (v^2): a term that adds 1 % to the "
              "coefficient at the mean speed 2/3 ω R. (other mesh): the number of elements changes with it."),
    ]
