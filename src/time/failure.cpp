/// A failed solve is named here; TS then cuts the step.
#include "time/failure.hpp"

#include "time/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace tribogel
{

namespace
{

PetscErrorCode DescribeLinearFailure(SNES snes, std::string &words)
{
  KSP ksp;
  PC pc;
  KSPConvergedReason reason;
  PCFailedReason factor;
  PetscInt iterations;
  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &iterations));
  PetscCall(PCGetFailedReason(pc, &factor));
  if (factor == PC_FACTOR_STRUCT_ZEROPIVOT || factor == PC_FACTOR_NUMERIC_ZEROPIVOT)
    words = "the tangent matrix is singular";
  else if (factor == PC_FACTOR_OUTMEMORY)
    words = "no memory for the factorisation of the matrix";
  else if (factor != PC_NOERROR)
    words = std::string("the preconditioner failed (") + PCFailedReasons[factor] + ")";
  else
    words = std::string("the linear solver stopped after ") + std::to_string(iterations) + " iterations (" +
            KSPConvergedReasons[reason] + "; -ksp_rtol, -ksp_max_it)";
  PetscFunctionReturn(0);
}

enum class Region { bonded_rim, contact_edge, contact_face, wall, inside };

/// The nearest part of the body's surface; its edges reach over a quarter of its height, half an element at
/// least.
Region region_of(const Scene &scene, const FailurePlace &place)
{
  const bool solid = scene.model == Model::solid, top = place.body == top_body;
  const Specimen &gel = top ? scene.top : scene.bottom;
  const double z = place.X[solid ? 2 : 1], contact = top ? scene.initial_gap : 0;
  const double from_wall = gel.radius - (solid ? std::hypot(place.X[0], place.X[1]) : place.X[0]);
  const double from_face = std::abs(z - contact), from_plate = std::abs(gel.height - from_face);
  const double element = scene.upper_gel().radius / scene.mesh.elements_radial;
  const double across = std::max(0.25 * gel.height, 0.5 * element);
  const double upwards = std::clamp(0.5 * element, 0.25 * gel.height, 0.5 * gel.height);
  const bool bonded = std::min(from_plate, scene.has_contact() ? from_plate : from_face) <= upwards;
  const bool at_contact = scene.has_contact() && from_face <= upwards;
  if (from_wall <= across)
    return bonded ? Region::bonded_rim : at_contact ? Region::contact_edge : Region::wall;
  return at_contact ? Region::contact_face : Region::inside;
}

} // namespace

std::string describe_end(const Scene &scene, const FailurePlace &place, double compression)
{
  if (!scene.round) return "";
  const bool top = place.body == top_body;
  const std::string gel = top ? "top gel" : "bottom gel";
  std::ostringstream text;
  const char *how = "";
  text << "This is ";
  switch (region_of(scene, place)) {
  case Region::bonded_rim:
    text << "the rim where the " << gel << " is bonded to its plate";
    how = ": the gel bulges there and its side wall folds onto the plate";
    break;
  case Region::contact_edge:
    text << "the " << (top ? "lower" : "upper") << " edge of the " << gel
         << ", between its contact face and its side wall";
    how = ", which rolls over and folds";
    break;
  case Region::contact_face:
    text << "the contact face of the " << gel << ", away from its edge";
    how = ", which wrinkles and folds";
    break;
  case Region::wall:
    text << "the side wall of the " << gel;
    how = ", which bulges and folds";
    break;
  case Region::inside:
    text << "inside the " << gel;
    break;
  }
  if (*how) text << (place.folds ? how : ", which may be about to fold");
  if (compression > 0) {
    text.precision(3);
    text << "; the gels are compressed by " << 100 * compression << " % of their height";
  }
  text << ". What may help: less compression or thicker gels, less friction, longer edges at the rims "
          "(-mesh_grading 4)";
  double height = std::numeric_limits<double>::infinity();
  for (const Specimen *each : scene.gels()) height = std::min(height, each->height);
  const double radius = scene.upper_gel().radius;
  if (const double enough = std::ceil(2 * radius / height); scene.mesh.elements_radial < enough)
    text << ", and elements of at most half of the thinner gel's height (-elements_radial " << enough << ")";
  return text.str();
}

PetscErrorCode Stepper::Diagnose(SNES snes, StepFailure &failure) const
{
  SNESConvergedReason reason;
  PetscFunctionBeginUser;
  PetscCall(SNESGetConvergedReason(snes, &reason));
  std::ostringstream text;
  const BulkFailure &bulk = system.failure.bulk;
  if (bulk) {
    failure.kind =
        bulk.status == PointStatus::inverted ? FailureKind::inverted_element : FailureKind::maxwell_update;
    text << describe(bulk);
    failure.place = {bulk.body, bulk.X, bulk.status == PointStatus::inverted};
  } else if (!system.failure.contact.empty()) {
    failure.kind = FailureKind::contact_search;
    text << system.failure.contact;
    if (const auto X = contact->failed_at()) failure.place = {top_body, *X};
  } else if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    failure.kind = FailureKind::linear_solver;
    PetscCall(DescribeLinearFailure(snes, failure.words));
    PetscFunctionReturn(0);
  } else if (reason == SNES_DIVERGED_FNORM_NAN) {
    failure.kind = FailureKind::not_a_number;
    text << "the residual is not a number";
  } else {
    failure.kind = FailureKind::newton;
    text << "Newton's " << (worst.group >= 0 ? group_names(mesh.dim)[worst.group] : "residual")
         << " stays at " << worst.ratio << " times its tolerance near " << describe_place(mesh.dim, worst.X)
         << " of the " << (worst.body == top_body ? "top" : "bottom") << " gel";
    if (worst.group >= 0) failure.place = {worst.body, worst.X, false};
  }
  failure.words = text.str();
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::TakeFailure(SNES snes)
{
  StepFailure &failure = last_failure;
  PetscFunctionBeginUser;
  failure = {};
  failure.time = state.time;
  PetscCall(TSGetTimeStep(ts, &failure.step));
  PetscCall(Diagnose(snes, failure));
  ++counts.failures[static_cast<std::size_t>(failure.kind)];
  for (Observer *observer : watching) PetscCall(observer->Failed(*watched, failure));

  // TSAdapt keeps to its smallest step when it chooses one, not when it cuts one.
  TSAdapt adapt;
  PetscReal smallest;
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptGetStepLimits(adapt, &smallest, nullptr));
  if (failure.step <= smallest) PetscCall(TSSetConvergedReason(ts, TS_DIVERGED_STEP_REJECTED));
  PetscFunctionReturn(0);
}

} // namespace tribogel
