/// Bad input, in words for the user. Thrown by our own code and caught in main, which prints the text once,
/// after "tribogel: error: ", and exits with status 2. Never thrown inside a function that PETSc calls.
#pragma once

#include <string>

namespace tribogel
{

struct UserError {
  std::string text; ///< one line: the option or file, the value, and what is allowed
};

} // namespace tribogel
