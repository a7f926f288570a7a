/// What of a slave node does not change during a run, in the half plane as in space.
#pragma once

namespace tribogel
{

struct SlaveNode {
  bool carries = false; ///< has a multiplier
  double D = 0;         ///< constant diagonal of the mortar matrix, int psi_a w dS [mm^2]
  double extent = 0;    ///< int |N_a| w dS > 0: row scale of a node without multiplier [mm^2]
  double c_N = 0;       ///< softer modulus over the mean size of the node's facets [MPa/mm]
  int tied = -1;        ///< node of the crease to which this one's multiplier is extended, -1: none
  double tied_D = 0;    ///< int psi_a N_tied w dS [mm^2]

  double weight() const { return D + tied_D; } ///< int psi_a w dS [mm^2]
};

} // namespace tribogel
