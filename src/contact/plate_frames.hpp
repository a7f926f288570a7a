/// How the plates move, for the frames in which the bodies' unknowns are measured.
#pragma once

namespace tribogel
{

struct PlateFrames {
  double top_travel = 0;      ///< along z since t = 0 [mm]
  double top_travel_rate = 0; ///< [mm/s]
  double top_rate = 0;        ///< about z [rad/s]
  double bottom_rate = 0;     ///< [rad/s]
  double top_rotation = 0;    ///< [rad]
  double bottom_rotation = 0; ///< [rad]
  double step = 1;            ///< of time [s]: what turns a sliding velocity into a distance
};

} // namespace tribogel
