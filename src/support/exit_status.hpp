/// What the program tells its caller; part of the contract with users' scripts.
#pragma once

namespace tribogel
{

namespace exit_status
{
inline constexpr int completed = 0;    ///< the whole schedule was simulated; also -help and -version
inline constexpr int bad_input = 2;    ///< an option or a file is wrong; nothing was written
inline constexpr int cannot_go_on = 3; ///< the solver stopped; everything up to there is kept
inline constexpr int stopped_on_request = 4;
} // namespace exit_status

} // namespace tribogel
