#include "mesh/mesh.hpp"

#include <algorithm>
#include <map>

namespace tribogel
{

namespace
{

/// One facet as it travels between ranks: global numbers of its ends and midside point, and their positions.
struct FacetRecord {
  PetscInt key[3];
  double X[3][2];
};

PetscErrorCode LocalFacets(const Mesh &mesh, Side side, int body, int direction, const PetscInt *number,
                           std::vector<FacetRecord> &facets)
{
  PetscInt first, last;
  DMLabel label;
  PetscFunctionBeginUser;
  std::map<PetscInt, const Node *> node_of_point;
  for (const Node &node : mesh.nodes) node_of_point[node.point] = &node;
  PetscCall(DMGetLabel(mesh.dm, side_names[static_cast<int>(side)], &label));
  PetscCall(DMPlexGetDepthStratum(mesh.dm, 1, &first, &last));
  for (PetscInt edge = first; edge < last; ++edge) {
    PetscBool inside;
    PetscInt support;
    const PetscInt *ends;
    PetscCall(DMLabelStratumHasPoint(label, 1, edge, &inside));
    PetscCall(DMPlexGetSupportSize(mesh.dm, edge, &support));
    if (!inside || support != 1) continue; // an outer edge has its one cell on one rank
    PetscCall(DMPlexGetCone(mesh.dm, edge, &ends));
    if (node_of_point[ends[0]]->body != body) continue;
    PetscInt points[3] = {ends[0], ends[1], edge};
    if (node_of_point[ends[0]]->X[direction] > node_of_point[ends[1]]->X[direction]) std::swap(points[0], points[1]);
    FacetRecord record{};
    for (int k = 0; k < 3; ++k) {
      const PetscInt n = number[points[k]];
      record.key[k] = k == 2 && mesh.order == 1 ? -1 : (n < 0 ? -(n + 1) : n);
      if (record.key[k] < 0) continue;
      record.X[k][0] = node_of_point[points[k]]->X[0];
      record.X[k][1] = node_of_point[points[k]]->X[1];
    }
    facets.push_back(record);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode GatherFacets(MPI_Comm comm, int direction, std::vector<FacetRecord> &facets)
{
  PetscMPIInt size, mine = static_cast<PetscMPIInt>(facets.size() * sizeof(FacetRecord));
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  std::vector<PetscMPIInt> counts(size), starts(size, 0);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm));
  for (int r = 1; r < size; ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<FacetRecord> all((starts.back() + counts.back()) / sizeof(FacetRecord));
  PetscCallMPI(MPI_Allgatherv(facets.data(), mine, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm));
  std::sort(all.begin(), all.end(),
            [direction](const auto &a, const auto &b) { return a.X[0][direction] < b.X[0][direction]; });
  facets = std::move(all);
  PetscFunctionReturn(0);
}

/// Fills the unknowns' global numbers, which each node's owner knows, on every rank. `index` finds the chain's node of
/// a global point number.
PetscErrorCode NumberUnknowns(const Mesh &mesh, const PetscInt *number, const std::map<PetscInt, int> &index,
                              SurfaceChain &chain)
{
  ISLocalToGlobalMapping mapping;
  const PetscInt *to_global;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
  std::vector<PetscInt> numbers(7 * chain.node.size(), -1);
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
    chain.node[place->second].local = static_cast<int>(n);
  }
  PetscCall(ISLocalToGlobalMappingRestoreIndices(mapping, &to_global));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<PetscMPIInt>(numbers.size()), MPIU_INT, MPI_MAX, comm));
  for (std::size_t n = 0; n < chain.node.size(); ++n) {
    for (int i = 0; i < 3; ++i) {
      chain.node[n].displacement[i] = numbers[7 * n + i];
      chain.node[n].traction[i] = numbers[7 * n + 3 + i];
    }
    chain.node[n].multiplier = numbers[7 * n + 6] == 1;
  }
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode GatherSurface(const Mesh &mesh, Side side, int body, int direction, SurfaceChain &chain)
{
  IS numbering;
  const PetscInt *number;
  std::vector<FacetRecord> facets;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(DMPlexCreatePointNumbering(mesh.dm, &numbering));
  PetscCall(ISGetIndices(numbering, &number));
  PetscCall(LocalFacets(mesh, side, body, direction, number, facets));
  PetscCall(GatherFacets(comm, direction, facets));

  chain = {};
  std::map<PetscInt, int> index; // global point number -> node of the chain
  const auto add = [&](const FacetRecord &record, int k) {
    const auto [place, is_new] = index.try_emplace(record.key[k], static_cast<int>(chain.node.size()));
    if (is_new) {
      SurfaceNode node{};
      node.X = {record.X[k][0], record.X[k][1]};
      node.displacement.fill(-1);
      node.traction.fill(-1);
      node.local = -1;
      chain.node.push_back(node);
    }
    return place->second;
  };
  for (const FacetRecord &record : facets) {
    std::array<int, 3> facet{-1, -1, -1};
    facet[0] = add(record, 0);
    if (mesh.order == 2) facet[2] = add(record, 2);
    facet[1] = add(record, 1);
    PetscCheck(chain.facet.empty() || chain.facet.back()[1] == facet[0], comm, PETSC_ERR_PLIB,
               "a contact surface is not one chain");
    chain.facet.push_back(facet);
  }

  PetscCall(NumberUnknowns(mesh, number, index, chain));
  PetscCall(ISRestoreIndices(numbering, &number));
  PetscCall(ISDestroy(&numbering));
  PetscFunctionReturn(0);
}

} // namespace tribogel
