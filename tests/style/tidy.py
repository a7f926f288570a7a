#!/usr/bin/python3
"""clang-tidy on src and include, two processes at a time; each header of include stands alone. Status 1 when it finds something.

  tidy.py BUILD_DIRECTORY [FOLDER ...]      default: every folder of src, and include

The sources of a folder are read as one, and all headers of include as one: clang-tidy's time goes into the headers that they
share (11 CPU minutes file by file, about 5 like this). So names in the anonymous namespaces of one folder have to differ; "redefinition" says
when they do not. The analyzer must be told to look beyond the main file, and gives up on a function after --nodes states (its own
limit, 225,000, doubles the time).
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
OURS = r"(include/tribogel/[a-z]+|/src(/[a-z]+)?)/[a-z_]+\.[ch]pp$"  # not Eigen/src/Core/*.h
NOISE = re.compile(r"^\d+ warnings?( and \d+ errors?)? (generated|treated as errors?)|^Suppressed|^Use -header-filter|^$", re.M)


def flags(build):
    """Of the machine library's sources, all the same; without compiler, output and GCC's precompiled header."""
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
    found = {}
    for path in sorted((repository / "src").rglob("*.cpp")):
        found.setdefault(path.parent.name, []).append(path)
    found["include"] = sorted((repository / "include").rglob("*.hpp"))
    slowest = ("contact", "include", "bulk", "observe")
    return dict(sorted(found.items(), key=lambda item: slowest.index(item[0]) if item[0] in slowest else len(slowest)))


def said(*words):
    """Status and findings of clang-tidy."""
    done = subprocess.run(["clang-tidy", "--quiet", *words], capture_output=True, text=True, check=False)
    return done.returncode, "\n".join(line for line in (done.stdout + done.stderr).splitlines() if not NOISE.match(line))


def alone(path, compiler_flags, directory):
    """What stops a header from being included first. With next to no check; the other errors come from the compiler. Not the header
    itself as the source: one that is included at the end of another would be read twice, since `#pragma once` is nothing in a source."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp", dir=directory) as source:
        source.write(f'#include "{path}"\n')
        source.flush()
        return said("--checks=-*,readability-misleading-indentation", source.name, "--", *compiler_flags)


def together(paths, compiler_flags, nodes, directory):
    """What there is to be found in files read as one."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp", dir=directory) as source:
        source.writelines(f'#include "{path}" // NOLINT(bugprone-suspicious-include)\n' for path in paths)
        source.flush()
        clang = [word for option in ("-analyzer-opt-analyze-headers", "-analyzer-config", f"max-nodes={nodes}")
                 for word in ("-Xclang", option)]
        return said(f"--config-file={REPOSITORY / '.clang-tidy'}", f"--header-filter={OURS}", source.name, "--", *compiler_flags, *clang)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD_DIRECTORY")
    parser.add_argument("folders", nargs="*", metavar="FOLDER")
    parser.add_argument("--nodes", type=int, default=20000, help="default: %(default)s")
    a = parser.parse_args()
    chosen = {name: paths for name, paths in groups(REPOSITORY).items() if not a.folders or name in a.folders}
    common, failed = flags(a.build), False
    with tempfile.TemporaryDirectory() as directory, concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(together, paths, common, a.nodes, directory) for paths in chosen.values()]
        jobs += [pool.submit(alone, path, common, directory) for path in chosen.get("include", [])]
        for job in jobs:
            status, text = job.result()
            failed = failed or status != 0
            if text:
                print(text, flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
