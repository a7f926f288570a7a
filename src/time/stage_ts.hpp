/// A type of PETSc's TS whose step is one backward Euler solve, or the two of SDIRK2 (THEORY 4.4): PETSc has
/// none of the latter for F(t, U, dU/dt) = 0.
#pragma once

#include <petscts.h>

namespace tribogel
{

/// Whom a TS of this type tells of its stages.
class StageOwner
{
public:
  virtual ~StageOwner() = default;
  virtual int stages() const = 0; ///< of a step, 1 or 2
  virtual PetscErrorCode BeginStage(int index, PetscReal end) = 0;
  virtual PetscErrorCode EndStage(int index, Vec U) = 0;

  /// Whether the second stage is to be solved again, and from where then.
  virtual PetscErrorCode Rings(bool &rings) const = 0;
  virtual PetscErrorCode DampStage(Vec base) = 0;

  /// Of the step whose stages are solved, over what is tolerated; negative: unknown.
  virtual PetscErrorCode EstimateError(PetscReal &error) const = 0;
};

inline constexpr const char *stage_ts = "gelstages";

/// Makes `ts` one of this type, which keeps nothing from one step to the next.
PetscErrorCode SetStageType(TS ts, StageOwner &owner);

/// `-ts_max_reject`, which PETSc 3.18 does not tell.
PetscInt rejections_allowed(TS ts);

} // namespace tribogel
