/// What a run does besides computing: where it writes, how often, and when it stops. No result depends on it.
#pragma once

#include <limits>
#include <string>

namespace tribogel
{

struct OutputSettings {
  std::string directory = "tribogel-output";
  bool overwrite = false;
  bool restart = false;          ///< the directory holds a run that goes on
  bool error_estimate = false;   ///< of N and T at the phases' ends, by further runs
  double checkpoint_every = 600; ///< wall time between checkpoints [s]
  double wall_time = std::numeric_limits<double>::infinity(); ///< that the program may take [s]
};

} // namespace tribogel
