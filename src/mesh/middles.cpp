/// Middles of curved edges, faces and cells, which the first rank knows and every rank has some of.
#include "mesh/mesh.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

using Key = std::array<int, 8>;

/// What the first rank knows to all. Collective.
PetscErrorCode Share(MPI_Comm comm, const SerialMesh &serial, std::map<Key, std::array<double, 3>> &middle)
{
  PetscMPIInt rank;
  int size = static_cast<int>(serial.middle.size());
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Bcast(&size, 1, MPI_INT, 0, comm));
  std::vector<Key> keys(size);
  std::vector<std::array<double, 3>> places(size);
  if (rank == 0) {
    std::size_t k = 0;
    for (const auto &[key, X] : serial.middle) {
      keys[k] = key;
      places[k++] = X;
    }
  }
  PetscCallMPI(MPI_Bcast(keys.data(), 8 * size, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(places.data(), 3 * size, MPI_DOUBLE, 0, comm));
  for (int k = 0; k < size; ++k) middle.emplace_hint(middle.end(), keys[k], places[k]);
  PetscFunctionReturn(0);
}

} // namespace

/// Before the mesh was distributed the vertices were numbered after the cells, in the order of the serial
/// mesh.
PetscErrorCode Mesh::PlaceMiddles(const SerialMesh &serial)
{
  int first = static_cast<int>(serial.cell.size());
  std::map<Key, std::array<double, 3>> middle;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(dm)));
  PetscCall(Share(comm, serial, middle));
  if (middle.empty()) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Bcast(&first, 1, MPI_INT, 0, comm));
  for (Node &node : nodes) {
    PetscInt size, *closure = nullptr;
    Key key;
    int count = 0;
    key.fill(-1);
    PetscCall(DMPlexGetTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    for (PetscInt k = 0; k < size; ++k) {
      PetscInt depth;
      PetscCall(DMPlexGetPointDepth(dm, closure[2 * k], &depth));
      if (depth == 0) key[count++] = static_cast<int>(natural[closure[2 * k]]) - first;
    }
    PetscCall(DMPlexRestoreTransitiveClosure(dm, node.point, PETSC_TRUE, &size, &closure));
    std::sort(key.begin(), key.end(), std::greater<>());
    if (const auto found = middle.find(key); found != middle.end()) node.X = found->second;
  }
  PetscFunctionReturn(0);
}

} // namespace tribogel
