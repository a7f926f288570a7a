#include "mesh/mesh.hpp"

#include <petscsf.h>

#include <algorithm>
#include <numeric>

namespace tribogel
{

namespace
{

/// Local plex of all blocks on rank 0, empty on the others: cells, vertex coordinates.
void number_blocks(const std::vector<MeridianBlock> &blocks, std::vector<PetscInt> &cells, std::vector<double> &X)
{
  for (const MeridianBlock &block : blocks) {
    const auto offset = static_cast<PetscInt>(X.size() / 2), columns = static_cast<PetscInt>(block.R.size());
    for (const double z : block.Z)
      for (const double r : block.R) X.insert(X.end(), {r, z});
    for (PetscInt j = 0; j + 1 < static_cast<PetscInt>(block.Z.size()); ++j)
      for (PetscInt i = 0; i + 1 < columns; ++i) {
        const PetscInt corner = offset + j * columns + i;
        cells.insert(cells.end(), {corner, corner + 1, corner + columns + 1, corner + columns});
      }
  }
}

PetscErrorCode LabelEdge(DM dm, PetscInt a, PetscInt b, Side side)
{
  const PetscInt ends[2] = {a, b};
  PetscInt count;
  const PetscInt *edge;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetFullJoin(dm, 2, ends, &count, &edge));
  PetscCheck(count == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB, "boundary edge not found");
  PetscCall(DMSetLabelValue(dm, side_names[static_cast<int>(side)], edge[0], 1));
  PetscCall(DMPlexRestoreJoin(dm, 2, ends, &count, &edge));
  PetscFunctionReturn(0);
}

/// Names of the outline and the body of each cell, on the rank that holds the serial mesh.
PetscErrorCode LabelBlocks(DM dm, const std::vector<MeridianBlock> &blocks)
{
  PetscInt vertex, cell = 0;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vertex, nullptr));
  for (const MeridianBlock &block : blocks) {
    const auto columns = static_cast<PetscInt>(block.R.size()), rows = static_cast<PetscInt>(block.Z.size());
    for (long k = 0; k < block.cells(); ++k) PetscCall(DMSetLabelValue(dm, "body", cell++, block.body));
    for (PetscInt i = 0; i + 1 < columns; ++i) {
      PetscCall(LabelEdge(dm, vertex + i, vertex + i + 1, block.lower));
      PetscCall(LabelEdge(dm, vertex + (rows - 1) * columns + i, vertex + (rows - 1) * columns + i + 1, block.upper));
    }
    for (PetscInt j = 0; j + 1 < rows; ++j) {
      PetscCall(LabelEdge(dm, vertex + j * columns, vertex + (j + 1) * columns, block.inner));
      PetscCall(LabelEdge(dm, vertex + (j + 1) * columns - 1, vertex + (j + 2) * columns - 1, block.outer));
    }
    vertex += columns * rows;
  }
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Mesh::Build(MPI_Comm comm, const Scene &scene, const std::vector<MeridianBlock> &blocks)
{
  PetscFunctionBeginUser;
  order = scene.mesh.element_order;
  PetscCall(Create(comm, blocks));
  PetscCall(Distribute(blocks));
  PetscCall(Number(scene));
  PetscCall(Tabulate());
  PetscCall(Shape(blocks));
  if (scene.has_top) {
    PetscCall(GatherSurface(*this, Side::slave, top_body, 0, slave));
    PetscCall(GatherSurface(*this, Side::master, bottom_body, 0, master));
  }
  for (int body : {bottom_body, top_body})
    if (scene.plate_contact && (body == bottom_body || scene.has_top))
      PetscCall(GatherSurface(*this, Side::wall, body, 1, wall[body]));
  PetscFunctionReturn(0);
}

PetscErrorCode Mesh::Create(MPI_Comm comm, const std::vector<MeridianBlock> &blocks)
{
  PetscMPIInt rank;
  std::vector<PetscInt> corners;
  std::vector<double> X;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) number_blocks(blocks, corners, X);
  PetscCall(DMPlexCreateFromCellListPetsc(comm, 2, static_cast<PetscInt>(corners.size() / 4),
                                          static_cast<PetscInt>(X.size() / 2), 4, PETSC_TRUE, corners.data(), 2,
                                          X.data(), dm.put()));
  PetscCall(DMCreateLabel(dm, "body"));
  for (const char *name : side_names) PetscCall(DMCreateLabel(dm, name));
  if (rank == 0) PetscCall(LabelBlocks(dm, blocks));
  for (const char *name : side_names) {
    DMLabel label;
    PetscCall(DMGetLabel(dm, name, &label));
    PetscCall(DMPlexLabelComplete(dm, label));
  }
  PetscFunctionReturn(0);
}

/// Bands of equal cell count in R through both bodies: a graph partitioner would give each body to ranks of its own and
/// make all contact off-process.
PetscErrorCode Mesh::Distribute(const std::vector<MeridianBlock> &blocks)
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
    std::vector<double> middle;
    for (const MeridianBlock &block : blocks)
      for (std::size_t j = 0; j + 1 < block.Z.size(); ++j)
        for (std::size_t i = 0; i + 1 < block.R.size(); ++i) middle.push_back(0.5 * (block.R[i] + block.R[i + 1]));
    points.resize(middle.size());
    std::iota(points.begin(), points.end(), 0);
    std::stable_sort(points.begin(), points.end(), [&](PetscInt a, PetscInt b) { return middle[a] < middle[b]; });
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

/// Prescribed displacement components of a point: those of its plate, and u_R on the axis.
PetscErrorCode Mesh::Constrain(PetscSection section, PetscInt point, unsigned sides, PlateBond bond, bool indices)
{
  const auto on = [sides](Side side) { return sides >> static_cast<int>(side) & 1u; };
  std::vector<PetscInt> fixed;
  PetscFunctionBeginUser;
  const bool plate = on(Side::top_plate) || on(Side::bottom_plate);
  if (on(Side::axis) || (plate && bond == PlateBond::glued)) fixed.push_back(0);
  if (plate) fixed.insert(fixed.end(), {1, 2});
  const auto count = static_cast<PetscInt>(fixed.size());
  if (count && indices) {
    PetscCall(PetscSectionSetFieldConstraintIndices(section, point, 0, fixed.data()));
    PetscCall(PetscSectionSetConstraintIndices(section, point, fixed.data()));
  } else if (count) {
    PetscCall(PetscSectionSetFieldConstraintDof(section, point, 0, count));
    PetscCall(PetscSectionSetConstraintDof(section, point, count));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Mesh::Number(const Scene &scene)
{
  PetscSection section;
  PetscInt start, end;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &start, &end));
  PetscCall(PetscSectionCreate(PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(dm))), &section));
  PetscCall(PetscSectionSetNumFields(section, 2));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldName(section, 1, "traction"));
  for (int field = 0; field < 2; ++field) PetscCall(PetscSectionSetFieldComponents(section, field, 3));
  PetscCall(PetscSectionSetChart(section, start, end));

  nodes.clear();
  DMLabel labels[side_count];
  for (int k = 0; k < side_count; ++k) PetscCall(DMGetLabel(dm, side_names[k], &labels[k]));
  for (PetscInt point = start; point < end; ++point) {
    PetscInt depth;
    PetscCall(DMPlexGetPointDepth(dm, point, &depth));
    if (depth > 0 && order == 1) continue;
    Node node{};
    node.point = point;
    node.natural = natural[point];
    for (int k = 0; k < side_count; ++k) {
      PetscBool inside;
      PetscCall(DMLabelStratumHasPoint(labels[k], 1, point, &inside));
      if (inside) node.sides |= 1u << k;
    }
    // A vertex on the axis has no dual weight at order 2 (THEORY 3.1); a prescribed node's pressure belongs to the
    // glue.
    const bool weightless = order == 2 && node.on(Side::axis);
    const bool bonded = node.on(Side::top_plate) || node.on(Side::bottom_plate);
    const bool free_wall = scene.plate_contact && node.on(Side::wall) && !node.on(Side::master);
    const bool multiplier = ((node.on(Side::slave) && !weightless) || free_wall) && !bonded;
    node.traction = multiplier ? 0 : -1;
    PetscCall(PetscSectionSetFieldDof(section, point, 0, 3));
    if (multiplier) PetscCall(PetscSectionSetFieldDof(section, point, 1, 3));
    PetscCall(PetscSectionSetDof(section, point, multiplier ? 6 : 3));
    PetscCall(Constrain(section, point, node.sides, scene.plate_bond, false));
    nodes.push_back(node);
  }
  PetscCall(PetscSectionSetUp(section));
  for (Node &node : nodes) {
    PetscCall(Constrain(section, node.point, node.sides, scene.plate_bond, true));
    PetscCall(PetscSectionGetFieldOffset(section, node.point, 0, &node.displacement));
    if (node.traction == 0) PetscCall(PetscSectionGetFieldOffset(section, node.point, 1, &node.traction));
  }
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscSection global;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscInt owned;
  PetscCall(PetscSectionGetConstrainedStorageSize(global, &owned));
  PetscCallMPI(MPI_Allreduce(&owned, &unknowns, 1, MPIU_INT, MPI_SUM,
                             PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(dm)))));
  PetscFunctionReturn(0);
}

namespace
{

/// Slot of the point that is the mean of the corners (i, j) in the lexicographic order of an order-2 quadrilateral.
constexpr int corner_slot[2][4] = {{0, 1, 3, 2}, {0, 2, 8, 6}};

PetscErrorCode CellNodes(DM dm, PetscInt cell, int order, const std::vector<int> &node_of_point,
                         std::array<int, 9> &slots)
{
  PetscInt size, *closure = nullptr;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &size, &closure));
  PetscInt corners[4];
  for (int v = 0; v < 4; ++v) { // one cell, four edges, four vertices, as (point, orientation)
    corners[v] = closure[2 * (5 + v)];
    slots[corner_slot[order - 1][v]] = node_of_point[corners[v]];
  }
  if (order == 2) {
    slots[4] = node_of_point[cell];
    for (int e = 0; e < 4; ++e) {
      const PetscInt edge = closure[2 * (1 + e)], *ends;
      PetscCall(DMPlexGetCone(dm, edge, &ends));
      int sum = 0;
      for (int v = 0; v < 4; ++v)
        if (corners[v] == ends[0] || corners[v] == ends[1]) sum += corner_slot[1][v];
      slots[sum / 2] = node_of_point[edge];
    }
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &size, &closure));
  PetscFunctionReturn(0);
}

} // namespace

/// Positions and owners of the nodes, and the cells' nodes.
PetscErrorCode Mesh::Tabulate()
{
  PetscInt start, end, first, last, leaves;
  const PetscInt *leaf;
  PetscSF sf;
  Vec coordinates;
  PetscSection coordinate_section;
  const PetscScalar *X;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &start, &end));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, nullptr, &leaves, &leaf, nullptr));
  std::vector<char> ghost(end, 0);
  for (PetscInt k = 0; k < leaves; ++k) ghost[leaf ? leaf[k] : k] = 1;

  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &coordinate_section));
  PetscCall(VecGetArrayRead(coordinates, &X));
  std::vector<int> node_of_point(end, -1);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Node &node = nodes[n];
    node_of_point[node.point] = static_cast<int>(n);
    node.owned = !ghost[node.point];
    PetscInt size, *closure = nullptr;
    int vertices = 0;
    PetscCall(DMPlexGetTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    for (PetscInt k = 0; k < size; ++k) {
      PetscInt depth, offset;
      PetscCall(DMPlexGetPointDepth(dm, closure[2 * k], &depth));
      if (depth > 0) continue;
      PetscCall(PetscSectionGetOffset(coordinate_section, closure[2 * k], &offset));
      for (int j = 0; j < 2; ++j) node.X[j] += PetscRealPart(X[offset + j]);
      ++vertices;
    }
    PetscCall(DMPlexRestoreTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    for (double &x : node.X) x /= vertices;
  }
  PetscCall(VecRestoreArrayRead(coordinates, &X));

  cells.clear();
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, &last));
  for (PetscInt c = first; c < last; ++c) {
    MeshCell cell{};
    PetscInt body;
    PetscCall(DMGetLabelValue(dm, "body", c, &body));
    cell.body = static_cast<int>(body);
    cell.natural = natural[c];
    PetscCall(CellNodes(dm, c, order, node_of_point, cell.node));
    for (int a = 0; a < nodes_per_cell(); ++a) nodes[cell.node[a]].body = cell.body;
    cells.push_back(cell);
  }
  PetscFunctionReturn(0);
}

/// Moves the nodes, and the DM's vertices with them, from their places in the grid to the blocks' shapes.
PetscErrorCode Mesh::Shape(const std::vector<MeridianBlock> &blocks)
{
  Vec coordinates;
  PetscSection section;
  PetscScalar *X;
  PetscInt first, last, offset;
  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, &last));
  PetscCall(VecGetArray(coordinates, &X));
  for (Node &node : nodes) {
    for (const MeridianBlock &block : blocks)
      if (block.body == node.body && block.shape) node.X = block.shape(node.X[0], node.X[1]);
    if (node.point < first || node.point >= last) continue;
    PetscCall(PetscSectionGetOffset(section, node.point, &offset));
    for (int j = 0; j < 2; ++j) X[offset + j] = node.X[j];
  }
  PetscCall(VecRestoreArray(coordinates, &X));
  PetscCall(DMSetCoordinatesLocal(dm, coordinates)); // drops the global ones
  PetscFunctionReturn(0);
}

} // namespace tribogel
