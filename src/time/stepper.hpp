/// PETSc's TS over the schedule of a System: phases, steps and their errors, the stages of a step, what is
/// committed when a step is accepted, and what is said when none succeeds.
#pragma once

#include "linear/direct_solver.hpp"
#include "support/stop_wish.hpp"
#include "system/system.hpp"
#include "time/failure.hpp"
#include "time/observer.hpp"
#include "time/stage_ts.hpp"

#include <limits>
#include <string>
#include <vector>

namespace tribogel
{

struct SolveCounts {
  PetscInt accepted_steps = 0, rejected_steps = 0, failed_solves = 0;
  PetscInt newton_iterations = 0, linear_iterations = 0, pattern_rebuilds = 0;
  FailureCounts failures{}; ///< failed solves by kind
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

class Stepper : private StageOwner
{
public:
  explicit Stepper(System &of) : system(of), scene(of.scene), mesh(of.mesh), contact(of.contact) {}

  PetscErrorCode SetUp();          ///< of a system that is set up; reads the options of TS, SNES, KSP and PC
  PetscErrorCode SetFromOptions(); ///< again

  /// One linear solve with a zero right-hand side: makes PETSc's inner solvers read their options.
  PetscErrorCode ProbeSolver();

  /// Run the schedule from the state on, which may be in the midst of a phase. `completed` is false when a
  /// step fails at the smallest size or an observer cannot do its work, `why` then says where and why; or
  /// when an observer has asked for a stop, `why` is its request.
  PetscErrorCode Run(const Problem &problem, const std::vector<Observer *> &observers, bool &completed,
                     std::string &why);

  /// Solution and rate in local vectors, prescribed values included. Collective.
  PetscErrorCode LocalState(Vec U, Vec Udot) const;

  const Phase &phase() const { return scene.schedule[state.phase]; }
  PlateMotion motion(double time) const;              ///< of the plates
  PlateFrames plates(double time, double step) const; ///< as the contact sees it in a step of that length
  PlateFrames plates_now() const { return plates(state.time, state.step); } ///< in the accepted state
  FrictionMemory friction_now() const; ///< what the contact conditions of the accepted state are told
  EulerSolve solve(double time) const; ///< at hand, that ends at `time`

  /// Room for the facets that may meet soon. The old matrix is gone, and what the linear solver made of it.
  PetscErrorCode BuildMatrix();

  State state;
  SolveCounts counts;
  StopWish stop;
  TsHandle ts;
  MatHandle jacobian;

private:
  friend struct StepperCallbacks;

  System &system;
  const Scene &scene;
  const Mesh &mesh;
  const std::unique_ptr<Contact> &contact;

  // What TS and SNES call (callbacks.cpp), in the order of a step.
  PetscErrorCode BeginStep(Vec U); ///< from the accepted state
  PetscErrorCode Predict(Vec U);
  PetscErrorCode PredictEuler(Vec U) const;
  PetscErrorCode PredictStage(Vec U) const;
  PetscErrorCode UpdatePattern(SNES snes);
  PetscErrorCode ChooseTolerance(SNES snes); ///< of the linear solve to come
  PetscErrorCode Converged(SNES snes, PetscInt iteration, PetscReal norm, SNESConvergedReason *reason);
  PetscErrorCode ErrorOfEuler(PetscReal &error) const;
  PetscErrorCode ErrorOfStages(PetscReal &error) const;
  PetscErrorCode AcceptStep(PetscReal time, Vec U);
  PetscErrorCode TakeFailure(SNES snes); ///< a solve that diverged

  // StageOwner
  int stages() const override { return scene.time.rule == TimeRule::sdirk2 ? 2 : 1; }
  PetscErrorCode BeginStage(int index, PetscReal time) override;
  PetscErrorCode EndStage(int index, Vec U) override;
  PetscErrorCode Rings(bool &rings) const override; ///< whether T has turned round in the second stage
  PetscErrorCode DampStage(Vec base) override;      ///< the second is to be solved again, from there
  PetscErrorCode EstimateError(PetscReal &error) const override
  {
    return stages() == 2 ? ErrorOfStages(error) : ErrorOfEuler(error);
  }

  /// Length of the backward Euler solve at hand, that ends at `time`, and what it tells the materials.
  double solve_length(double time) const { return stage.index == 0 ? time - state.time : stage.length; }
  StepWeights weights(double time) const;
  const History &start() const { return stage.index == 0 ? state.history : stage.history; }

  FrictionMemory friction_memory(double time) const;

  PetscErrorCode EvaluateEnd(PetscReal time, History &next,
                             CellEnergy &energy) const; ///< of the solve that converged last
  /// What friction remembers after the solve at hand, which ended at U with that rate. Collective.
  PetscErrorCode AdvanceFriction(PetscReal time, const FrictionMemory &memory, Vec U, Vec rate,
                                 FrictionHistory &next);
  PetscErrorCode FirstStep(PetscReal &step, PetscReal &unresolved) const; ///< of the phase [s]
  PetscErrorCode Diagnose(SNES snes, StepFailure &failure) const;
  PetscErrorCode CheckFriction(); ///< in the accepted state; may give up
  PetscErrorCode EndPhaseEarly();
  PetscErrorCode LargestStrain(const History &history, double &strain) const; ///< and so far, all ranks
  PetscErrorCode SetRates(double step, Vec U);
  PetscErrorCode SetUpTs();
  PetscErrorCode SetUpLinearSolver(SNES snes);
  PetscErrorCode HookLinearSolver(SNES snes);
  PetscErrorCode RegisterCallbacks();
  PetscReal ShortestStep() const;   ///< of the phase [s]
  PetscReal LongestStep() const;    ///< of the phase [s]
  PetscReal TimeUntilTouch() const; ///< [s]
  PetscErrorCode StopAtTouch(PetscReal left_before);
  PetscErrorCode RunPhase(int k);
  PetscErrorCode Notify(const std::string &text);
  PetscErrorCode CountFailures();
  std::string Explain(TSConvergedReason reason) const;

  /// Whether one more iteration with the matrix of the last one is enough: it leaves about 2 contraction of
  /// the residual, since a full step's remainder is half of what the matrix changes by along it.
  bool old_matrix_will_do() const
  {
    constexpr double allowance = 10;
    return allowance * contraction * worst.ratio <= 1;
  }

  Stage stage;
  VecHandle before;           ///< U at the start of the step
  DirectSolver direct_solver; ///< hooked where options ask for one
  WorstResidual worst;        ///< of the last Newton iteration
  /// Of the last Newton iteration, by `worst`; infinite outside of a solve and in its first iteration.
  double contraction = std::numeric_limits<double>::infinity();
  StepFailure last_failure; ///< words empty: none yet

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

  LogEvents events;
  const Problem *watched = nullptr; ///< what observers are shown
  std::vector<Observer *> watching;
  PetscReal given_first_step = 0;                  ///< `-ts_dt` [s], 0 if not given
  PetscReal given_longest_step = 0;                ///< `-ts_adapt_dt_max` [s]
  PetscInt rejected_before = 0, failed_before = 0; ///< counts that TS does not know of
};

} // namespace tribogel
