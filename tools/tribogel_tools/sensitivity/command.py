"""How much N and T at the phases' ends change with each parameter of a scene, in per cent per per cent.

  tools/sensitivity OPTIONS_FILE ... [--step 0.04] [--only PARAMETER ...] [--output DIRECTORY]
                    [-- -option value ...]
  tools/sensitivity options/paper/fig06.opts
  tools/sensitivity options/paper/fig06.opts --only "top height" K -- -elements_radial 8

Each parameter is moved up and down by the step (0.04: 4 %) and by half of it, on the same mesh (lengths by
less, since they move it); numbers are central differences extrapolated from both, their errors what the two
differ by. Both gels' parameters are moved together where the name does not say which. Coefficients of
friction that are 0 (b0, b2 in Fig. 6) have no relative change: the number is what a term does to T, in per
cent, that adds 1 % to mu at the mean speed 2/3 omega R of the phase; b0 is moved up only. Where a changed
length changes the number of elements, smaller steps are taken, and where these do too the table says so.

Writes sensitivity.csv and sensitivity.md (printed too) into the output directory, the runs below it.
Status: 0, 2 bad input, 3 some run failed (the table has no line for its parameter), 130 interrupted.
"""
from ..command_line import BadInput, Parser, need_files, progress
from ..program import program_of
from .study import Study


def main(words):
    parser = Parser("sensitivity", __doc__)
    add = parser.add_argument
    add("options_files", metavar="OPTIONS_FILE", nargs="+", help="files compose, what comes later wins")
    add("--step", type=float, default=0.04, help="relative change of a parameter (default: %(default)s)")
    add("--length-step", type=float, default=0.004,
        help="that of heights, radii and approach (default: %(default)s)")
    add("--only", nargs="+", metavar="PARAMETER", help="these alone, by the names of the table")
    parser.add_jobs()
    parser.add_program()
    parser.add_output("tribogel-sensitivity")
    a = parser.parse(words)
    need_files(a.options_files)
    if not 1e-4 <= a.step <= 0.2:
        raise BadInput(f"--step {a.step:g}; allowed: 1e-4 to 0.2")
    study = Study(program_of(a.program), a.options_files, a.further, a.output, a.step, a.length_step, a.jobs,
                  a.only, progress)
    study.run()
    study.write()
    print(study.markdown(), end="")
    return 3 if study.failures else 0
