/// Both bodies as one distributed DMPlex with the fields `displacement` and `traction`, and the tables that
/// the callbacks loop over.
#pragma once

#include "mesh/blocks.hpp"
#include "support/petsc_handles.hpp"
#include "tribogel/scene/scene.hpp"

#include <array>
#include <string>
#include <vector>

namespace tribogel
{

/// A place on this rank that carries displacement unknowns.
struct Node {
  PetscInt point;          ///< in the DMPlex
  PetscInt natural;        ///< number of that point before the mesh was distributed
  std::array<double, 3> X; ///< reference (R, Z, 0) or (x, y, z) [mm]
  PetscInt displacement;   ///< offset of its three displacements in a local vector
  PetscInt traction = -1;  ///< offset of its three multiplier components, -1 without
  int body;                ///< bottom_body or top_body
  unsigned sides = 0;      ///< bit k: lies on Side k
  unsigned prescribed = 0; ///< bit i: displacement i is no unknown
  bool owned;              ///< by this rank

  bool on(Side side) const { return sides >> static_cast<int>(side) & 1u; }
};

struct MeshCell {
  int body;
  PetscInt natural;         ///< number of the cell before the mesh was distributed
  std::array<int, 27> node; ///< indices into Mesh::nodes, lexicographic; Mesh::nodes_per_cell of them
};

/// A node of a surface, the same on every rank. Global indices are those of the solution vector, negative
/// where a component is prescribed or absent.
struct SurfaceNode {
  std::array<double, 3> X;                        ///< reference (R, Z, 0) or (x, y, z) [mm]
  std::array<PetscInt, 3> displacement, traction; ///< global indices
  bool multiplier;
  int local; ///< index into Mesh::nodes on the rank that owns the node, -1 elsewhere
};

/// A part of the bodies' boundary. In the half plane it is a chain, and a facet is its ends, then the midside
/// node (order 2). In 3-D the 4 or 9 nodes of a facet are lexicographic (xi runs fastest), such that dx/dxi x
/// dx/deta points out of the body. Unused entries are -1.
struct Surface {
  std::vector<SurfaceNode> node;
  std::vector<std::array<int, 9>> facet;
};

class Mesh
{
public:
  /// Distribute and number the mesh. All nodes, midside ones too, lie on the bodies' shapes. Collective; the
  /// mesh counts on the first rank.
  PetscErrorCode Build(MPI_Comm comm, const Scene &scene, const SerialMesh &serial);

  DmHandle dm; ///< at order 1 in the end of cells and vertices alone
  int dim = 2;
  int order = 2;
  std::vector<Node> nodes;
  std::vector<MeshCell> cells; ///< those of this rank; each cell is on one rank
  Surface slave, master; ///< contact faces of the top gel and of what it is pressed on, a chain's from the
                         ///< axis outwards; empty without contact
  Surface wall[2];       ///< each body's side wall, a chain's upwards; empty unless the walls may touch
  PetscInt unknowns = 0; ///< in all

  int nodes_per_cell() const
  {
    return dim == 2 ? (order + 1) * (order + 1) : (order + 1) * (order + 1) * (order + 1);
  }

private:
  std::vector<PetscInt> natural; ///< number of each point of this rank before the mesh was distributed

  PetscErrorCode Create(MPI_Comm comm, const SerialMesh &serial);
  PetscErrorCode Distribute(const SerialMesh &serial);
  PetscErrorCode ListNodes(const Scene &scene);
  PetscErrorCode Number();
  PetscErrorCode DropMiddles();
  PetscErrorCode Tabulate();
  PetscErrorCode Place();
  PetscErrorCode Shape(const SerialMesh &serial);
  PetscErrorCode PlaceMiddles(const SerialMesh &serial);
  PetscErrorCode Constrain(PetscSection section, const Node &node, bool indices);
};

/// A reference position in words, for messages.
std::string describe_place(int dim, const std::array<double, 3> &X);

/// Slots of a cell's points in the lexicographic order of order 2, from those of its corners: the place of an
/// edge, a face or the cell is the mean of its corners' (table.cpp).
struct CellPoint {
  PetscInt point, depth;
  int slot; ///< 0 to 8 or 26
};
PetscErrorCode CellPoints(DM dm, int dim, PetscInt cell, std::vector<CellPoint> &points);

/// The plane z = 0 as a master: one facet, without unknowns, that reaches far beyond what is pressed on it.
Surface rigid_plane(int dim, int order, const Surface &pressed);

/// Facets of `body` with label `side`, gathered on every rank, in an order that does not depend on the number
/// of ranks. A chain runs towards increasing R (direction 0) or Z (direction 1). Collective.
PetscErrorCode GatherSurface(const Mesh &mesh, Side side, int body, int direction, Surface &surface);

} // namespace tribogel
