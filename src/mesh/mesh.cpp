#include "mesh/mesh.hpp"

#include <petscsf.h>

#include <algorithm>
#include <numeric>

namespace tribogel
{

namespace
{

/// DMPlex's order of a cell's vertices, counter-clockwise and, for hexahedra, with the first four seen from
/// inside, as lexicographic numbers.
constexpr int plex_corner[2][8] = {{0, 1, 3, 2}, {0, 2, 3, 1, 4, 5, 7, 6}};

/// Cells and vertex positions as DMPlex wants them.
void list_cells(const SerialMesh &serial, std::vector<PetscInt> &cells, std::vector<double> &X)
{
  for (const SerialMesh::Cell &cell : serial.cell)
    for (int v = 0; v < serial.corners(); ++v) cells.push_back(cell.vertex[plex_corner[serial.dim - 2][v]]);
  for (const auto &x : serial.vertex) X.insert(X.end(), x.begin(), x.begin() + serial.dim);
}

/// Names of the boundary and the body of each cell, on the rank that holds the serial mesh.
PetscErrorCode LabelCells(DM dm, const SerialMesh &serial)
{
  PetscInt first, cell = 0;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, nullptr));
  for (const SerialMesh::Cell &c : serial.cell) PetscCall(DMSetLabelValue(dm, "body", cell++, c.body));
  for (const SerialMesh::Facet &facet : serial.boundary) {
    PetscInt corners[4], count;
    const PetscInt *point;
    for (int v = 0; v < serial.facet_corners(); ++v) corners[v] = first + facet.vertex[v];
    PetscCall(DMPlexGetFullJoin(dm, serial.facet_corners(), corners, &count, &point));
    PetscCheck(count == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "boundary facet not found");
    PetscCall(DMSetLabelValue(dm, side_names[static_cast<int>(facet.side)], point[0], 1));
    PetscCall(DMPlexRestoreJoin(dm, serial.facet_corners(), corners, &count, &point));
  }
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Mesh::Build(MPI_Comm comm, const Scene &scene, const SerialMesh &serial)
{
  PetscFunctionBeginUser;
  order = scene.mesh.element_order;
  dim = serial.dim;
  PetscCall(Create(comm, serial));
  PetscCall(Distribute(serial));
  PetscCall(ListNodes(scene));
  PetscCall(Number());
  PetscCall(Tabulate());
  PetscCall(Place());
  PetscCall(Shape(serial));
  if (order == 2) PetscCall(PlaceMiddles(serial));
  if (scene.has_contact()) {
    PetscCall(GatherSurface(*this, Side::slave, top_body, 0, slave));
    if (scene.has_bottom())
      PetscCall(GatherSurface(*this, Side::master, bottom_body, 0, master));
    else
      master = rigid_plane(dim, order, slave);
  }
  for (int body : {bottom_body, top_body})
    if (scene.plate_contact) PetscCall(GatherSurface(*this, Side::wall, body, 1, wall[body]));
  if (order == 1) PetscCall(DropMiddles());
  natural = {};
  PetscFunctionReturn(0);
}

PetscErrorCode Mesh::Create(MPI_Comm comm, const SerialMesh &serial)
{
  PetscMPIInt rank;
  std::vector<PetscInt> corners;
  std::vector<double> X;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) list_cells(serial, corners, X);
  PetscCall(DMPlexCreateFromCellListPetsc(comm, dim, static_cast<PetscInt>(corners.size()) / serial.corners(),
                                          static_cast<PetscInt>(X.size()) / dim, serial.corners(), PETSC_TRUE,
                                          corners.data(), dim, X.data(), dm.put()));
  PetscCall(DMCreateLabel(dm, "body"));
  for (const char *name : side_names) PetscCall(DMCreateLabel(dm, name));
  if (rank == 0) PetscCall(LabelCells(dm, serial));
  for (const char *name : side_names) {
    DMLabel label;
    PetscCall(DMGetLabel(dm, name, &label));
    PetscCall(DMPlexLabelComplete(dm, label));
  }
  PetscFunctionReturn(0);
}

/// Parts of equal cell count in the order of the cells' keys, through both bodies: a graph partitioner would
/// give each body to ranks of its own and make all contact off-process.
PetscErrorCode Mesh::Distribute(const SerialMesh &serial)
{
  MPI_Comm comm;
  PetscMPIInt rank, size;
  PetscPartitioner partitioner;
  DmHandle distributed;
  PetscFunctionBeginUser;
  PetscCall(PetscObjectGetComm(reinterpret_cast<PetscObject>(static_cast<DM>(dm)), &comm));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  std::vector<PetscInt> points, sizes(size, 0);
  if (rank == 0) {
    points.resize(serial.cell.size());
    std::iota(points.begin(), points.end(), 0);
    std::stable_sort(points.begin(), points.end(),
                     [&](PetscInt a, PetscInt b) { return serial.cell[a].key < serial.cell[b].key; });
    const std::size_t n = points.size();
    for (int r = 0; r < size; ++r) sizes[r] = static_cast<PetscInt>(n * (r + 1) / size - n * r / size);
  }
  PetscCall(DMPlexGetPartitioner(dm, &partitioner));
  PetscCall(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  PetscCall(PetscPartitionerShellSetPartition(partitioner, size, rank ? nullptr : sizes.data(),
                                              rank ? nullptr : points.data()));
  PetscCall(PetscPartitionerSetFromOptions(partitioner));
  PetscSF origin = nullptr; // from each point of this rank to the one it was on the first
  PetscCall(DMPlexDistribute(dm, 0, &origin, distributed.put()));
  if (distributed) dm = std::move(distributed);
  PetscInt end, count;
  const PetscInt *point;
  const PetscSFNode *original;
  PetscCall(DMPlexGetChart(dm, nullptr, &end));
  natural.resize(end);
  std::iota(natural.begin(), natural.end(), 0);
  if (!origin) PetscFunctionReturn(0); // one rank: nothing has moved
  PetscCall(PetscSFGetGraph(origin, nullptr, &count, &point, &original));
  for (PetscInt k = 0; k < count; ++k) natural[point ? point[k] : k] = original[k].index;
  PetscCall(PetscSFDestroy(&origin));
  PetscFunctionReturn(0);
}

} // namespace tribogel
