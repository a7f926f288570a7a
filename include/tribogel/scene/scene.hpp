/// What is simulated: a plain value, built from options by the program and by hand in tests. Units mm, N, s, MPa, rad.
/// The defaults are the paper's rheometer as DESIGN reads it (see src/PAPER.md for what the paper fixes).
#pragma once

#include "tribogel/friction/polynomial.hpp"
#include "tribogel/material/viscoelastic.hpp"
#include "tribogel/schedule/schedule.hpp"

#include <string>

namespace tribogel
{

/// One gel cylinder.
struct Specimen {
  double radius; ///< undeformed [mm]
  double height; ///< undeformed [mm]
  Viscoelastic<double> material;
};

/// How a specimen's end is held by its plate. Glued is the rheometer; lubricated (free to slide radially, still turned
/// and moved by the plate) makes uniform states exact and is used by the tests.
enum class PlateBond { glued, lubricated };

struct MeshParameters {
  int element_order = 2;     ///< 1 (Q1/P0) or 2 (Q2/P1)
  int elements_radial = 16;  ///< along the top radius
  double grading = 8;        ///< largest over smallest edge, >= 1
  int bottom_elements_radial = 0; ///< over the same length on the bottom body; 0: as many. No option: tests set it
                                  ///< to make the meshes non-matching
};

struct OutputParameters {
  std::string directory = "tribogel-output";
  bool overwrite = false;
};

struct Scene {
  bool has_top = true; ///< false: `-specimens bottom`, one gel bonded to both plates
  Specimen top, bottom;
  PlateBond plate_bond = PlateBond::glued;
  double initial_gap = 0;         ///< between the gels before contact [mm]
  PolynomialFriction<double> friction;
  Schedule schedule;
  double bottom_plate_rate = 0; ///< co-rotation of the bottom plate [rad/s]; no option, 0 but in tests
  MeshParameters mesh;
  OutputParameters output;

  /// The length that makes a twist a displacement: the radius of the top (or only) specimen [mm].
  double twist_length() const { return has_top ? top.radius : bottom.radius; }
};

} // namespace tribogel
