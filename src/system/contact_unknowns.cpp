/// What the contact preconditioner asks for: which unknowns are what, and how fields of order 2 follow from
/// their values at the cells' vertices.
#include "system/system.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

/// Row and coordinate of each displacement that this rank owns.
using Places = std::vector<std::pair<PetscInt, double>>;

PetscErrorCode CreatePlaces(MPI_Comm comm, Places &places, bool whole_nodes, VecHandle &place)
{
  PetscScalar *values;
  PetscFunctionBeginUser;
  std::sort(places.begin(), places.end());
  PetscCall(VecCreate(comm, place.put()));
  PetscCall(VecSetSizes(place, static_cast<PetscInt>(places.size()), PETSC_DETERMINE));
  if (whole_nodes) PetscCall(VecSetBlockSize(place, 3));
  PetscCall(VecSetType(place, VECSTANDARD));
  PetscCall(VecGetArray(place, &values));
  for (const auto &[row, coordinate] : places) *values++ = coordinate;
  values -= places.size();
  PetscCall(VecRestoreArray(place, &values));
  PetscFunctionReturn(0);
}

/// Of a cell of order 2: the vertices whose mean a node is the place of, by the node's lexicographic number.
std::vector<int> vertices_of(int node)
{
  std::vector<int> all{0};
  for (int direction = 0, stride = 1; direction < 3; ++direction, stride *= 3) {
    const int at = node / stride % 3;
    std::vector<int> next;
    for (int number : all)
      for (int end : {0, 2})
        if (at == 1 || at == end) next.push_back(number + end * stride);
    all = next;
  }
  return all;
}

} // namespace

PetscErrorCode System::ListContactUnknowns()
{
  ISLocalToGlobalMapping mapping;
  const PetscInt *to_global;
  auto list = std::make_shared<ContactUnknowns>();
  Places places;
  PetscFunctionBeginUser;
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
  for (const Node &node : mesh.nodes) {
    if (!node.owned) continue;
    for (int i = 0; i < 3; ++i)
      if (!(node.prescribed >> i & 1u)) places.emplace_back(to_global[node.displacement + i], node.X[i]);
    if (node.prescribed != 0 && node.prescribed != 7) list->whole_nodes = false;
    if (node.traction < 0) continue;
    list->slave.push_back(node.prescribed ? -1 : to_global[node.displacement]);
    list->multiplier.push_back(to_global[node.traction]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &list->whole_nodes, 1, MPI_CXX_BOOL, MPI_LAND, comm()));
  PetscCall(CreatePlaces(comm(), places, list->whole_nodes, list->place));
  for (const auto &[row, coordinate] : places) list->displacement.push_back(row);
  if (mesh.order == 2 && list->whole_nodes) PetscCall(InterpolateFromVertices(to_global, *list));
  PetscCall(ISLocalToGlobalMappingRestoreIndices(mapping, &to_global));
  contact_unknowns = list;
  PetscFunctionReturn(0);
}

/// A field of order 1 on the same cells, as one of order 2: at edges, faces and centres the mean of the
/// vertices.
PetscErrorCode System::InterpolateFromVertices(const PetscInt *to_global, ContactUnknowns &list)
{
  VecHandle number, local;
  PetscScalar *values;
  const PetscScalar *column;
  PetscInt first, first_row, first_column;
  Places places;
  std::vector<bool> vertex(mesh.nodes.size(), false);
  PetscFunctionBeginUser;
  for (const MeshCell &cell : mesh.cells)
    for (int a = 0; a < 27; ++a)
      if (vertices_of(a).size() == 1) vertex[cell.node[a]] = true;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    for (int i = 0; i < 3 && vertex[n] && mesh.nodes[n].owned && !mesh.nodes[n].prescribed; ++i)
      places.emplace_back(to_global[mesh.nodes[n].displacement + i], mesh.nodes[n].X[i]);
  PetscCall(CreatePlaces(comm(), places, true, list.vertex_place));

  PetscCall(DMCreateGlobalVector(mesh.dm, number.put()));
  PetscCall(DMCreateLocalVector(mesh.dm, local.put()));
  PetscCall(VecGetOwnershipRange(number, &first, nullptr));
  PetscCall(VecGetOwnershipRange(list.place, &first_row, nullptr));
  PetscCall(VecGetOwnershipRange(list.vertex_place, &first_column, nullptr));
  PetscCall(VecGetArrayWrite(number, &values));
  for (std::size_t k = 0; k < places.size(); ++k)
    values[places[k].first - first] = first_column + static_cast<double>(k); // exact
  PetscCall(VecRestoreArrayWrite(number, &values));
  PetscCall(DMGlobalToLocal(mesh.dm, number, INSERT_VALUES, local));

  const auto own_rows = static_cast<PetscInt>(list.displacement.size());
  PetscCall(MatCreateAIJ(comm(), own_rows, static_cast<PetscInt>(places.size()), PETSC_DETERMINE,
                         PETSC_DETERMINE, 8, nullptr, 8, nullptr, list.from_vertices.put()));
  PetscCall(VecGetArrayRead(local, &column));
  for (const MeshCell &cell : mesh.cells)
    for (int a = 0; a < 27; ++a) {
      const Node &node = mesh.nodes[cell.node[a]];
      const std::vector<int> vertices = vertices_of(a);
      for (int i = 0; i < 3 && node.owned && !node.prescribed; ++i) {
        const auto at = std::lower_bound(list.displacement.begin(), list.displacement.end(),
                                         to_global[node.displacement + i]);
        const PetscInt row = first_row + static_cast<PetscInt>(at - list.displacement.begin());
        for (int v : vertices) {
          const Node &end = mesh.nodes[cell.node[v]];
          if (!end.prescribed)
            PetscCall(MatSetValue(list.from_vertices, row,
                                  static_cast<PetscInt>(column[end.displacement + i]),
                                  1.0 / static_cast<double>(vertices.size()), INSERT_VALUES));
        }
      }
    }
  PetscCall(VecRestoreArrayRead(local, &column));
  PetscCall(MatSetBlockSizes(list.from_vertices, 3, 3));
  PetscCall(MatAssemblyBegin(list.from_vertices, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(list.from_vertices, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

} // namespace tribogel
