/// A mesh's surface as the contact operators want it.
#pragma once

#include "mesh/mesh.hpp"
#include "tribogel/contact/curve/state.hpp"
#include "tribogel/contact/surface/facet.hpp"

namespace tribogel
{

/// In the half plane.
inline SurfaceReference chain_of(const Surface &chain)
{
  SurfaceReference surface;
  for (const SurfaceNode &node : chain.node) surface.X.push_back({node.X[0], node.X[1]});
  for (const auto &facet : chain.facet) surface.facets.push_back({facet[0], facet[1], facet[2]});
  return surface;
}

/// In 3-D.
inline QuadReference quads_of(const Surface &face)
{
  QuadReference surface;
  for (const SurfaceNode &node : face.node) surface.X.emplace_back(node.X[0], node.X[1], node.X[2]);
  surface.facets = face.facet;
  return surface;
}

} // namespace tribogel
