/// How often a step is cut before the run ends.
#pragma once

#include <petscsys.h>

namespace tribogel
{

inline constexpr PetscInt most_rejections = 20; ///< of one step, unless options say otherwise

} // namespace tribogel
