/// Energies of a cell.
#pragma once

namespace tribogel
{

/// Integrals over one cell, for the energy balance [N mm].
struct CellEnergy {
  double stored = 0, dissipated = 0; ///< stored now; dissipated by the dashpots during the step
};

} // namespace tribogel
