#include "solve/problem.hpp"

#include "solve/two_stage_ts.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tribogel
{

PetscErrorCode Problem::SetUp(MPI_Comm comm, const Scene &given)
{
  return SetUp(comm, given, meridian_blocks(given));
}

PetscErrorCode Problem::SetUp(MPI_Comm comm, const Scene &given, SerialMesh serial)
{
  PetscFunctionBeginUser;
  scene = given;
  if (scene.misalignment.tilt != 0) tilt_top(serial, scene.misalignment.tilt);
  PetscCall(events.Register());
  PetscCall(PetscLogEventBegin(events.mesh, 0, 0, 0, 0));
  PetscCall(mesh.Build(comm, scene, serial));
  PetscCall(PetscLogEventEnd(events.mesh, 0, 0, 0, 0));
  if (scene.even_faces) face = scene.round ? ContactFace(scene.top.radius) : contact_face(mesh, mesh.slave);
  PetscCall(Bulk::Create(mesh, scene, bulk));
  if (scene.has_contact() || scene.plate_contact) {
    contact = std::make_unique<Contact>();
    PetscCall(contact->SetUp(comm, mesh, scene));
  }
  PetscCall(SetUpFields());
  PetscCall(SetUpTs());
  PetscCall(RegisterCallbacks(*this));
  PetscCall(SetFromOptions());
  PetscCall(BuildMatrix());
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::SetFromOptions()
{
  PetscBool given, agrees;
  PetscFunctionBeginUser;
  TSAdapt adapt;
  SNES snes;
  PetscCall(TSSetFromOptions(ts));
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(HookLinearSolver(snes));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptGetStepLimits(adapt, nullptr, &given_longest_step));
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<TS>(ts)));
  const char *type = scene.time.rule == TimeRule::sdirk2 ? two_stage_ts : TSBEULER;
  PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(static_cast<TS>(ts)), type, &agrees));
  PetscCheck(
      agrees, comm, PETSC_ERR_USER_INPUT,
      "-ts_type: the internal variables and the sliding velocity follow -maxwell_integrator; allowed: %s",
      type);
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-ts_max_time", &given));
  PetscCheck(!given, comm, PETSC_ERR_USER_INPUT,
             "-ts_max_time: the schedule ends the run; use -schedule_end_times");
  PetscCall(PetscOptionsGetReal(nullptr, nullptr, "-ts_dt", &given_first_step, &given));
  PetscCheck(!given || given_first_step > 0, comm, PETSC_ERR_USER_INPUT,
             "-ts_dt: the first step of a phase must be longer than 0 s");
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::SetUpFields()
{
  ISLocalToGlobalMapping mapping;
  const PetscInt *to_global;
  PetscInt first, last;
  Vec local;
  PetscScalar *values;
  PetscFunctionBeginUser;
  PetscCall(DMCreateGlobalVector(mesh.dm, state.U.put()));
  PetscCall(VecDuplicate(state.U, state.Udot.put()));
  PetscCall(VecDuplicate(state.U, state.Udot_before.put()));
  PetscCall(VecDuplicate(state.U, before.put()));
  PetscCall(VecDuplicate(state.U, stage.U.put()));
  PetscCall(VecDuplicate(state.U, magnitude.put()));
  PetscCall(VecDuplicate(state.U, round_off.put()));
  for (Vec v : {static_cast<Vec>(state.U), static_cast<Vec>(state.Udot), static_cast<Vec>(state.Udot_before),
                static_cast<Vec>(before)})
    PetscCall(VecZeroEntries(v));
  state.history = bulk->InitialHistory();
  if (contact) state.friction_history = contact->InitialHistory();

  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
  PetscCall(VecGetOwnershipRange(state.U, &first, &last));
  group.assign(last - first, 0);
  node_of_row.assign(last - first, 0);
  const auto classify = [&](PetscInt row, int kind, std::size_t node) {
    if (row < first || row >= last) return; // prescribed, or another rank's
    group[row - first] = static_cast<char>(kind);
    node_of_row[row - first] = static_cast<int>(node);
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
  if (mesh.dim == 3) PetscCall(ListContactUnknowns());
  PetscCall(MeasurePlate());

  PetscCall(DMGetLocalVector(mesh.dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &values));
  bulk->AddRoundOff(values);
  if (contact) contact->AddRoundOff(values);
  PetscCall(VecRestoreArray(local, &values));
  PetscCall(VecZeroEntries(round_off));
  PetscCall(DMLocalToGlobal(mesh.dm, local, ADD_VALUES, round_off));
  PetscCall(DMRestoreLocalVector(mesh.dm, &local));
  PetscCall(MeasureRoundOff());
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::MeasurePlate()
{
  double lowest_highest[2] = {std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
  PetscFunctionBeginUser;
  for (int n : plate_nodes) {
    const double z = mesh.nodes[n].X[mesh.dim - 1];
    lowest_highest[0] = std::min(lowest_highest[0], z);
    lowest_highest[1] = std::min(lowest_highest[1], -z);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, lowest_highest, 2, MPI_DOUBLE, MPI_MIN,
                             PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)))));
  plate_at_rest = 0.5 * (lowest_highest[0] - lowest_highest[1]); // a tilted face is symmetric about its axis
  PetscFunctionReturn(0);
}

StepWeights Problem::weights(double time) const
{
  if (steady()) return {std::numeric_limits<double>::infinity(), 1}; // the dashpots have had all the time
  const bool goes_on = scene.time.rule == TimeRule::sdirk2 && stage.index == 0;
  return {solve_length(time), goes_on ? sdirk2::reach : 1};
}

/// The second stage goes on from where the first ended if it is damped: by Euler's rule.
FrictionMemory Problem::friction_memory(double time) const
{
  if (stage.index == 0) return {state.friction_history.values, weights(time)};
  if (!stage.damped) return {stage.friction_start.values, weights(time)};
  return {stage.friction_end.values, {time - state.time - stage.length}};
}

FrictionMemory Problem::friction_now() const
{
  return {state.friction_history.values, {steady() ? std::numeric_limits<double>::infinity() : 0}};
}

PlateFrames Problem::frames(double time, double step) const
{
  const Phase &now = phase();
  PlateFrames frames;
  frames.top_travel = -now.approach(time);
  frames.top_travel_rate = steady() ? 0 : -now.approach_rate();
  frames.top_rate = now.rate;
  frames.bottom_rate = scene.bottom_plate_rate;
  frames.top_rotation = now.rotation(time);
  frames.bottom_rotation = scene.bottom_plate_rate * time;
  frames.top_axis = scene.misalignment.offset;
  if (step > 0) frames.step = step;
  // In space a node near the axis may lie on either side of it, and its velocity turns round: what holds it
  // is stick.
  if (steady() && mesh.dim == 2) frames.step = std::numeric_limits<double>::infinity();
  return frames;
}

namespace
{

/// Displacement, or its rate, of a node on the top plate that `now` moves, for a body held by the other
/// plate. In the half plane an angle is an unknown; in 3-D the plate's rotation is (Q - 1) X.
std::array<double, 3> driven_displacement(const Phase &now, double time, int dim, double L,
                                          const std::array<double, 3> &X)
{
  const double angle = now.rotation(time), c = std::cos(angle), s = std::sin(angle);
  if (dim == 2) return {0, L * angle, -now.approach(time)};
  return {c * X[0] - s * X[1] - X[0], s * X[0] + c * X[1] - X[1], -now.approach(time)};
}

std::array<double, 3> driven_rate(const Phase &now, double time, int dim, double L,
                                  const std::array<double, 3> &X)
{
  const double angle = now.rotation(time), c = std::cos(angle), s = std::sin(angle);
  if (dim == 2) return {0, L * now.rate, -now.approach_rate()};
  return {-now.rate * (s * X[0] + c * X[1]), now.rate * (c * X[0] - s * X[1]), -now.approach_rate()};
}

} // namespace

/// Unknowns are measured from the body's own plate, so that a bonded node does not move; only a gel that
/// spans both plates sees the top plate move.
void Problem::SetBoundary(double time, double *U, double *Udot) const
{
  const double L = scene.twist_length();
  for (const Node &node : mesh.nodes) {
    if (!node.prescribed) continue;
    const bool driven = node.on(Side::top_plate) && !scene.has_top();
    std::array<double, 3> u{}, rate{};
    if (driven) u = driven_displacement(phase(), time, mesh.dim, L, node.X);
    if (driven && Udot) rate = driven_rate(phase(), time, mesh.dim, L, node.X);
    for (int i = 0; i < 3; ++i) {
      if (!(node.prescribed >> i & 1u)) continue;
      U[node.displacement + i] = u[i];
      if (Udot) Udot[node.displacement + i] = rate[i];
    }
  }
}

Wrench Problem::plate_wrench(const double *U, const double *F) const
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

double Problem::plate_height() const
{
  return scene.has_top() ? plate_at_rest : plate_at_rest - phase().approach(state.time);
}

PetscErrorCode Problem::LocalState(Vec U, Vec Udot) const
{
  PetscScalar *u, *rate;
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(U));
  PetscCall(VecZeroEntries(Udot));
  PetscCall(DMGlobalToLocal(mesh.dm, state.U, INSERT_VALUES, U));
  PetscCall(DMGlobalToLocal(mesh.dm, state.Udot, INSERT_VALUES, Udot));
  PetscCall(VecGetArray(U, &u));
  PetscCall(VecGetArray(Udot, &rate));
  SetBoundary(state.time, u, rate);
  PetscCall(VecRestoreArray(Udot, &rate));
  PetscCall(VecRestoreArray(U, &u));
  if (steady()) PetscCall(VecZeroEntries(Udot)); // state.Udot is how the load is raised, not a motion
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::AddResidual(double time, const double *U, const double *Udot, double *F,
                                    double *sizes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.bulk_residual, 0, 0, 0, 0));
  bulk_failure = bulk->AddResidual(U, start(), weights(time), F, sizes);
  PetscCall(PetscLogEventEnd(events.bulk_residual, 0, 0, 0, 0));
  Wrench reaction = plate_wrench(U, F);
  if (contact) reaction += contact->WallReaction(U);
  plate_loads = {-reaction.force[2], reaction.moment[2]};
  PetscCall(
      ShareFailure(PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm))), bulk_failure));
  contact_failure.clear();
  if (steady()) Udot = nullptr;
  PetscCall(PetscLogEventBegin(events.contact_residual, 0, 0, 0, 0));
  if (contact)
    PetscCall(contact->AddResidual(frames(time, solve_length(time)), friction_memory(time), U, Udot, F, sizes,
                                   contact_failure));
  PetscCall(PetscLogEventEnd(events.contact_residual, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

PetscErrorCode Problem::AddJacobian(double time, const double *U, const double *Udot, double shift, Mat A)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogEventBegin(events.bulk_jacobian, 0, 0, 0, 0));
  PetscCall(bulk->AddJacobian(U, start(), weights(time), A, bulk_failure));
  PetscCall(PetscLogEventEnd(events.bulk_jacobian, 0, 0, 0, 0));
  PetscCall(PetscLogEventBegin(events.contact_jacobian, 0, 0, 0, 0));
  if (steady()) {
    Udot = nullptr;
    shift = 0;
  }
  if (contact)
    PetscCall(contact->AddJacobian(frames(time, solve_length(time)), friction_memory(time), U, Udot, shift, A,
                                   contact_failure));
  PetscCall(PetscLogEventEnd(events.contact_jacobian, 0, 0, 0, 0));
  PetscFunctionReturn(0);
}

/// The matrix has the pattern of the bulk and of all pairs of facets that may meet soon. PETSc 3.18 inserts a
/// new nonzero by reallocating, so the pattern is complete before the first value. An old matrix, and what
/// the linear solver made of it, go first: two would not fit where one does.
PetscErrorCode Problem::BuildMatrix()
{
  Mat counter, A;
  SNES snes;
  KSP ksp;
  PetscInt local;
  ISLocalToGlobalMapping mapping;
  PetscFunctionBeginUser;
  contraction = std::numeric_limits<double>::infinity(); // there is no old matrix
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm)));
  PetscCall(VecGetLocalSize(state.U, &local));
  PetscCall(DMGetLocalToGlobalMapping(mesh.dm, &mapping));
  PetscCall(MatCreate(comm, &counter));
  PetscCall(MatCreate(comm, &A));
  for (Mat m : {counter, A}) PetscCall(MatSetSizes(m, local, local, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(counter, MATPREALLOCATOR));
  PetscCall(MatSetType(A, MATAIJ));
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPReset(ksp));
#ifdef __GLIBC__
  // Open MPI tells malloc to keep what is freed, and the old factors would lie beside the new: 2.09 GB
  // for 1.43.
  malloc_trim(0);
#endif
  *jacobian.put() = A;
  PetscCall(TSSetIJacobian(ts, A, A, nullptr, nullptr)); // null: the DM's callback stays
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

PetscErrorCode Problem::ProbeSolver()
{
  SNES snes;
  KSP ksp;
  Vec zero, x, U, Udot;
  PetscBool chooses_tolerance;
  const PetscScalar *u, *rate;
  PetscFunctionBeginUser;
  PetscCall(TSGetSNES(ts, &snes));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(DMGetLocalVector(mesh.dm, &U));
  PetscCall(DMGetLocalVector(mesh.dm, &Udot));
  PetscCall(LocalState(U, Udot));
  PetscCall(VecGetArrayRead(U, &u));
  PetscCall(VecGetArrayRead(Udot, &rate));
  PetscCall(MatZeroEntries(jacobian));
  PetscCall(AddJacobian(state.time, u, rate, 1 / phase().duration(), jacobian));
  PetscCall(MatAssemblyBegin(jacobian, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(jacobian, MAT_FINAL_ASSEMBLY));
  PetscCall(VecRestoreArrayRead(Udot, &rate));
  PetscCall(VecRestoreArrayRead(U, &u));
  PetscCall(DMRestoreLocalVector(mesh.dm, &Udot));
  PetscCall(DMRestoreLocalVector(mesh.dm, &U));
  PetscCall(VecDuplicate(state.U, &zero));
  PetscCall(VecDuplicate(state.U, &x));
  PetscCall(VecZeroEntries(zero));
  PetscCall(KSPSetOperators(ksp, jacobian, jacobian));
  PetscCall(SNESKSPGetUseEW(snes, &chooses_tolerance));
  PetscCall(SNESKSPSetUseEW(snes, PETSC_FALSE)); // asks for the residual of a solve that there is not
  PetscCall(KSPSolve(ksp, zero, x));
  PetscCall(SNESKSPSetUseEW(snes, chooses_tolerance));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&zero));
  PetscFunctionReturn(0);
}

} // namespace tribogel
