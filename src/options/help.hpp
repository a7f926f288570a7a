/// -help and -help markdown as text.
#pragma once

#include <string>

namespace tribogel
{

std::string help_text();     ///< for a terminal
std::string help_markdown(); ///< the page options/README.md

} // namespace tribogel
