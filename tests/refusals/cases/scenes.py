"""Scenes that are over in a moment, for what must run."""

SMALL = ["-specimens", "bottom", "-element_order", "1", "-elements_radial", "2", "-schedule_end_times", "1",
         "-schedule_approach", "0.05", "-schedule_rates", "0"]

SOLID = ["-model", "solid"]
BRIEF = ["-element_order", "1", "-schedule_end_times", "1", "-schedule_approach", "0.01", "-schedule_rates",
         "0"]
