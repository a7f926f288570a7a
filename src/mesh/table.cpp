/// Where the nodes are, who owns them, and which of them a cell has.
#include "mesh/mesh.hpp"
#include "support/petsc_arrays.hpp"

#include <petscsf.h>

#include <sstream>

namespace tribogel
{

namespace
{

/// Slots of a cell's vertices in DMPlex's order.
constexpr int corner_slot[2][8] = {{0, 2, 8, 6}, {0, 6, 8, 2, 18, 20, 26, 24}};

/// From the order-2 slot of a corner to that of order 1.
int linear_slot(int slot)
{
  return slot % 3 / 2 + slot / 3 % 3 + slot / 9 * 2;
}

} // namespace

std::string describe_place(int dim, const std::array<double, 3> &X)
{
  std::ostringstream text;
  const char *const name[2][3] = {{"R", "Z", ""}, {"x", "y", "z"}};
  for (int j = 0; j < dim; ++j) text << (j ? ", " : "") << name[dim - 2][j] << " = " << X[j] << " mm";
  return text.str();
}

PetscErrorCode CellPoints(DM dm, int dim, PetscInt cell, std::vector<CellPoint> &points)
{
  PetscInt size, *closure = nullptr;
  PetscFunctionBeginUser;
  points.clear();
  PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &size, &closure));
  const int corners = 1 << dim;
  const PetscInt *corner = closure + 2 * (size - corners); // the vertices come last; (point, orientation)
  for (PetscInt k = 0; k < size; ++k) {
    PetscInt own_size, *own = nullptr;
    int sum = 0, count = 0;
    CellPoint point{closure[2 * k], 0, 0};
    PetscCall(DMPlexGetPointDepth(dm, point.point, &point.depth));
    PetscCall(DMPlexGetTransitiveClosure(dm, point.point, PETSC_TRUE, &own_size, &own));
    for (PetscInt m = 0; m < own_size; ++m)
      for (int v = 0; v < corners; ++v)
        if (own[2 * m] == corner[2 * v]) {
          sum += corner_slot[dim - 2][v];
          ++count;
        }
    PetscCall(DMPlexRestoreTransitiveClosure(dm, point.point, PETSC_TRUE, &own_size, &own));
    PetscCheck(count > 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a point of a cell without corners");
    point.slot = sum / count;
    points.push_back(point);
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &size, &closure));
  PetscFunctionReturn(0);
}

/// The cells and their nodes.
PetscErrorCode Mesh::Tabulate()
{
  PetscInt end, first, last;
  std::vector<CellPoint> points;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, nullptr, &end));
  std::vector<int> node_of_point(end, -1);
  for (std::size_t n = 0; n < nodes.size(); ++n) node_of_point[nodes[n].point] = static_cast<int>(n);
  cells.clear();
  PetscCall(DMPlexGetHeightStratum(dm, 0, &first, &last));
  cells.reserve(last - first);
  for (PetscInt c = first; c < last; ++c) {
    MeshCell cell{};
    PetscInt body;
    PetscCall(DMGetLabelValue(dm, "body", c, &body));
    cell.body = static_cast<int>(body);
    cell.natural = natural[c];
    cell.node.fill(-1);
    PetscCall(CellPoints(dm, dim, c, points));
    for (const CellPoint &point : points)
      if (order == 2)
        cell.node[point.slot] = node_of_point[point.point];
      else if (point.depth == 0)
        cell.node[linear_slot(point.slot)] = node_of_point[point.point];
    for (int a = 0; a < nodes_per_cell(); ++a) nodes[cell.node[a]].body = cell.body;
    cells.push_back(cell);
  }
  PetscFunctionReturn(0);
}

/// Owners of the nodes and their places in the grid: each is the mean of its point's vertices.
PetscErrorCode Mesh::Place()
{
  PetscInt end, leaves;
  const PetscInt *leaf;
  PetscSF sf;
  Vec coordinates;
  PetscSection coordinate_section;
  ConstArray X;
  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, nullptr, &end));
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, nullptr, &leaves, &leaf, nullptr));
  std::vector<char> ghost(end, 0);
  for (PetscInt k = 0; k < leaves; ++k) ghost[leaf ? leaf[k] : k] = 1;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &coordinate_section));
  PetscCall(X.Get(coordinates));
  for (Node &node : nodes) {
    node.owned = !ghost[node.point];
    PetscInt size, *closure = nullptr;
    int vertices = 0;
    PetscCall(DMPlexGetTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    for (PetscInt k = 0; k < size; ++k) {
      PetscInt depth, offset;
      PetscCall(DMPlexGetPointDepth(dm, closure[2 * k], &depth));
      if (depth > 0) continue;
      PetscCall(PetscSectionGetOffset(coordinate_section, closure[2 * k], &offset));
      for (int j = 0; j < dim; ++j) node.X[j] += PetscRealPart(X[offset + j]);
      ++vertices;
    }
    PetscCall(DMPlexRestoreTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    for (double &x : node.X) x /= vertices;
  }
  PetscFunctionReturn(0);
}

/// Moves the nodes, and the DM's vertices with them, from their places in the grid to the bodies' shapes.
PetscErrorCode Mesh::Shape(const SerialMesh &serial)
{
  Vec coordinates;
  PetscSection section;
  PetscInt first, last, offset;
  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, &last));
  {
    MutableArray X;
    PetscCall(X.Get(coordinates));
    for (Node &node : nodes) {
      if (serial.shape[node.body]) node.X = serial.shape[node.body](node.X);
      if (node.point < first || node.point >= last) continue;
      PetscCall(PetscSectionGetOffset(section, node.point, &offset));
      for (int j = 0; j < dim; ++j) X[offset + j] = node.X[j];
    }
  }
  PetscCall(DMSetCoordinatesLocal(dm, coordinates)); // drops the global ones
  PetscFunctionReturn(0);
}

} // namespace tribogel
