/// The equations of a scene: F(U, dU/dt) = 0 and its derivatives, for one backward Euler solve at a time. It
/// holds the mesh, the bulk and the contact, and knows nothing of steps, phases or solvers. Built from a
/// Scene alone, without command line or globals, so that a program can hold several.
#pragma once

#include "bulk/bulk.hpp"
#include "contact/contact.hpp"
#include "linear/contact_pc.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/face.hpp"
#include "mesh/mesh.hpp"
#include "system/log_events.hpp"
#include "system/residual_rows.hpp"
#include "system/state.hpp"
#include "tribogel/scene/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tribogel
{

/// One backward Euler solve, as the equations see it.
struct EulerSolve {
  PlateFrames plates;      ///< at its end
  StepWeights weights;     ///< what it tells the materials
  const History &start;    ///< internal variables where it starts
  FrictionMemory friction; ///< what friction remembers there
};

/// What the last evaluation could not do, on every rank; words empty and no status: it could.
struct EvaluationFailure {
  BulkFailure bulk;
  std::string contact;
  explicit operator bool() const { return bulk || !contact.empty(); }
};

/// What round-off leaves of nothing.
struct RoundOff {
  PlateLoads loads{}; ///< N [N], T [N mm]
  double strain = 0;  ///< as State::largest_strain
};

class System
{
public:
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene, SerialMesh serial);

  /// Internal minus external forces in the local arrays; on failure sets `failure`. Collective.
  PetscErrorCode AddResidual(const EulerSolve &solve, const double *U, const double *Udot, double *F,
                             double *magnitude);
  /// dF/dU + shift dF/dUdot. Collective.
  PetscErrorCode AddJacobian(const EulerSolve &solve, const double *U, const double *Udot, double shift,
                             Mat A);

  /// dF / d travel [N/mm] and / d angle [N/rad] of the top plate through the contact, whose rates change by
  /// shift times as much, added to local arrays: all of it where each gel is measured from its own plate.
  /// Collective.
  PetscErrorCode AddMotionSlopes(const EulerSolve &solve, const double *U, const double *Udot, double shift,
                                 double *by_travel, double *by_turn);

  /// Prescribed displacements and rates (Udot may be null) in local arrays.
  void SetBoundary(const PlateMotion &plates, double *U, double *Udot) const;

  /// Gives a new matrix room for the bulk and for all pairs of facets that may meet soon. Collective.
  PetscErrorCode SetUpMatrix(Mat A);

  /// How large the residual F, of the last evaluation, is over what is allowed: `tolerance` times the forces
  /// that meet in each group of rows. Collective.
  PetscErrorCode JudgeResidual(Vec F, double tolerance, bool has_iterated, WorstResidual &worst,
                               bool &converged) const;

  /// Whether the gels can stand on one another before anything deforms: `objection`, empty if nothing speaks
  /// against it, is why not; `doubts` gets what else is odd, also at angles that the schedule leads to.
  /// Collective.
  PetscErrorCode JudgeStart(PlateFrames standing, std::string &objection, std::vector<std::string> &doubts);

  /// N and T by the reactions of the top plate in the last evaluation of the residual. Collective.
  PetscErrorCode SumPlateLoads(PlateLoads &loads) const;

  /// What the top plate does to the gel bonded to it, by this rank's part of its nodal forces `F`.
  Wrench plate_wrench(const double *U, const double *F) const;

  /// Where the top plate's face meets its axis, in the frame of its gel's unknowns: height above its origin
  /// [mm].
  double plate_height(const PlateMotion &plates) const;

  double expected_compression() const;                     ///< of the gels, the largest of the schedule
  PlateLoads load_scales(const PlateLoads &largest) const; ///< what errors of N and T are compared with

  /// Relaxed states: nothing moves, and the dashpots have had all the time.
  bool steady() const { return scene.schedule_kind == ScheduleKind::steady; }
  MPI_Comm comm() const { return PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<DM>(mesh.dm))); }

  Scene scene;
  Mesh mesh;
  std::unique_ptr<Bulk> bulk;
  std::unique_ptr<Contact> contact; ///< null where nothing can touch
  ContactFace face{0};              ///< of the top gel, undeformed
  ResidualRows rows;
  EvaluationFailure failure;
  RoundOff least; ///< set once

private:
  PetscErrorCode ListRows();
  PetscErrorCode LocateWorst(const double *f, WorstResidual &worst) const;
  PetscErrorCode ListContactUnknowns();
  PetscErrorCode InterpolateFromVertices(const PetscInt *to_global, ContactUnknowns &list);
  PetscErrorCode MeasurePlate();
  PetscErrorCode MeasureRoundOff();

  LogEvents events;
  std::shared_ptr<const ContactUnknowns> contact_unknowns; ///< null in the half plane
  double plate_at_rest = 0;     ///< plate_height() before it moves against the gel's frame [mm]
  std::vector<int> plate_nodes; ///< on the top plate, indices into mesh.nodes
  PlateLoads plate_loads{};     ///< on this rank's cells in the last evaluation of the residual
};

} // namespace tribogel
