/// The preconditioner `-pc_type contact`: condensation of multipliers and held slave displacements
/// (condensation.hpp), and an inner solver with the prefix `condensed_` for what is left, one application of
/// a multigrid unless options say otherwise (`-condensed_pc_type gamg`, `hypre`, `lu`).
#pragma once

#include "linear/condensation.hpp"

#include <memory>

namespace tribogel
{

inline constexpr const char *contact_pc = "contact";

/// Makes the type known to PETSc, once a process.
PetscErrorCode RegisterContactPc();

/// Tells the preconditioner what the rows of A are.
PetscErrorCode AttachContactUnknowns(Mat A, const std::shared_ptr<const ContactUnknowns> &unknowns);

} // namespace tribogel
