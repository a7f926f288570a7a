/// How the plates move, for the frames in which the bodies' unknowns are measured, and what they transmit.
#pragma once

#include "tribogel/math/tensor.hpp"
#include "tribogel/schedule/plate_motion.hpp"

#include <array>

namespace tribogel
{

struct PlateFrames : PlateMotion {
  std::array<double, 2> top_axis{}; ///< where the top plate's axis stands, the bottom's at (0, 0) [mm]
  double step = 1; ///< of time [s]: what turns a sliding velocity into a distance; infinite in steady states
                   ///< of the half plane
};

/// What a plate does to a gel, in the frame of the gel's unknowns; the moment is about that frame's origin,
/// at the height of the undeformed contact face. In the half plane only the components along z are not 0.
struct Wrench {
  Vector3<double> force = Vector3<double>::Zero();  ///< [N]
  Vector3<double> moment = Vector3<double>::Zero(); ///< [N mm]

  void add(const Vector3<double> &f, const Vector3<double> &x)
  {
    force += f;
    moment += x.cross(f);
  }
  Wrench &operator+=(const Wrench &other)
  {
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

} // namespace tribogel
