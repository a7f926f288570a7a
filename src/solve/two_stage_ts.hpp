/// SDIRK2 (THEORY 4.4) as a type of PETSc's TS, which has none for F(t, U, dU/dt) = 0.
#pragma once

#include <petscts.h>

namespace tribogel
{

inline constexpr const char *two_stage_ts = "sdirk2";

/// Makes the type known to TSSetType; again and again if need be. A TS of that type needs a Problem as its
/// application context, which it tells of its stages, and keeps nothing from one step to the next.
PetscErrorCode RegisterTwoStageTs();

} // namespace tribogel
