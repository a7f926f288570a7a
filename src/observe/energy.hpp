/// Energy balance of a run: work of the plates = stored + viscous dissipation + frictional dissipation.
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
