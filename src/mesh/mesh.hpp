/// Both bodies as one distributed DMPlex with the fields `displacement` and `traction`, and the tables that the
/// callbacks loop over.
#pragma once

#include "mesh/meridian.hpp"
#include "support/petsc_handles.hpp"

#include <array>
#include <vector>

namespace tribogel
{

/// A place on this rank that carries displacement unknowns.
struct Node {
  PetscInt point;          ///< in the DMPlex
  PetscInt natural;        ///< number of that point before the mesh was distributed
  std::array<double, 2> X; ///< reference (R, Z) [mm]
  PetscInt displacement;   ///< offset of its three displacements in a local vector
  PetscInt traction = -1;  ///< offset of its three multiplier components, -1 without
  int body;                ///< bottom_body or top_body
  unsigned sides = 0;      ///< bit k: lies on Side k
  bool owned;              ///< by this rank

  bool on(Side side) const { return sides >> static_cast<int>(side) & 1u; }
};

struct MeshCell {
  int body;
  PetscInt natural;        ///< number of the cell before the mesh was distributed
  std::array<int, 9> node; ///< indices into Mesh::nodes, lexicographic; order 1 uses the first four
};

/// A node of a contact surface, the same on every rank. Global indices are those of the solution vector, negative where
/// a component is prescribed or absent.
struct SurfaceNode {
  std::array<double, 2> X;                        ///< reference (R, Z) [mm]
  std::array<PetscInt, 3> displacement, traction; ///< global indices
  bool multiplier;
  int local; ///< index into Mesh::nodes on the rank that owns the node, -1 elsewhere
};

/// A contact surface as a chain of facets.
struct SurfaceChain {
  std::vector<SurfaceNode> node;
  std::vector<std::array<int, 3>> facet; ///< ends, then the midside node (order 2), -1 else
};

class Mesh
{
public:
  /// Build, distribute and number the mesh of `blocks`, one a body. All nodes, midside ones too, lie on the blocks'
  /// shapes. Collective.
  PetscErrorCode Build(MPI_Comm comm, const Scene &scene, const std::vector<MeridianBlock> &blocks);

  DmHandle dm;
  int order = 2;
  std::vector<Node> nodes;
  std::vector<MeshCell> cells; ///< those of this rank; each cell is on one rank
  SurfaceChain slave, master;  ///< the gels' contact faces, from the axis outwards; empty without contact
  SurfaceChain wall[2];        ///< each body's side wall, upwards; empty unless the walls may touch
  PetscInt unknowns = 0;       ///< in all

  int nodes_per_cell() const { return (order + 1) * (order + 1); }

private:
  std::vector<PetscInt> natural; ///< number of each point of this rank before the mesh was distributed

  PetscErrorCode Create(MPI_Comm comm, const std::vector<MeridianBlock> &blocks);
  PetscErrorCode Distribute(const std::vector<MeridianBlock> &blocks);
  PetscErrorCode Number(const Scene &scene);
  PetscErrorCode Tabulate();
  PetscErrorCode Shape(const std::vector<MeridianBlock> &blocks);
  PetscErrorCode Constrain(PetscSection section, PetscInt point, unsigned sides, PlateBond bond, bool indices);
};

/// Chain of the facets of `body` with label `side`, gathered on every rank. It runs towards increasing R (direction 0)
/// or Z (direction 1). Collective.
PetscErrorCode GatherSurface(const Mesh &mesh, Side side, int body, int direction, SurfaceChain &chain);

} // namespace tribogel
