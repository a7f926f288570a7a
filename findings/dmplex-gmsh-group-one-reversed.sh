#!/usr/bin/env bash
# PETSc's reader of Gmsh files loses a physical surface that has the number 1 and is reversed.
#
# Gmsh writes the number of a physical group with a minus sign at an entity that the group takes reversed
# ("Physical Surface(1) = {-5};"), so that its normals point the other way. One would expect
# DMPlexCreateFromFile to put the faces of such a surface into the label "Face Sets", under 1 or, at worst,
# under -1, and so it does for every other number: group 2 reversed is stratum -2, group 7 is -7. Only group
# 1 reversed is in no stratum at all. -1 is what a DMLabel returns for "no value", and the reader takes it
# for that. Groups are numbered from 1, so the first boundary that a user defines is the one that loses its
# condition, without a word.
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

cat >read.py <<'PYTHON'
from petsc4py import PETSc

# A unit cube: one hexahedron, its lower face in one physical surface, its upper face in another.
MESH = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
2 {lower} "lower"
2 {upper} "upper"
3 9 "cube"
$EndPhysicalNames
$Entities
0 0 2 1
1 0 0 0 1 1 0 1 {as_written} 0
2 0 0 1 1 1 1 1 {upper} 0
1 0 0 0 1 1 1 1 9 0
$EndEntities
$Nodes
1 8 1 8
3 1 0 8
1
2
3
4
5
6
7
8
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
$EndNodes
$Elements
3 3 1 3
2 1 3 1
1 4 3 2 1
2 2 3 1
2 5 6 7 8
3 1 5 1
3 1 2 3 4 5 6 7 8
$EndElements
"""
print("PETSc", ".".join(map(str, PETSc.Sys.getVersion())))
for lower, upper in ((7, 8), (2, 3), (1, 2)):
    for sign in (1, -1):
        with open("cube.msh", "w") as file:
            file.write(MESH.format(lower=lower, upper=upper, as_written=sign * lower))
        mesh = PETSc.DMPlex().createFromFile("cube.msh", "cube", True)
        strata = [int(value) for value in mesh.getLabelIdIS("Face Sets").getIndices()]
        faces = [mesh.getStratumSize("Face Sets", value) for value in strata]
        orientation = " reversed" if sign < 0 else ""
        print(f"group {lower}{orientation} and group {upper}: strata {strata}, faces {faces}")
PYTHON

cat >expected <<'OUTPUT'
PETSc 3.18.5
group 7 and group 8: strata [7, 8], faces [1, 1]
group 7 reversed and group 8: strata [-7, 8], faces [1, 1]
group 2 and group 3: strata [2, 3], faces [1, 1]
group 2 reversed and group 3: strata [-2, 3], faces [1, 1]
group 1 and group 2: strata [1, 2], faces [1, 1]
group 1 reversed and group 2: strata [2], faces [1]
OUTPUT

usr=$folder/root/usr libraries=$folder/root/usr/lib/x86_64-linux-gnu
export OPAL_PREFIX=$usr OPENBLAS_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_ess_singleton_isolated=1
petsc_python=$usr/lib/petscdir/petsc3.18/x86_64-linux-gnu-real/lib/python3/dist-packages
export PYTHONPATH=$petsc_python:$usr/lib/python3/dist-packages
export LD_LIBRARY_PATH=$libraries:$libraries/openmpi/lib:$libraries/blas:$libraries/lapack
"$usr/bin/python3.11" read.py >seen 2>errors || { tail -3 errors >&2; exit 2; }
cat seen
if ! diff expected seen; then
  echo "the behaviour is another" >&2
  exit 1
fi
