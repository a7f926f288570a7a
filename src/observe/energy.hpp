/// Energy balance of a run: work of the plates = stored + viscous dissipation + frictional dissipation.
///
/// Work and frictional heat are trapezoidal sums of the plates' and the sliding nodes' power over the
/// accepted steps, the viscous heat is the time rule's own (THEORY 1.5, 1.7). What is left is of the rule's
/// order in the step, and does not vanish with it: the contact holds a weighted gap, so sliding along curved
/// surfaces leaves the normal tractions a little work, which falls with the mesh
/// (tests/verify/test_energy.cpp). With force and power at the step's end instead the springs alone would
/// leave half a step times the growth of the power, fifteen times as much while the gels are pressed.
#pragma once

#include "observe/measure.hpp"

namespace tribogel
{

/// Since t = 0, of both gels together, the same on every rank [N mm].
struct EnergyBalance {
  double work = 0;     ///< of the plates on the gels
  double stored = 0;   ///< in the gels' springs
  double viscous = 0;  ///< turned into heat by the gels' dashpots, never falls
  double friction = 0; ///< turned into heat between the gels, never falls

  double residual() const { return work - stored - viscous - friction; }
};

/// The sums at the problem's state from those one accepted step earlier. Collective.
PetscErrorCode AddEnergies(const Problem &problem, const Measurement *last, const Measurement &now,
                           const EnergyBalance &before, EnergyBalance &after);

} // namespace tribogel
