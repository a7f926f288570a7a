/// A mesh's surface as the contact operators want it.
#pragma once

#include "mesh/mesh.hpp"
#include "tribogel/contact/axisymmetric_state.hpp"

namespace tribogel
{

inline SurfaceReference reference_of(const Surface &chain)
{
  SurfaceReference surface;
  for (const SurfaceNode &node : chain.node) surface.X.push_back({node.X[0], node.X[1]});
  for (const auto &facet : chain.facet) surface.facets.push_back({facet[0], facet[1], facet[2]});
  return surface;
}

} // namespace tribogel
