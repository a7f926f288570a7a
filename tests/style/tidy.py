#!/usr/bin/python3
"""clang-tidy on src and include, two processes at a time; each header of include stands alone. Status 1 when
it finds something.

  tidy.py BUILD_DIRECTORY [FOLDER ...]      default: every folder of src, and include

clang-tidy's time goes into headers that files share, so the sources of a folder are one file for it, with the
project's headers in them, and all of include is in that of contact, which makes most use of it. Names in the
anonymous namespaces of one folder have to differ: "redefinition" says when they do not. A file without
includes of the project, and not one that includes what it is made of, since the analyzer looks beyond the
main file at all or nothing, and half of the time would go into Eigen's functions. It gives up on a function
after --nodes states.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
# in which the compiler looks for the project's headers
FOLDERS = (REPOSITORY / "src", REPOSITORY / "include")
NOISE = re.compile(r"^\d+ warnings?( and \d+ errors?)? (generated|treated as errors?)|^Suppressed|^Use "
                   r"-header-filter|^$", re.M)


def flags(build):
    """Of the machine library's sources, all the same; without compiler, output and GCC's precompiled
    header."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        if pathlib.Path(entry["file"]).is_relative_to(REPOSITORY / "src"):
            words = shlex.split(entry["command"])
            words = words[next(k for k, word in enumerate(words) if word.startswith("-")):words.index("-o")]
            if "-include" in words:
                k = words.index("-include")
                words = words[:k] + words[k + 2:]
            return words + ["-Wno-unknown-warning-option", "-Wno-ignored-optimization-argument"]
    raise SystemExit(f"tidy: error: {build} does not build src")


def groups(repository):
    """Name: files that are read as one, the slowest first."""
    found = {"contact": headers(repository)}
    for path in sorted((repository / "src").rglob("*.cpp")):
        found.setdefault(path.parent.name, []).append(path)
    slowest = ("contact", "bulk", "observe")
    return dict(sorted(found.items(),
                       key=lambda item: slowest.index(item[0]) if item[0] in slowest else len(slowest)))


def headers(repository):
    return sorted((repository / "include").rglob("*.hpp"))


def first_includers(paths):
    """The headers with which all stand alone if they do: a header that begins with another one shows that the
    other can be first."""
    begin = (re.search(r'^#include (?:"(.+)"|<)', path.read_text(encoding="utf-8"), re.M) for path in paths)
    shown = {REPOSITORY / "include" / found[1] for found in begin if found and found[1]}
    return [path for path in paths if path not in shown]


def said(*words):
    """Status and findings of clang-tidy."""
    done = subprocess.run(["clang-tidy", "--quiet", *words], capture_output=True, text=True, check=False)
    return done.returncode, "\n".join(line for line in (done.stdout + done.stderr).splitlines()
                                      if not NOISE.match(line))


def alone(path, compiler_flags):
    """What stops a header from being included first: what clang-tidy's compiler says. Not the header itself
    as the source: one that is included at the end of another would be read twice, since `#pragma once` is
    nothing in a source."""
    compiler = pathlib.Path(shutil.which("clang-tidy")).resolve().with_name("clang++")
    done = subprocess.run([compiler, *compiler_flags, "-w", "-fsyntax-only", "-x", "c++", "-"],
                          input=f'#include "{path}"\n',
                          capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def unrolled(path, done, origin):
    """The lines of a file with those of the project's headers that it includes in place of the lines that do,
    each once. Where each line comes from is added to `origin`."""
    done.add(path)
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        include = re.match(r'#include "(.+)"', line)
        header = include and next((folder / include[1] for folder in FOLDERS
                                   if (folder / include[1]).exists()), None)
        if header and header not in done:
            yield from unrolled(header, done, origin)
        else:
            origin.append(f"{path.relative_to(REPOSITORY)}:{number}")
            yield "" if header or line == "#pragma once" else line


def together(paths, compiler_flags, nodes, directory):
    """What there is to be found in files read as one."""
    done, origin = set(), []
    lines = [line for path in paths if path not in done for line in unrolled(path, done, origin)]
    with tempfile.NamedTemporaryFile("w", suffix=".cpp", dir=directory) as source:
        source.write("\n".join(lines) + "\n")
        source.flush()
        status, text = said(f"--config-file={REPOSITORY / '.clang-tidy'}", source.name, "--",
                            *compiler_flags, "-Xclang",
                            "-analyzer-config", "-Xclang", f"max-nodes={nodes}")
        return status, re.sub(rf"{re.escape(source.name)}:(\d+)", lambda at: origin[int(at[1]) - 1], text)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD_DIRECTORY")
    parser.add_argument("folders", nargs="*", metavar="FOLDER")
    parser.add_argument("--nodes", type=int, default=20000, help="default: %(default)s")
    a = parser.parse_args()
    chosen = {name: paths for name, paths in groups(REPOSITORY).items() if not a.folders or name in a.folders}
    stand_alone = first_includers(headers(REPOSITORY)) if not a.folders or "include" in a.folders else []
    common, failed = flags(a.build), False
    with tempfile.TemporaryDirectory() as directory, concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(together, paths, common, a.nodes, directory) for paths in chosen.values()]
        jobs += [pool.submit(alone, path, common) for path in stand_alone]
        for job in jobs:
            status, text = job.result()
            failed = failed or status != 0
            if text:
                print(text, flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
