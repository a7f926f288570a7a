/// The bodies in the (R, Z) half plane before DMPlex sees them: structured blocks of quadrilaterals with named sides.
#pragma once

#include "tribogel/scene/scene.hpp"

#include <array>
#include <vector>

namespace tribogel
{

/// What a part of a body's outline is.
enum class Side { axis, wall, top_plate, bottom_plate, slave, master };
inline constexpr int side_count = 6;
inline constexpr const char *side_names[side_count] = {"axis", "wall", "top_plate", "bottom_plate", "slave", "master"};

inline constexpr int bottom_body = 0, top_body = 1;

/// One body: the tensor grid R x Z with a name for each of its four sides.
struct MeridianBlock {
  int body;
  std::vector<double> R, Z; ///< increasing [mm]
  Side inner, outer, lower, upper;

  long cells() const { return static_cast<long>(R.size() - 1) * static_cast<long>(Z.size() - 1); }
};

/// Points from a to b whose spacing grows from `smallest` at the fine ends by `ratio` up to `largest`, scaled to fit.
/// With no fine end the spacing is uniform, at most `largest`.
std::vector<double> graded_points(double a, double b, bool fine_at_a, bool fine_at_b, double smallest, double ratio,
                                  double largest);

/// Meshes of the scene's specimens. The spacing follows from the top (or only) specimen's radius: `elements_radial`
/// edges, `grading` times smaller at the rim than at the axis. The same smallest edge and growth are used towards the
/// bonded ends and the contact, where the stress is singular, and around the rim of the contact on the bottom body.
std::vector<MeridianBlock> meridian_blocks(const Scene &scene);

} // namespace tribogel
