#include "mesh/mesh.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tribogel
{

namespace
{

/// One facet as it travels between ranks: global and original numbers of its points and their positions, in
/// the order of Surface::facet.
struct FacetRecord {
  PetscInt cell, side; ///< original number of its cell, place in that: an order of the facets
  PetscInt key[9];     ///< -1 where unused
  double X[9][3];
};

/// Slots in the cell of the nodes of the face whose middle is `middle`, order 2, seen from outside.
std::array<int, 9> face_slots(int middle)
{
  constexpr int stride[3] = {1, 3, 9};
  int axis = 0;
  while (axis < 2 && middle / stride[axis] % 3 == 1) ++axis;
  int xi = (axis + 1) % 3, eta = (axis + 2) % 3;
  if (middle / stride[axis] % 3 == 0) std::swap(xi, eta);
  std::array<int, 9> slots;
  for (int k = 0; k < 9; ++k) slots[k] = middle + (k % 3 - 1) * stride[xi] + (k / 3 - 1) * stride[eta];
  return slots;
}

/// Points of the facet with this middle slot, in the order of Surface::facet; -1 where there is no node.
std::array<PetscInt, 9> facet_points(const Mesh &mesh, const std::array<PetscInt, 27> &point, int middle,
                                     int direction, const std::map<PetscInt, const Node *> &node_of_point)
{
  std::array<PetscInt, 9> points;
  points.fill(-1);
  if (mesh.dim == 3) {
    const auto slots = face_slots(middle);
    if (mesh.order == 2)
      for (int k = 0; k < 9; ++k) points[k] = point[slots[k]];
    else
      for (int k = 0; k < 4; ++k) points[k] = point[slots[k % 2 * 2 + k / 2 * 6]];
    return points;
  }
  const int along = middle == 1 || middle == 7 ? 1 : 3;
  points = {point[middle - along],
            point[middle + along],
            mesh.order == 2 ? point[middle] : -1,
            -1,
            -1,
            -1,
            -1,
            -1,
            -1};
  if (node_of_point.at(points[0])->X[direction] > node_of_point.at(points[1])->X[direction])
    std::swap(points[0], points[1]);
  return points;
}

PetscErrorCode LocalFacets(const Mesh &mesh, Side side, int body, int direction, const PetscInt *number,
                           std::vector<FacetRecord> &facets)
{
  PetscInt first_cell, first, last;
  DMLabel label;
  std::vector<CellPoint> closure;
  PetscFunctionBeginUser;
  std::map<PetscInt, const Node *> node_of_point;
  for (const Node &node : mesh.nodes) node_of_point[node.point] = &node;
  PetscCall(DMGetLabel(mesh.dm, side_names[static_cast<int>(side)], &label));
  PetscCall(DMPlexGetHeightStratum(mesh.dm, 0, &first_cell, nullptr));
  PetscCall(DMPlexGetHeightStratum(mesh.dm, 1, &first, &last));
  for (PetscInt facet = first; facet < last; ++facet) {
    PetscBool inside;
    PetscInt support;
    const PetscInt *cell;
    PetscCall(DMLabelStratumHasPoint(label, 1, facet, &inside));
    PetscCall(DMPlexGetSupportSize(mesh.dm, facet, &support));
    if (!inside || support != 1) continue; // an outer facet has its one cell on one rank
    PetscCall(DMPlexGetSupport(mesh.dm, facet, &cell));
    const MeshCell &known = mesh.cells[static_cast<std::size_t>(cell[0] - first_cell)];
    if (known.body != body) continue;
    PetscCall(CellPoints(mesh.dm, mesh.dim, cell[0], closure));
    std::array<PetscInt, 27> point;
    FacetRecord record{};
    record.cell = known.natural;
    for (const CellPoint &p : closure) {
      point[p.slot] = p.point;
      if (p.point == facet) record.side = p.slot;
    }
    const auto points = facet_points(mesh, point, record.side, direction, node_of_point);
    for (int k = 0; k < 9; ++k) {
      record.key[k] = points[k] < 0           ? -1
                      : number[points[k]] < 0 ? -(number[points[k]] + 1)
                                              : number[points[k]];
      if (points[k] >= 0) std::copy_n(node_of_point.at(points[k])->X.begin(), 3, record.X[k]);
    }
    facets.push_back(record);
  }
  PetscFunctionReturn(0);
}

/// All ranks' facets: along the chain, or in the order of the cells before they were distributed.
PetscErrorCode GatherFacets(MPI_Comm comm, int dim, int direction, std::vector<FacetRecord> &facets)
{
  PetscMPIInt size, mine = static_cast<PetscMPIInt>(facets.size() * sizeof(FacetRecord));
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  std::vector<PetscMPIInt> counts(size), starts(size, 0);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm));
  for (int r = 1; r < size; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<FacetRecord> all((starts.back() + counts.back()) / sizeof(FacetRecord));
  PetscCallMPI(MPI_Allgatherv(facets.data(), mine, MPI_BYTE, all.data(), counts.data(), starts.data(),
                              MPI_BYTE, comm));
  std::sort(all.begin(), all.end(), [dim, direction](const auto &a, const auto &b) {
    if (dim == 2) return a.X[0][direction] < b.X[0][direction];
    return std::pair(a.cell, a.side) < std::pair(b.cell, b.side);
  });
  facets = std::move(all);
  PetscFunctionReturn(0);
}

/// Fills the unknowns' global numbers, which each node's owner knows, on every rank. `index` finds the
/// surface's node of a global point number.
PetscErrorCode NumberUnknowns(const Mesh &mesh, const PetscInt *number, const std::map<PetscInt, int> &index,
                              Surface &surface)
{
  ISLocalToGlobalMapping mapping;
  const PetscInt *to_global;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
  std::vector<PetscInt> numbers(7 * surface.node.size(), -1);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Node &node = mesh.nodes[n];
    const auto place = node.owned ? index.find(number[node.point]) : index.end();
    if (place == index.end()) continue;
    PetscInt *entry = &numbers[7 * place->second];
    for (int i = 0; i < 3; ++i) {
      entry[i] = std::max<PetscInt>(to_global[node.displacement + i], -1);
      if (node.traction >= 0) entry[3 + i] = to_global[node.traction + i];
    }
    entry[6] = node.traction >= 0;
    surface.node[place->second].local = static_cast<int>(n);
  }
  PetscCall(ISLocalToGlobalMappingRestoreIndices(mapping, &to_global));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<PetscMPIInt>(numbers.size()), MPIU_INT,
                             MPI_MAX, comm));
  for (std::size_t n = 0; n < surface.node.size(); ++n) {
    for (int i = 0; i < 3; ++i) {
      surface.node[n].displacement[i] = numbers[7 * n + i];
      surface.node[n].traction[i] = numbers[7 * n + 3 + i];
    }
    surface.node[n].multiplier = numbers[7 * n + 6] == 1;
  }
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode GatherSurface(const Mesh &mesh, Side side, int body, int direction, Surface &surface)
{
  IS numbering;
  const PetscInt *number;
  std::vector<FacetRecord> facets;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(DMPlexCreatePointNumbering(mesh.dm, &numbering));
  PetscCall(ISGetIndices(numbering, &number));
  PetscCall(LocalFacets(mesh, side, body, direction, number, facets));
  PetscCall(GatherFacets(comm, mesh.dim, direction, facets));

  surface = {};
  std::map<PetscInt, int> index; // global point number -> node of the surface
  const auto add = [&](const FacetRecord &record, int k) {
    const auto [place, is_new] = index.try_emplace(record.key[k], static_cast<int>(surface.node.size()));
    if (is_new) {
      SurfaceNode node{};
      std::copy_n(record.X[k], 3, node.X.begin());
      node.displacement.fill(-1);
      node.traction.fill(-1);
      node.local = -1;
      surface.node.push_back(node);
    }
    return place->second;
  };
  constexpr int chain_order[3] = {0, 2, 1}; // along the chain
  for (const FacetRecord &record : facets) {
    std::array<int, 9> facet;
    facet.fill(-1);
    for (int n = 0; n < 9; ++n) {
      const int k = mesh.dim == 2 && n < 3 ? chain_order[n] : n;
      if (record.key[k] >= 0) facet[k] = add(record, k);
    }
    PetscCheck(mesh.dim == 3 || surface.facet.empty() || surface.facet.back()[1] == facet[0], comm,
               PETSC_ERR_PLIB, "a contact surface is not one chain");
    surface.facet.push_back(facet);
  }

  PetscCall(NumberUnknowns(mesh, number, index, surface));
  PetscCall(ISRestoreIndices(numbering, &number));
  PetscCall(ISDestroy(&numbering));
  PetscFunctionReturn(0);
}

} // namespace tribogel
