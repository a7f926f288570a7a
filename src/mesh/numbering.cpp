/// Which places of the mesh carry unknowns, and which of those are prescribed.
#include "mesh/mesh.hpp"

namespace tribogel
{

namespace
{

/// The table of prescribed displacement components, bit i for component i. In the half plane: u_R, u_theta,
/// u_Z; a lubricated plate lets the gel slide radially, but turns it. In 3-D: u_x, u_y, u_z; a lubricated
/// plate only bears.
unsigned prescribed_components(int dim, const Node &node, PlateBond bond)
{
  constexpr unsigned first = 1, second = 2, third = 4, all = 7;
  unsigned prescribed = 0;
  if (node.on(Side::top_plate) || node.on(Side::bottom_plate))
    prescribed |= bond == PlateBond::glued ? all : dim == 2 ? second | third : third;
  if (node.on(Side::axis) || node.on(Side::fixed_x)) prescribed |= first;
  if (node.on(Side::fixed_y)) prescribed |= second;
  return prescribed;
}

} // namespace

PetscErrorCode Mesh::Constrain(PetscSection section, const Node &node, bool indices)
{
  std::vector<PetscInt> fixed;
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; ++i)
    if (node.prescribed >> i & 1u) fixed.push_back(i);
  const auto count = static_cast<PetscInt>(fixed.size());
  if (count && indices) {
    PetscCall(PetscSectionSetFieldConstraintIndices(section, node.point, 0, fixed.data()));
    PetscCall(PetscSectionSetConstraintIndices(section, node.point, fixed.data()));
  } else if (count) {
    PetscCall(PetscSectionSetFieldConstraintDof(section, node.point, 0, count));
    PetscCall(PetscSectionSetConstraintDof(section, node.point, count));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode Mesh::ListNodes(const Scene &scene)
{
  PetscInt start, end;
  DMLabel labels[side_count];
  PetscFunctionBeginUser;
  nodes.clear();
  PetscCall(DMPlexGetChart(dm, &start, &end));
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
    node.prescribed = prescribed_components(dim, node, scene.plate_bond);
    // A vertex on the axis has no dual weight at order 2 (THEORY 3.1); a prescribed node's pressure belongs
    // to the glue.
    const bool weightless = order == 2 && node.on(Side::axis);
    const bool bonded = node.on(Side::top_plate) || node.on(Side::bottom_plate);
    const bool free_wall = scene.plate_contact && node.on(Side::wall) && !node.on(Side::master);
    const bool multiplier = ((node.on(Side::slave) && !weightless) || free_wall) && !bonded;
    node.traction = multiplier ? 0 : -1;
    nodes.push_back(node);
  }
  nodes.shrink_to_fit();
  PetscFunctionReturn(0);
}

PetscErrorCode Mesh::Number()
{
  PetscSection section;
  PetscInt start, end;
  PetscFunctionBeginUser;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(dm)));
  PetscCall(DMPlexGetChart(dm, &start, &end));
  PetscCall(PetscSectionCreate(comm, &section));
  PetscCall(PetscSectionSetNumFields(section, 2));
  PetscCall(PetscSectionSetFieldName(section, 0, "displacement"));
  PetscCall(PetscSectionSetFieldName(section, 1, "traction"));
  for (int field = 0; field < 2; ++field) PetscCall(PetscSectionSetFieldComponents(section, field, 3));
  PetscCall(PetscSectionSetChart(section, start, end));
  for (const Node &node : nodes) {
    PetscCall(PetscSectionSetFieldDof(section, node.point, 0, 3));
    if (node.traction >= 0) PetscCall(PetscSectionSetFieldDof(section, node.point, 1, 3));
    PetscCall(PetscSectionSetDof(section, node.point, node.traction >= 0 ? 6 : 3));
    PetscCall(Constrain(section, node, false));
  }
  PetscCall(PetscSectionSetUp(section));
  for (Node &node : nodes) {
    PetscCall(Constrain(section, node, true));
    PetscCall(PetscSectionGetFieldOffset(section, node.point, 0, &node.displacement));
    if (node.traction >= 0) PetscCall(PetscSectionGetFieldOffset(section, node.point, 1, &node.traction));
  }
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscSection global;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscInt owned;
  PetscCall(PetscSectionGetConstrainedStorageSize(global, &owned));
  PetscCallMPI(MPI_Allreduce(&owned, &unknowns, 1, MPIU_INT, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/// Elements of order 1 have no nodes on edges and facets, and once the surfaces are known nobody asks for
/// these: three quarters of a mesh of hexahedra. Cells and vertices keep their numbers, and so do the
/// unknowns.
PetscErrorCode Mesh::DropMiddles()
{
  DmHandle corners;
  PetscFunctionBeginUser;
  PetscCall(DMPlexUninterpolate(dm, corners.put()));
  dm = std::move(corners);
  PetscCall(Number());
  PetscFunctionReturn(0);
}

} // namespace tribogel
