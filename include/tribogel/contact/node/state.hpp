/// What the contact operators of both models are told of the present: nodal unknowns and the plates' motions.
#pragma once

#include "tribogel/friction/friction.hpp"
#include "tribogel/math/tensor.hpp"

#include <array>
#include <vector>

namespace tribogel
{

/// Of one body and its plate. T is double, or Dual in tests and sensitivities.
template <class T> struct SurfaceState {
  std::vector<Vector3<T>> u;    ///< unknowns of each node [mm]
  std::vector<Vector3<T>> rate; ///< their time derivatives [mm/s]
  double travel = 0;            ///< of the plate along z [mm]
  double travel_rate = 0;       ///< [mm/s]
  double rotation_rate = 0;     ///< of the plate about z [rad/s]
  double rotation = 0;          ///< of the plate [rad]; without effect in the axisymmetric model
};

template <class T> struct ContactState {
  SurfaceState<T> slave, master;
  std::vector<Vector3<T>>
      multiplier; ///< of each slave node: nominal traction on the slave [MPa]; 0 where none is carried
  std::array<double, 2>
      slave_axis{}; ///< where the slave's plate turns about z, the master's about (0, 0) [mm]
  double shift = 1; ///< d rate / d u of the time rule [1/s], for the Jacobian only
  /// Sets c_T = c_N / stick_rate [1/s], say 1/dt. It is part of the equation: the residual and the Jacobian
  /// of one step must be given the same value. 0 where the velocity is given: steady states of the half
  /// plane.
  double stick_rate = 1;
  /// Of each slave node: what its friction law remembers where the solve starts; empty for a law without
  /// memory.
  std::vector<double> memory;
  StepWeights weights{0};

  /// The law as slave node a meets it.
  Friction friction_at(int a, const Friction &law) const
  {
    return memory.empty() ? law : law.remembering(memory[static_cast<std::size_t>(a)], weights);
  }
};

} // namespace tribogel
