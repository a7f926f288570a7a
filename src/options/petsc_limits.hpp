/// Options of PETSc that would break what the program promises, or that nothing would obey. Pure.
#pragma once

#include <string>
#include <vector>

namespace tribogel
{

/// Their names, with the dash.
std::vector<std::string> limited_petsc_options();

/// Throws UserError if this option of PETSc must not have this value.
void check_petsc_option(const std::string &name, const std::string &value);

} // namespace tribogel
