#pragma once

namespace tribogel
{

inline constexpr const char *version = TRIBOGEL_VERSION; // set by CMakeLists.txt

} // namespace tribogel
