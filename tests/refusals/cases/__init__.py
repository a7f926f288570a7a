"""The cases by subject. Each module has

REFUSALS           name, words on the command line, what the line must contain besides "allowed: "
ON_TWO_PROCESSES   names of those that take different ways through the program
RUNS               name, words, what stdout must contain; exit status 0
prepare(folder)    makes the files that its cases expect to find there
"""
from . import files, mesh_files, scene, solver, values

SUBJECTS = (values, files, solver, scene, mesh_files)
