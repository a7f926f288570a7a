/// How the plates move: the one source of their travel and angles, from which follow the boundary values of a
/// gel between two plates, the frames in which contact is evaluated, the work, and what the files say.
#pragma once

#include "tribogel/schedule/schedule.hpp"

namespace tribogel
{

struct PlateMotion {
  double top_travel = 0;      ///< along z since t = 0, negative when it comes down [mm]
  double top_travel_rate = 0; ///< [mm/s]
  double top_rate = 0;        ///< about z [rad/s]
  double bottom_rate = 0;     ///< [rad/s]
  double top_rotation = 0;    ///< [rad]
  double bottom_rotation = 0; ///< [rad]
};

/// At a time within the phase, while the bottom plate turns steadily.
inline PlateMotion plate_motion(const Phase &phase, double bottom_rate, double time)
{
  return {-phase.approach(time), -phase.approach_rate(), phase.rate,
          bottom_rate,           phase.rotation(time),   bottom_rate * time};
}

} // namespace tribogel
