#include "system/system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tribogel
{

PetscErrorCode System::SetUp(MPI_Comm on, const Scene &given, SerialMesh serial)
{
  PetscFunctionBeginUser;
  scene = given;
  if (scene.misalignment.tilt != 0) tilt_top(serial, scene.misalignment.tilt);
  PetscCall(events.Register());
  PetscCall(PetscLogEventBegin(events.mesh, 0, 0, 0, 0));
  PetscCall(mesh.Build(on, scene, serial));
  PetscCall(PetscLogEventEnd(events.mesh, 0, 0, 0, 0));
  if (scene.even_faces) face = scene.round ? ContactFace(scene.top.radius) : contact_face(mesh, mesh.slave);
  PetscCall(Bulk::Create(mesh, scene, bulk));
  if (scene.has_contact() || scene.plate_contact) {
    contact = std::make_unique<Contact>();
    PetscCall(contact->SetUp(on, mesh, scene));
  }
  PetscCall(ListRows());
  if (mesh.dim == 3) PetscCall(ListContactUnknowns());
  PetscCall(MeasurePlate());
  PetscCall(MeasureRoundOff());
  PetscFunctionReturn(0);
}

PetscErrorCode System::ListRows()
{
  ISLocalToGlobalMapping mapping;
  const PetscInt *to_global;
  PetscInt first, last;
  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(mesh.dm, rows.magnitude.put()));
  PetscCall(VecDuplicate(rows.magnitude, rows.round_off.put()));
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
  PetscCall(VecGetOwnershipRange(rows.magnitude, &first, &last));
  rows.group.assign(last - first, 0);
  rows.node.assign(last - first, 0);
  const auto classify = [&](PetscInt row, int kind, std::size_t node) {
    if (row < first || row >= last) return; // prescribed, or another rank's
    rows.group[row - first] = static_cast<char>(kind);
    rows.node[row - first] = static_cast<int>(node);
  };
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Node &node = mesh.nodes[n];
    if (node.on(Side::top_plate)) plate_nodes.push_back(static_cast<int>(n));
    for (int i = 0; i < 3; ++i) {
      classify(to_global[node.displacement + i], i, n);
      if (node.traction >= 0) classify(to_global[node.traction + i], 3 + i, n);
    }
  }
  PetscCall(ISLocalToGlobalMappingRestoreIndices(mapping, &to_global));
  PetscFunctionReturn(0);
}

PetscErrorCode System::MeasurePlate()
{
  double lowest_highest[2] = {std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
  PetscFunctionBeginUser;
  for (int n : plate_nodes) {
    const double z = mesh.nodes[n].X[mesh.dim - 1];
    lowest_highest[0] = std::min(lowest_highest[0], z);
    lowest_highest[1] = std::min(lowest_highest[1], -z);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, lowest_highest, 2, MPI_DOUBLE, MPI_MIN, comm()));
  plate_at_rest = 0.5 * (lowest_highest[0] - lowest_highest[1]); // a tilted face is symmetric about its axis
  PetscFunctionReturn(0);
}

namespace
{

/// Displacement, or its rate, of a node on the top plate that moves, for a body held by the other
/// plate. In the half plane an angle is an unknown; in 3-D the plate's rotation is (Q - 1) X.
std::array<double, 3> driven_displacement(const PlateMotion &plates, int dim, double L,
                                          const std::array<double, 3> &X)
{
  const double angle = plates.top_rotation, c = std::cos(angle), s = std::sin(angle);
  if (dim == 2) return {0, L * angle, plates.top_travel};
  return {c * X[0] - s * X[1] - X[0], s * X[0] + c * X[1] - X[1], plates.top_travel};
}

std::array<double, 3> driven_rate(const PlateMotion &plates, int dim, double L,
                                  const std::array<double, 3> &X)
{
  const double angle = plates.top_rotation, c = std::cos(angle), s = std::sin(angle);
  if (dim == 2) return {0, L * plates.top_rate, plates.top_travel_rate};
  return {-plates.top_rate * (s * X[0] + c * X[1]), plates.top_rate * (c * X[0] - s * X[1]),
          plates.top_travel_rate};
}

} // namespace

/// Unknowns are measured from the body's own plate, so that a bonded node does not move; only a gel that
/// spans both plates sees the top plate move. With contact the plates' motion is in the frames in which the
/// contact is evaluated (contact/node/state.hpp).
void System::SetBoundary(const PlateMotion &plates, double *U, double *Udot) const
{
  const double L = scene.twist_length();
  for (const Node &node : mesh.nodes) {
    if (!node.prescribed) continue;
    const bool driven = node.on(Side::top_plate) && !scene.has_top();
    std::array<double, 3> u{}, rate{};
    if (driven) u = driven_displacement(plates, mesh.dim, L, node.X);
    if (driven && Udot) rate = driven_rate(plates, mesh.dim, L, node.X);
    for (int i = 0; i < 3; ++i) {
      if (!(node.prescribed >> i & 1u)) continue;
      U[node.displacement + i] = u[i];
      if (Udot) Udot[node.displacement + i] = rate[i];
    }
  }
}

Wrench System::plate_wrench(const double *U, const double *F) const
{
  Wrench wrench;
  for (int n : plate_nodes) {
    const Node &node = mesh.nodes[n];
    const Vector3<double> f(F + node.displacement);
    if (mesh.dim == 2) {
      wrench.force[2] += f[2];
      wrench.moment[2] += f[1] * scene.twist_length();
    } else
      wrench.add(f, Vector3<double>(node.X.data()) + Vector3<double>(U + node.displacement));
  }
  return wrench;
}

double System::plate_height(const PlateMotion &plates) const
{
  return scene.has_top() ? plate_at_rest : plate_at_rest + plates.top_travel;
}

PetscErrorCode System::AddResidual(const EulerSolve &solve, const double *U, const double *Udot, double *F,
                                   double *sizes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.bulk_residual, 0, 0, 0, 0));
  failure.bulk = bulk->AddResidual(U, solve.start, solve.weights, F, sizes);
  PetscCall(PetscLogEventEnd(events.bulk_residual, 0, 0, 0, 0));
  Wrench reaction = plate_wrench(U, F);
  if (contact) reaction += contact->WallReaction(U);
  plate_loads = {-reaction.force[2], reaction.moment[2]};
  PetscCall(ShareFailure(comm(), failure.bulk));
  failure.contact.clear();
  if (steady()) Udot = nullptr;
  PetscCall(PetscLogEventBegin(events.contact_residual, 0, 0, 0, 0));
  if (contact)
    PetscCall(contact->AddResidual(solve.plates, solve.friction, U, Udot, F, sizes, failure.contact));
  PetscCall(PetscLogEventEnd(events.contact_residual, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

PetscErrorCode System::AddJacobian(const EulerSolve &solve, const double *U, const double *Udot, double shift,
                                   Mat A)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.bulk_jacobian, 0, 0, 0, 0));
  PetscCall(bulk->AddJacobian(U, solve.start, solve.weights, A, failure.bulk));
  PetscCall(PetscLogEventEnd(events.bulk_jacobian, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(events.contact_jacobian, 0, 0, 0, 0));
  if (steady()) {
    Udot = nullptr;
    shift = 0;
  }
  if (contact)
    PetscCall(contact->AddJacobian(solve.plates, solve.friction, U, Udot, shift, A, failure.contact));
  PetscCall(PetscLogEventEnd(events.contact_jacobian, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

/// Of all ranks' cells, in the last evaluation of the residual.
PetscErrorCode System::SumPlateLoads(PlateLoads &loads) const
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(plate_loads.data(), loads.data(), 2, MPI_DOUBLE, MPI_SUM, comm()));
  PetscFunctionReturn(0);
}

double System::expected_compression() const
{
  double approach = 0;
  for (const Phase &each : scene.schedule) approach = std::max(approach, std::abs(each.end_approach));
  return std::max(0.0, approach - scene.gap()) / scene.gel_height();
}

/// Never less than what a free bar of the softer gel would bear at the schedule's largest compression: less
/// than bonded gels bear, of the same order, and known before anything touches. What is only round-off beside
/// the other (the torque before any rotation) is not tracked.
PlateLoads System::load_scales(const PlateLoads &largest) const
{
  constexpr double negligible = 1e-8;
  const double radius = scene.upper_gel().radius, L = scene.twist_length();
  const double bar = 3 * scene.softer_modulus() * std::numbers::pi * radius * radius * expected_compression();
  return {std::max({largest[0], bar, negligible * largest[1] / L}),
          std::max(largest[1], negligible * largest[0] * L)};
}

PetscErrorCode System::AddMotionSlopes(const EulerSolve &solve, const double *U, const double *Udot,
                                       double shift, double *by_travel, double *by_turn)
{
  PetscFunctionBeginUser;
  if (steady()) {
    Udot = nullptr;
    shift = 0;
  }
  if (contact)
    PetscCall(contact->AddMotionSlopes(solve.plates, solve.friction, U, Udot, shift, by_travel, by_turn,
                                       failure.contact));
  PetscFunctionReturn(0);
}

/// PETSc 3.18 inserts a new nonzero by reallocating, so the pattern is complete before the first value.
PetscErrorCode System::SetUpMatrix(Mat A)
{
  Mat counter;
  PetscInt local;
  ISLocalToGlobalMapping mapping;
  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(rows.magnitude, &local));
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(MatCreate(comm(), &counter));
  for (Mat m : {counter, A}) PetscCall(MatSetSizes(m, local, local, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(counter, MATPREALLOCATOR));
  PetscCall(MatSetType(A, MATAIJ));
  PetscCall(MatSetUp(counter));
  for (Mat m : {counter, A}) PetscCall(MatSetLocalToGlobalMapping(m, mapping, mapping));
  PetscCall(bulk->AddPattern(counter));
  if (contact) PetscCall(contact->AddPattern(counter));
  PetscCall(MatAssemblyBegin(counter, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(counter, MAT_FINAL_ASSEMBLY));
  PetscCall(MatPreallocatorPreallocate(counter, PETSC_TRUE, A));
  PetscCall(MatDestroy(&counter));
  PetscCall(MatSetOption(A, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  PetscCall(bulk->LocateEntries(A));
  if (contact_unknowns) PetscCall(AttachContactUnknowns(A, contact_unknowns));
  PetscFunctionReturn(0);
}

} // namespace tribogel
