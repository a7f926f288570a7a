/// What is simulated: a plain value, built from options by the program and by hand in tests. Units mm, N, s, MPa, rad.
/// The defaults are the paper's rheometer as src/PAPER.md reads it.
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

/// The defaults were measured on the paper scene (phases 1 to 3, order 2, `-ts_atol 1e-2`), where N and T still drift
/// by 0.05 % under refinement because nothing stops the fold at the glued rims:
///
///     elements  grading  unknowns  N [N]    T [N mm]  centre [mm]  rim [mm]
///     8         1        944       290.616  0.114567  0.3096       0.1267
///     16        1        3128      290.251  0.114296  0.3107       0.1227
///     24        1        6704      290.197  0.114275  0.3109       0.1230
///     8         4        1536      290.293  0.114314  0.3048       0.1215
///     16        4        5952      290.066  0.114202  0.3102       0.1235
///     24        4        12376     289.919  0.114099  0.3105       0.1246
///     16        8        7264      289.965  0.114135  0.3094       0.1243
///     24        8        15768     289.848  0.114076  0.3104       0.1227
///
/// Grading beyond 4 starves the axis (the centre's displacement) for little gain at the rim.
struct MeshParameters {
  int element_order = 2;          ///< 1 (Q1/P0) or 2 (Q2/P1)
  int elements_radial = 12;       ///< along the top radius
  double grading = 30;            ///< largest over smallest edge, >= 1
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
  double initial_gap = 0; ///< between the gels before contact [mm]
  /// The side walls may touch the plates, and the top gel's wall may roll onto the bottom gel; else they meet nothing.
  bool plate_contact = true;
  PolynomialFriction<double> friction;
  Schedule schedule;
  double bottom_plate_rate = 0; ///< co-rotation of the bottom plate [rad/s]; no option, 0 but in tests
  MeshParameters mesh;
  OutputParameters output;

  /// The length that makes a twist a displacement: the radius of the top (or only) specimen [mm].
  double twist_length() const { return has_top ? top.radius : bottom.radius; }
};

} // namespace tribogel
