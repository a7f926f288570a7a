/// A scene made ready to be solved: mesh, bulk, contact, state, TS. Built from a Scene alone, without command
/// line or globals, so that a program can hold several.
#pragma once

#include "bulk/bulk.hpp"
#include "contact/contact.hpp"
#include "linear/contact_pc.hpp"
#include "linear/direct_solver.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/face.hpp"
#include "mesh/mesh.hpp"
#include "solve/failure.hpp"
#include "solve/log_events.hpp"
#include "solve/observer.hpp"
#include "solve/state.hpp"
#include "tribogel/scene/scene.hpp"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tribogel
{

/// Residuals are judged by group: three displacement and three traction components, each against the sum of
/// the absolute forces that meet in it.
inline constexpr int residual_groups = 6;
using GroupNames = std::array<const char *, residual_groups>;
inline constexpr GroupNames group_names_of[2] = {
    {"radial force", "circumferential force", "axial force", "radial contact condition",
     "circumferential contact condition", "axial contact condition"},
    {"force along x", "force along y", "force along z", "contact condition along x",
     "contact condition along y", "contact condition along z"}};
constexpr const GroupNames &group_names(int dim)
{
  return group_names_of[dim - 2];
}

struct SolveCounts {
  PetscInt accepted_steps = 0, rejected_steps = 0, failed_solves = 0;
  PetscInt newton_iterations = 0, linear_iterations = 0, pattern_rebuilds = 0;
  FailureCounts failures{}; ///< failed solves by kind
};

/// Where Newton stopped: the largest residual relative to its tolerance.
struct WorstResidual {
  double ratio = 0; ///< group norm over its tolerance
  int group = -1;
  std::array<double, 3> X{}; ///< of the node of the group's largest entry [mm]
  int body = 0;
};

/// The solve at hand: Euler's rule has one a step, SDIRK2 two. Nothing of it outlives the step.
struct Stage {
  int index = 0;     ///< of what follows, the first (0) has nothing and leaves it to the second (1)
  double time = 0;   ///< of the stage's end [s]
  double length = 0; ///< [s]
  VecHandle U;       ///< where the first stage ended
  History history;   ///< internal variables where the second starts
  FrictionHistory friction_start, friction_end; ///< where the second starts, and where the first ended
  bool damped = false;                          ///< the second goes on from the first by Euler's rule
  PlateLoads loads{};                           ///< at the end of the first
  double dissipated = 0; ///< the first stage's part of the step's, this rank's cells [N mm]
  PetscInt newton_iterations = 0, linear_iterations = 0; ///< of the first
};

class Problem
{
public:
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene);

  /// The same with bodies of another outline than the scene's cylinders, whose radii and heights then only
  /// scale (the twist's length, coefficients of friction).
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &scene, SerialMesh serial);
  PetscErrorCode SetUp(MPI_Comm comm, const Scene &given, const std::vector<MeridianBlock> &blocks)
  {
    return SetUp(comm, given, given.model == Model::solid ? revolved_mesh(blocks) : serial_mesh(blocks));
  }

  PetscErrorCode SetFromOptions(); ///< TS, SNES, KSP, PC

  /// One linear solve with a zero right-hand side: makes PETSc's inner solvers read their options.
  PetscErrorCode ProbeSolver();

  /// Whether the gels can stand on one another before anything deforms: `objection`, empty if nothing speaks
  /// against it, is why not; `doubts` gets what else is odd, also at angles that the schedule leads to.
  /// Collective.
  PetscErrorCode JudgeStart(std::string &objection, std::vector<std::string> &doubts);

  /// Run the schedule from the state on, which may be in the midst of a phase. `completed` is false when a
  /// step fails at the smallest size or an observer cannot do its work, `why` then says where and why; or
  /// when an observer has asked for a stop, `why` is its request.
  PetscErrorCode Run(const std::vector<Observer *> &observers, bool &completed, std::string &why);

  /// Solution and rate in local vectors, prescribed values included. Collective.
  PetscErrorCode LocalState(Vec U, Vec Udot) const;

  /// Internal minus external forces in the local arrays; on failure sets `failure` on the ranks concerned.
  PetscErrorCode AddResidual(double time, const double *U, const double *Udot, double *F, double *magnitude);
  PetscErrorCode AddJacobian(double time, const double *U, const double *Udot, double shift, Mat A);

  /// Prescribed displacements and rates at `time` (Udot may be null) in local arrays.
  void SetBoundary(double time, double *U, double *Udot) const;

  /// What the top plate does to the gel bonded to it, by this rank's part of its nodal forces `F`.
  Wrench plate_wrench(const double *U, const double *F) const;

  /// Where the top plate's face meets its axis, in the frame of its gel's unknowns: height above its origin
  /// [mm].
  double plate_height() const;

  const Phase &phase() const { return scene.schedule[state.phase]; }
  PlateFrames frames(double time, double step) const; ///< at `time`, for a step of that length
  bool steady() const { return scene.schedule_kind == ScheduleKind::steady; }

  /// Length of the backward Euler solve at hand, that ends at `time`, and what it tells the materials.
  double solve_length(double time) const { return stage.index == 0 ? time - state.time : stage.length; }
  StepWeights weights(double time) const;
  const History &start() const
  {
    return stage.index == 0 ? state.history : stage.history;
  } ///< internal variables

  /// What the contact conditions of the solve at hand are told, and those of the accepted state.
  FrictionMemory friction_memory(double time) const;
  FrictionMemory friction_now() const;

  Scene scene;
  Mesh mesh;
  std::unique_ptr<Bulk> bulk;
  std::unique_ptr<Contact> contact; ///< null where nothing can touch
  ContactFace face{0};              ///< of the top gel, undeformed
  State state;
  Stage stage;
  SolveCounts counts;
  std::string stop_request; ///< not empty: why the run is to stop after this step, the same on all ranks
  LogEvents events;
  TsHandle ts;
  MatHandle jacobian;
  DirectSolver direct_solver; ///< hooked where options ask for one

  // What round-off leaves of nothing, set once.
  PlateLoads least_loads{}; ///< N [N], T [N mm]
  double least_strain = 0;  ///< as State::largest_strain

  // What the last evaluation left for the convergence test and for messages.
  VecHandle magnitude, round_off; ///< global: sum of absolute forces; floor of their round-off
  std::vector<char> group;        ///< of each owned unknown
  std::vector<int> node_of_row;   ///< index into mesh.nodes of each owned unknown
  BulkFailure bulk_failure;
  std::string contact_failure;
  WorstResidual worst;
  StepFailure last_failure; ///< words empty: none yet
  std::string stop_reason;  ///< why the run cannot go on behind an accepted step; empty: it can

  /// To `stop_reason`, once.
  void stop_for(const std::string &reason)
  {
    if (stop_reason.find(reason) == std::string::npos)
      stop_reason += (stop_reason.empty() ? "" : "; ") + reason;
  }

  /// Of the last Newton iteration, by `worst`; infinite outside of a solve and in its first iteration.
  double contraction = std::numeric_limits<double>::infinity();

  /// Whether one more iteration with the matrix of the last one is enough: it leaves about 2 contraction of
  /// the residual, since a full step's remainder is half of what the matrix changes by along it.
  bool old_matrix_will_do() const
  {
    constexpr double allowance = 10;
    return allowance * contraction * worst.ratio <= 1;
  }

  PetscErrorCode BuildMatrix();
  PetscErrorCode BeginStep(); ///< from the accepted state
  PetscErrorCode UpdatePattern(SNES snes);
  PetscErrorCode ChooseTolerance(SNES snes);            ///< of the linear solve to come
  PetscErrorCode BeginStage(int index, PetscReal time); ///< of SDIRK2
  PetscErrorCode EndStage(int index, Vec U);
  PetscErrorCode Rings(bool &rings) const; ///< whether T has turned round in the second stage
  PetscErrorCode DampStage();              ///< the second is to be solved again
  PetscErrorCode PredictStage(Vec U) const;
  PetscErrorCode AcceptStep(PetscReal time, Vec U);
  PetscErrorCode EvaluateEnd(PetscReal time, History &next,
                             CellEnergy &energy); ///< of the solve that converged last
  /// What friction remembers after the solve at hand, which ended at U with that rate. Collective.
  PetscErrorCode AdvanceFriction(PetscReal time, const FrictionMemory &memory, Vec U, Vec rate,
                                 FrictionHistory &next);
  PetscErrorCode JudgeResidual(Vec F, bool has_iterated, bool &converged);
  PetscErrorCode FirstStep(PetscReal &step, PetscReal &unresolved) const; ///< of the phase [s]
  PetscErrorCode SumPlateLoads(PlateLoads &loads) const;
  PetscErrorCode Diagnose(SNES snes, StepFailure &failure) const; ///< of a solve that diverged
  PetscErrorCode CheckFriction(); ///< in the accepted state; may set stop_reason
  PetscErrorCode EndPhaseEarly();
  PetscErrorCode TellFailure();                                               ///< the observers
  PetscErrorCode LargestStrain(const History &history, double &strain) const; ///< and so far, all ranks
  double expected_compression() const;                     ///< of the gels, the largest of the schedule
  PlateLoads load_scales(const PlateLoads &largest) const; ///< what errors of N and T are compared with

private:
  PetscErrorCode SetRates(double step, Vec U);
  PetscErrorCode LocateWorst(const double *f);
  PetscErrorCode SetUpFields();
  PetscErrorCode ListContactUnknowns();
  PetscErrorCode InterpolateFromVertices(const PetscInt *to_global, ContactUnknowns &list);
  PetscErrorCode MeasurePlate();
  PetscErrorCode MeasureRoundOff();
  PetscErrorCode SetUpTs();
  PetscErrorCode SetUpLinearSolver(SNES snes);
  PetscErrorCode HookLinearSolver(SNES snes);
  PetscReal ShortestStep() const;   ///< of the phase [s]
  PetscReal LongestStep() const;    ///< of the phase [s]
  PetscReal TimeUntilTouch() const; ///< [s]
  PetscErrorCode StopAtTouch(PetscReal left_before);
  PetscErrorCode RunPhase(int k);
  PetscErrorCode Notify(const std::string &text);
  PetscErrorCode CountFailures();
  std::string Explain(TSConvergedReason reason) const;

  /// What has been told and is not told again.
  struct {
    bool beyond_speeds = false, not_unique = false, unstable = false;
    int ended_early = -1; ///< phase
  } told;

  /// How far linear solves go, and at the last one of this Newton solve: norm of the residual, and the
  /// relative tolerance chosen.
  enum class Forcing { given, loose, strict };
  struct {
    Forcing rule = Forcing::given; ///< by options
    double norm = 0, tolerance = 0;
  } forcing;

  std::vector<Observer *> watching;
  PetscReal given_first_step = 0;                          ///< `-ts_dt` [s], 0 if not given
  PetscReal given_longest_step = 0;                        ///< `-ts_adapt_dt_max` [s]
  PetscInt rejected_before = 0, failed_before = 0;         ///< counts that TS does not know of
  std::shared_ptr<const ContactUnknowns> contact_unknowns; ///< null in the half plane
  VecHandle before;                                        ///< U at the start of the step
  double plate_at_rest = 0;     ///< plate_height() before it moves against the gel's frame [mm]
  std::vector<int> plate_nodes; ///< on the top plate, indices into mesh.nodes
  PlateLoads plate_loads{};     ///< on this rank's cells in the last evaluation of the residual
  friend PetscErrorCode PreStep(TS);
};

/// An estimate with which TS repeats the length of the step: 0.9, its factor of safety, squared.
inline constexpr double keeps_the_step = 0.81;

/// An error estimate to eight bits. Its last digits are round-off, which differs between numbers of ranks,
/// and so would the steps: like this they do not, and a step is at most 1/500 off.
double rounded(double estimate);

/// SDIRK2's error estimate for TS (stages.cpp).
PetscErrorCode EvaluateSecondOrderError(TS ts, NormType, PetscInt *order, PetscReal *error);

/// Registers the PETSc callbacks on the problem's DM, TS and SNES (callbacks.cpp).
PetscErrorCode RegisterCallbacks(Problem &problem);

/// TS's hook after each solve (failure.cpp).
PetscErrorCode PostStage(TS ts, PetscReal time, PetscInt stage, Vec *Y);

} // namespace tribogel
