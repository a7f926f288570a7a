"""What a run left in history.csv and profile.csv, whole or not."""
import csv
import pathlib

import numpy as np

from .command_line import BadInput

HISTORY_NEEDS = ("time_s", "phase", "approach_mm", "rate_rad_per_s", "normal_force_N", "torque_Nmm")
PROFILE_NEEDS = ("time_s", "phase", "surface", "reference_r_mm", "reference_theta_rad", "reference_z_mm",
                 "r_mm", "z_mm", "pressure_MPa", "part")
TEXTS = ("surface", "part")  # columns of words


def read_table(path, needed):
    """Columns of a CSV file by name: arrays of numbers, or of text where a cell is none. A last row that the
    run did not finish writing is left out."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            text = file.read()
    except OSError as error:
        raise BadInput(f"cannot read {path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise BadInput(f"{path} is not a text file") from None
    rows = list(csv.reader(text.split("\n")[:-1]))  # what follows the last newline is incomplete
    if not rows:
        raise BadInput(f"{path} is empty")
    header, rows = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
    missing = [name for name in needed if name not in header]
    if missing:
        raise BadInput(f"{path} has no column {missing[0]}")
    table = {}
    for name, cells in zip(header, zip(*rows) if rows else ((),) * len(header)):
        try:
            table[name] = np.array([float(cell) for cell in cells])
        except ValueError:
            table[name] = np.array(cells)
    for name in needed:
        if name not in TEXTS and table[name].dtype.kind != "f":
            raise BadInput(f"{path}: column {name} holds something that is no number")
    return table


class History:
    """history.csv by phase, and profile.csv where there is one. Each phase begins with the row that ends the
    phase before it."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        if not self.directory.is_dir():
            raise BadInput(f"no run directory {directory}")
        self.history = read_table(self.directory / "history.csv", HISTORY_NEEDS)
        self.profile = None
        if (self.directory / "profile.csv").exists():
            profile = read_table(self.directory / "profile.csv", PROFILE_NEEDS)
            self.profile = profile if len(profile["phase"]) else None
        phase = self.history["phase"]
        if not len(phase):
            raise BadInput(f"{self.directory / 'history.csv'} holds no step")
        self.phases = [int(k) for k in np.unique(phase)]
        self.rows = []
        for k in self.phases:
            rows = np.flatnonzero(phase == k)
            self.rows.append(rows if rows[0] == 0 else np.concatenate(([rows[0] - 1], rows)))
        self.ends = [int(rows[-1]) for rows in self.rows]

    def has(self, column):
        return column in self.history and np.isfinite(self.history[column]).any()

    def label(self, index):
        """What the plate does in a phase, in a few words."""
        rows, h = self.rows[index], self.history
        rate = h["rate_rad_per_s"][rows[-1]]
        if rate != 0:
            return f"{rate:.3g} rad/s"
        travel = h["approach_mm"][rows[-1]] - h["approach_mm"][rows[0]]
        return "hold" if abs(travel) < 1e-12 else f"approach {travel:.3g} mm"


def surface_rows(profile, surface, phase, part="face"):
    """Of a contact surface, in the order of the file. Of the top gel's wall only what touches the other
    gel."""
    here = (profile["surface"] == surface) & (profile["phase"] == phase) & (profile["part"] == part)
    return np.flatnonzero(here & (profile["status"] != "open") if part == "wall" else here)


def rolled_rows(profile, phase):
    """The wall where it touches, from the face's last node on."""
    wall = surface_rows(profile, "top", phase, "wall")
    face = surface_rows(profile, "top", phase)
    return np.concatenate((face[-1:], wall)) if len(wall) and is_meridian(profile, face) else wall


def is_meridian(profile, rows):
    """One line of nodes, not a surface of them: neighbours in the file are neighbours on it."""
    return len(np.unique(profile["reference_theta_rad"][rows])) == 1
