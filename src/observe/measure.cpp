#include "observe/measure.hpp"

#include "support/petsc_arrays.hpp"
#include "tribogel/contact/curve/axis_value.hpp"
#include "tribogel/friction/torque.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

/// What the top plate does to its gel through the bonded face; all ranks'.
PetscErrorCode PlateReaction(const Problem &problem, const double *U, Wrench &reaction)
{
  LocalVector forces;
  MutableArray f;
  PetscFunctionBeginUser;
  PetscCall(forces.GetZero(problem.system.mesh.dm));
  PetscCall(f.Get(forces));
  const StepWeights frozen{0}; // the internal variables are those at the end of the step
  const BulkFailure failure =
      problem.system.bulk->AddTopPlateForces(U, problem.stepper.state.history, frozen, f);
  PetscCheck(!failure, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a converged state cannot be evaluated");
  reaction = problem.system.plate_wrench(U, f);
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(problem.system.mesh.dm)));
  for (Vector3<double> *part : {&reaction.force, &reaction.moment})
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, part->data(), 3, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/// The plate's reactions, and in the fixed frame what pushes it sideways and bends its axis.
void read_off(const Problem &problem, const Wrench &reaction, Measurement &m)
{
  m.normal_force = -reaction.force[2];
  m.torque = reaction.moment[2];
  const Vector3<double> centre(0, 0, problem.system.plate_height(problem.stepper.plates_now()));
  const Vector3<double> force = -reaction.force, moment = -(reaction.moment - centre.cross(reaction.force));
  // The frame of a gel that spans both plates does not turn.
  const double angle = problem.system.scene.has_top() ? problem.stepper.plates_now().top_rotation : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  m.transverse_force = {c * force[0] - s * force[1], s * force[0] + c * force[1]};
  m.bending_moment = {c * moment[0] - s * moment[1], s * moment[0] + c * moment[1]};
}

double tangential(const NodeResult &node)
{
  return (node.cauchy + node.pressure * node.normal).norm();
}

/// Friction coefficients over the nodes that touch.
void average(const Problem &problem, const std::vector<SurfaceResults> &surfaces, Measurement &m)
{
  double count = 0, sum = 0, area = 0, area_sum = 0, force = 0, friction = 0, radius = 0;
  for (const SurfaceResults &surface : surfaces)
    for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
      const NodeResult &node = surface.nodes[a];
      if (!node.carries || node.status == ContactStatus::open || !(node.pressure > 0)) continue;
      const double mu = tangential(node) / node.pressure, A = node.area;
      count += 1;
      sum += mu;
      area += A;
      area_sum += A * mu;
      force += A * node.pressure;
      friction += A * node.pressure * mu;
      radius = std::max(radius, surface.slave[a].current[0]);
    }
  if (count == 0) return;
  const Scene &scene = problem.system.scene;
  const double N = m.normal_force;
  m.contact_radius = radius;
  if (!(N > 0)) return;
  m.mu_apparent = apparent_coefficient(scene.friction, m.torque, N, problem.system.face,
                                       problem.stepper.plates_now().top_rate);
  m.mu_gong = gong_coefficient(m.torque, N, problem.system.face);
  m.mu_mean = sum / count;
  m.mu_area_weighted = area_sum / area;
  m.mu_pressure_weighted = friction / force;
}

/// Nodal force times sliding velocity. A sticking node's velocity is what Newton's method left of zero: it
/// counts as zero.
double friction_power(const std::vector<SurfaceResults> &surfaces)
{
  double power = 0;
  for (const SurfaceResults &surface : surfaces)
    for (const NodeResult &node : surface.nodes)
      if (node.carries && node.status == ContactStatus::slip)
        power -= node.weight * node.nominal.dot(node.velocity);
  return power;
}

const char *name_of(ContactStatus status)
{
  return status == ContactStatus::open ? "open" : status == ContactStatus::stick ? "stick" : "slip";
}

ProfileRow row_at(const char *surface, const char *part, const SurfacePlace &place, double rotation)
{
  ProfileRow row{};
  row.surface = surface;
  row.part = part;
  row.reference_r = place.reference[0];
  row.reference_theta = place.reference[1];
  row.reference_z = place.reference[2];
  row.r = place.current[0];
  row.theta = place.current[1] + rotation;
  row.z = place.current[2];
  row.pressure = row.traction_radial = row.traction_circumferential = row.sliding_velocity = row.mu =
      undefined;
  row.status = "nan";
  return row;
}

/// Where the nodes of a curve of order 2 that begins on the axis are; empty: it is none.
std::vector<PlanePoint<double>> curve_from_axis(const Problem &problem,
                                                const std::vector<SurfacePlace> &places)
{
  std::vector<PlanePoint<double>> x;
  if (problem.system.mesh.dim != 2 || problem.system.scene.mesh.element_order != 2 ||
      places.front().reference[0] != 0)
    return x;
  for (const SurfacePlace &place : places) x.push_back({place.current[0], place.current[2]});
  return x;
}

/// On the axis nothing is tangential or slides; `next` to it are the two nodes that say what the pressure is
/// there.
void settle_on_axis(const std::vector<PlanePoint<double>> &x, const ProfileRow *next, ProfileRow &row)
{
  row.pressure = pressure_on_axis(x, {next[0].pressure, next[1].pressure});
  row.status = name_of(row.pressure > 0 ? ContactStatus::stick : ContactStatus::open);
  row.traction_radial = row.traction_circumferential = row.sliding_velocity = 0;
  if (row.pressure > 0) row.mu = 0;
}

void tabulate(const Problem &problem, const SurfaceResults &surface, const char *part,
              std::vector<ProfileRow> &profile)
{
  const double rotation = problem.stepper.plates_now().top_rotation;
  const std::size_t first = profile.size();
  for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
    if (!surface.on_crease.empty() && surface.on_crease[a]) continue; // a node of the face
    ProfileRow row = row_at("top", part, surface.slave[a], rotation);
    const NodeResult &node = surface.nodes[a];
    if (node.carries) {
      row.pressure = node.pressure;
      row.traction_radial = node.cauchy[0];
      row.traction_circumferential = node.cauchy[1];
      row.sliding_velocity = node.velocity.norm();
      row.status = name_of(node.status);
      if (node.status != ContactStatus::open && node.pressure > 0) row.mu = tangential(node) / node.pressure;
    }
    profile.push_back(row);
  }
  const auto curve = curve_from_axis(problem, surface.slave);
  if (curve.empty()) return;
  profile[first].z = height_on_axis(curve);
  if (!surface.nodes.front().carries) settle_on_axis(curve, &profile[first + 1], profile[first]);
}

/// The top gel's lower face and the part of its wall that may roll, then the bottom gel's face; curves from
/// the axis outwards and upwards.
void tabulate(const Problem &problem, const std::vector<SurfaceResults> &surfaces,
              std::vector<ProfileRow> &profile)
{
  for (const SurfaceResults &surface : surfaces)
    tabulate(problem, surface, &surface == &surfaces.front() ? "face" : "wall", profile);
  if (!problem.system.scene.has_bottom()) return;
  const double rotation = problem.stepper.plates_now().bottom_rotation;
  const std::vector<SurfacePlace> &master = surfaces.front().master;
  const std::size_t first = profile.size();
  for (const SurfacePlace &place : master) profile.push_back(row_at("bottom", "face", place, rotation));
  if (const auto curve = curve_from_axis(problem, master); !curve.empty())
    profile[first].z = height_on_axis(curve);
}

} // namespace

PetscErrorCode Measure(const Problem &problem, Measurement &measurement, std::vector<ProfileRow> *profile)
{
  LocalVector U, Udot;
  ConstArray u, rate;
  PetscFunctionBeginUser;
  measurement = {};
  PetscCall(U.Get(problem.system.mesh.dm));
  PetscCall(Udot.Get(problem.system.mesh.dm));
  PetscCall(problem.stepper.LocalState(U, Udot));
  PetscCall(u.Get(U));
  PetscCall(rate.Get(Udot));
  Wrench reaction;
  PetscCall(PlateReaction(problem, u, reaction));
  read_off(problem, reaction, measurement);
  if (problem.system.contact) {
    ContactResults results;
    PetscCall(problem.system.contact->Results(problem.stepper.plates_now(), u, rate, results,
                                              problem.stepper.friction_now()));
    reaction += results.wall;
    read_off(problem, reaction, measurement);
    if (problem.system.contact->between_gels()) {
      measurement.contact_force = results.force;
      measurement.contact_torque = results.torque;
      average(problem, results.surfaces, measurement);
      measurement.friction_power = friction_power(results.surfaces);
      if (profile) tabulate(problem, results.surfaces, *profile);
    }
  }
  PetscFunctionReturn(0);
}

} // namespace tribogel
