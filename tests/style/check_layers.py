#!/usr/bin/python3
"""Holds the architecture: a folder includes only folders to its left, siblings do not include each other, and
include/ knows neither PETSc nor MPI.

  tests/style/check_layers.py [REPOSITORY]

Prints one line per broken rule, "file:line: what", and ends with status 1 when there is one.
"""
import pathlib
import re
import sys

# From left to right; the folders of one group are siblings.
LAYERS = (
    ("include/tribogel/math",),
    ("include/tribogel/material", "include/tribogel/friction", "include/tribogel/kinematics",
     "include/tribogel/schedule"),
    ("include/tribogel/element", "include/tribogel/scene"),
    ("include/tribogel/contact/node",),
    ("include/tribogel/contact/curve", "include/tribogel/contact/surface"),
    ("src/support",),
    ("src/options", "src/linear"),
    ("src/mesh",),
    ("src/gmsh",),
    ("src/bulk", "src/contact"),
    ("src/system",),
    ("src/time",),
    ("src/observe",),
    ("src",),  # main.cpp
)
LEVEL = {folder: level for level, group in enumerate(LAYERS) for folder in group}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
MACHINE_NAME = re.compile(r"\b(Petsc[A-Z]\w*|PETSC_\w+|MPI_\w+|H5[A-Z]\w+)\b")
# What physics may include besides itself: the standard library (no dot, no slash), Eigen and header-only
# Boost.
PHYSICS_MAY_INCLUDE = re.compile(r"^([a-z_0-9]+|(Eigen|boost)/.+)$")


def without_comments(text):
    """The text with comments and string literals blanked, line numbers kept. Include lines stay as they
    are."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|(?<!include )"(?:\\.|[^"\\\n])*"', re.S)
    return pattern.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def resolve(root, file, name):
    """The repository's file that an include names, or None."""
    for base in (file.parent, root / "include", root / "src"):
        target = (base / name).resolve()
        if target.is_file() and root in target.parents:
            return target
    return None


def folder_of(root, file):
    return file.parent.relative_to(root).as_posix()


def check_include(root, file, bracket, name):
    """Why this include is wrong, or None."""
    folder = folder_of(root, file)
    target = resolve(root, file, name)
    if target is None:
        if bracket == '"':
            return f'"{name}" is no file of src or include; use <> for other libraries'
        if folder.startswith("include/") and not PHYSICS_MAY_INCLUDE.match(name):
            return f"<{name}>: include/ is physics and may use the standard library, Eigen and Boost only"
        return None
    if bracket == "<":
        return f'<{name}> is our own: use ""'
    other = folder_of(root, target)
    if other == folder:
        return None
    if other not in LEVEL:
        return f"{other} is in no layer"
    if LEVEL[other] == LEVEL[folder]:
        return f"{folder} and {other} are siblings"
    if LEVEL[other] > LEVEL[folder]:
        return f"{folder} may not include {other}, which is to its right"
    return None


def check_file(root, file):
    """All broken rules of one file as (line, text)."""
    folder = folder_of(root, file)
    if folder not in LEVEL:
        return [(1, f"folder {folder} is in no layer; add it to LAYERS of tests/style/check_layers.py")]
    broken = []
    for number, line in enumerate(without_comments(file.read_text(encoding="utf-8")).split("\n"), 1):
        found = INCLUDE.match(line)
        if found:
            why = check_include(root, file, *found.groups())
            if why:
                broken.append((number, why))
        elif folder.startswith("include/") and MACHINE_NAME.search(line):
            broken.append((number, f"{MACHINE_NAME.search(line).group()} in include/, which is physics only"))
    return broken


def check(root):
    """All broken rules of a repository as lines of text, and how many files were read."""
    root = pathlib.Path(root).resolve()
    files = [file for top in ("include", "src") for file in sorted((root / top).rglob("*"))
             if file.suffix in (".hpp", ".cpp", ".h")]
    lines = []
    for file in files:
        lines += [f"{file.relative_to(root)}:{number}: {why}" for number, why in check_file(root, file)]
    return lines, len(files)


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    lines, files = check(root)
    if not files:
        lines = [f"{root}: no sources below include and src"]
    for line in lines:
        print(line)
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
