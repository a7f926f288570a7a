/// Whether the bodies of a file are what their groups say: cells that meet are joined, plates hold every
/// part, and no face that could bear a load is left out. What is certain is thrown as UserError, what is
/// suspicious is warned of.
#pragma once

#include "gmsh/bodies.hpp"

#include <vector>

namespace tribogel
{

/// An outer face that lies on a cell which is not its own.
struct Touch {
  int face; ///< index into GmshBodies::outer
  int cell;
  bool near; ///< closer than the mesh tells apart; else within a tenth of the face's size
};

/// At most one a face.
std::vector<Touch> touches_of(const GmshBodies &bodies);

/// No part of a body lies on another part of it with nodes of its own: a crack that nobody meant, meshes that
/// do not match (hanging nodes) or overlap. Warns of slits that are narrow for their mesh: their sides do not
/// feel each other.
void expect_joined(GmshBodies &bodies, const std::vector<Touch> &touches);

/// Each part, all that is joined through faces, has a face on its plate. An edge or a corner in common is a
/// hinge.
void expect_held(GmshBodies &bodies, Arrangement arrangement);

/// No face that lies in a plate's plane, or that goes on where a contact face ends, is in no group. A
/// physical surface of any other name says that a face is meant to be free. `travel` is how far the top plate
/// goes down [mm]: other faces without a group that may touch then are warned of.
void expect_whole_groups(GmshBodies &bodies, Arrangement arrangement, double travel);

/// The bodies do not touch where they are no contact faces.
void expect_apart(GmshBodies &bodies, const std::vector<Touch> &touches);

} // namespace tribogel
