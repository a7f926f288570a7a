/// How far a wall's facet must lean over the other body before its contact with it is tested.
#pragma once

namespace tribogel
{

/// A facet leans over the master while -n_s . n_m exceeds this: it encloses less than 60 degrees with the
/// master. A soft gel stuck on a stiff one and pressed to 40 % of its height (8 and 12 elements, gradings 4
/// and 20) gave the same N to 1e-4 with the limits 0.2 and 0.5; with 0.2 the coarse meshes failed on
/// projections of facets that stood too steep.
inline constexpr double least_facing = 0.5;

} // namespace tribogel
