#!/usr/bin/env bash
# PETSc's TS without step adaptation takes ever shorter steps from one interval of time to the next.
#
# With -ts_adapt_type none and TS_EXACTFINALTIME_MATCHSTEP one would expect steps of the length that was set,
# the last one cut so that it ends at the final time, and the length that was set again when TSSolve is
# called for the next interval. What happens: where less than two steps are left, and they are not whole,
# both are made equal, so that also the last but one is shorter; and that shorter length is what TS has from
# then on. A schedule of intervals, solved one after the other and none of them a multiple of the step, so
# ends with half the length that was asked for, for good: the run costs twice as much, and a study of the
# error over the step has another step than it says. Set the step anew before each TSSolve.
#
# Seen with PETSc 3.18.5 of Debian 12 (bookworm). Needs apt-get and network; 80 MB in a temporary folder, no
# root. Exit status: 0 as described, 1 when the behaviour is another, 2 when it could not be tried.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir -p archives/partial root
: >status

# Debian's packages and all that they need, unpacked beside the system instead of into it.
apt-get -o Dir::State::status="$folder/status" -o Dir::Cache::archives="$folder/archives" \
  -o Debug::NoLocking=1 \
  --no-install-recommends --download-only --yes --quiet install \
  python3-petsc4py-real3.18=3.18.5-1 libpetsc-real3.18=3.18.5+dfsg1-1 >apt.log 2>&1 ||
  { tail -3 apt.log >&2; exit 2; }
for package in archives/*.deb; do dpkg --extract "$package" root; done

cat >steps.py <<'PYTHON'
from petsc4py import PETSc

# du/dt = -u by backward Euler, in steps of 0.4.
ts = PETSc.TS().create()
ts.setProblemType(PETSc.TS.ProblemType.NONLINEAR)
ts.setType("beuler")
u = PETSc.Vec().createSeq(1)
matrix = PETSc.Mat().createDense((1, 1))
matrix.setUp()


def residual(ts, t, u, rate, f):
    f[0] = rate[0] + u[0]
    f.assemble()


def jacobian(ts, t, u, rate, shift, J, P):
    P[0, 0] = shift + 1
    P.assemble()


ts.setIFunction(residual, u.duplicate())
ts.setIJacobian(jacobian, matrix, matrix)
ts.setExactFinalTime(PETSc.TS.ExactFinalTime.MATCHSTEP)
times = []
ts.setMonitor(lambda ts, step, t, u: times.append(t))
ts.setTimeStep(0.4)
PETSc.Options()["ts_adapt_type"] = "none"
ts.setFromOptions()
u[0] = 1
u.assemble()
print("PETSc", ".".join(map(str, PETSc.Sys.getVersion())))
for end in (1.0, 2.0, 4.0):
    times.clear()
    ts.setMaxTime(end)
    ts.solve(u)
    print(f"until {end}:", *(f"{b - a:.3g}" for a, b in zip(times, times[1:])))
PYTHON

cat >expected <<'OUTPUT'
PETSc 3.18.5
until 1.0: 0.4 0.3 0.3
until 2.0: 0.3 0.3 0.2 0.2
until 4.0: 0.2 0.2 0.2 0.2 0.2 0.2 0.2 0.2 0.2 0.2
OUTPUT

usr=$folder/root/usr libraries=$folder/root/usr/lib/x86_64-linux-gnu
export OPAL_PREFIX=$usr OPENBLAS_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_ess_singleton_isolated=1
petsc_python=$usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages
export PYTHONPATH=$petsc_python:$usr/lib/python3/dist-packages
export LD_LIBRARY_PATH=$libraries:$libraries/openmpi/lib:$libraries/blas:$libraries/lapack
"$usr/bin/python3.11" steps.py >seen 2>errors || { tail -3 errors >&2; exit 2; }
cat seen
if ! diff expected seen; then
  echo "the behaviour is another" >&2
  exit 1
fi
