"""What the commands in tools/ are made of. Common to all: `command_line` (options, errors), `program`
(building it, one way to start it), `tables` (Markdown, CSV), `extrapolate` (limits and errors), `run_data`
and `plot` (what a run left)."""
