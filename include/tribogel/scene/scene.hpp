/// What is simulated, and how it is discretised: a plain value, built from options by the program and by hand
/// in tests. Units mm, N, s, MPa, rad. The defaults are the paper's rheometer as src/PAPER.md reads it.
#pragma once

#include "tribogel/friction/friction.hpp"
#include "tribogel/material/viscoelastic.hpp"
#include "tribogel/schedule/schedule.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace tribogel
{

/// One gel cylinder.
struct Specimen {
  double radius; ///< undeformed [mm]
  double height; ///< undeformed [mm]
  Viscoelastic<double> material;
};

/// How the top plate stands above the bottom one (solid model only).
struct Misalignment {
  std::array<double, 2>
      offset{}; ///< of the top plate's axis, about which it turns with its gel, from the bottom's [mm]
  double tilt =
      0; ///< of the top plate's face, with its gel, against its axis: about y, before the plate turns [rad]

  bool any() const { return offset[0] != 0 || offset[1] != 0 || tilt != 0; }
};

/// How a specimen's end is held by its plate. Glued is the rheometer; lubricated (free to slide radially,
/// still turned and moved by the plate) makes uniform states exact and is used by the tests.
enum class PlateBond { glued, lubricated };

/// The defaults were measured on the paper scene (order 2, default steps, ends of phases 2 and 5; 2.8 CPU s
/// with them):
///
///     elements  grading  unknowns  N [N]    T [N mm]  centre [mm]  CPU [s]
///     16        1        3134      289.98   11.442    0.3111       2.3
///     40        1        18622     289.65   11.414    0.3109       17
///     8         30       1746      290.626  11.4494   0.3090       1.3
///     10        30       2998      290.611  11.4493   0.3103       2.3
///     12        30       3798      290.538  11.4447   0.3105       2.8
///     16        30       6954      290.399  11.4371   0.3108       7.4
///     24        30       15186     290.421  11.4386   0.3110       18
///     order 1, grading 30, extrapolated from 16 to 48 elements: N = 290.45 +- 0.35, T = 11.440 +- 0.021
///
/// The side walls lie down on the plates over a tenth of a millimetre: uniform meshes do not see that (N
/// falls under refinement), and without contact of the walls graded ones do not converge (290.14, 289.73,
/// 289.70, 287.76 N with 8, 12, 16, 24 elements and grading 30). The width of the graded zone, a quarter of
/// the height, is no optimum: half and double that width changed N by 1e-4.
struct MeshParameters {
  int element_order = 2;          ///< 1 (Q1/P0) or 2 (Q2/P1)
  int elements_radial = 12;       ///< along the top radius
  double grading = 30;            ///< largest over smallest edge, >= 1
  int refinements = 0;            ///< how often all edges of that mesh are halved
  int bottom_elements_radial = 0; ///< over the same length on the bottom body; 0: as many
};

/// How the mortar integrals of the contact are taken (the half plane knows the first only).
enum class ContactIntegration {
  segments, ///< over the exact cells in which facets overlap
  elements  ///< at Gauss points of the slave facets
};

/// What the phases are: motions in time, or one relaxed state for each phase's end, whatever came before.
enum class ScheduleKind { transient, steady };

/// How the steps of time are taken, THEORY 4.1 and 4.4.
enum class TimeRule {
  exponential_euler, ///< backward Euler, first order: the paper's
  sdirk2             ///< two backward Euler solves a step, second order
};

struct TimeParameters {
  TimeRule rule = TimeRule::sdirk2;
  double tolerance =
      0.1; ///< of the errors that the step control keeps, per cent of the largest values so far
};

/// What stands between the plates. The bottom plate, or the bottom gel's undeformed face, is at z = 0.
enum class Arrangement {
  gel_on_gel,   ///< two gels in contact, each bonded to its plate
  gel_on_rigid, ///< the top gel, on a rigid plane that is the bottom plate: gel on glass
  single_gel    ///< the bottom gel alone, bonded to both plates
};

/// Bodies in the (R, Z) half plane, or in space.
enum class Model { axisymmetric, solid };

struct Scene {
  Model model = Model::axisymmetric;
  Arrangement arrangement = Arrangement::gel_on_gel;
  Specimen top, bottom;
  PlateBond plate_bond = PlateBond::glued;
  double initial_gap = 0; ///< between the gels before contact, to the lowest point of a tilted one [mm]
  Misalignment misalignment;
  bool round = true;      ///< the specimens are of revolution; false: of a mesh file
  bool even_faces = true; ///< they touch as a whole when pressed; false: what assumes that is undefined
  /// The side walls may touch the plates, and the top gel's wall may roll onto the bottom gel; else they meet
  /// nothing.
  bool plate_contact = true;
  ContactIntegration contact_integration = ContactIntegration::segments;
  Friction friction;
  std::optional<std::array<double, 2>> friction_speeds; ///< for which the law was found, from and to [mm/s]
  Schedule schedule;
  ScheduleKind schedule_kind = ScheduleKind::transient;
  double phase_end_tolerance = 0; ///< see -phase_end_tolerance; 0: off [% of the largest N and T so far]
  double bottom_plate_rate = 0;   ///< co-rotation of the bottom plate [rad/s]; no option, 0 but in tests
  MeshParameters mesh;
  TimeParameters time;

  bool has_top() const { return arrangement != Arrangement::single_gel; }
  bool has_bottom() const { return arrangement != Arrangement::gel_on_rigid; }
  bool has_contact() const { return has_top(); } ///< with friction, of a gel's lower face

  /// From below.
  std::vector<const Specimen *> gels() const
  {
    if (!has_top()) return {&bottom};
    if (!has_bottom()) return {&top};
    return {&bottom, &top};
  }

  /// The one that the top plate holds.
  const Specimen &upper_gel() const { return has_top() ? top : bottom; }

  /// Undeformed, without the gap [mm].
  double gel_height() const
  {
    double sum = 0;
    for (const Specimen *gel : gels()) sum += gel->height;
    return sum;
  }

  double gap() const { return has_contact() ? initial_gap : 0; } ///< to be closed before contact [mm]

  /// Equilibrium shear modulus of the softer gel [MPa].
  double softer_modulus() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Specimen *gel : gels()) least = std::min(least, gel->material.equilibrium.shear_modulus());
    return least;
  }

  /// Whether the plates' turning against each other loads the gels anew.
  bool loads_turn() const { return misalignment.any() || !round; }

  /// The length that makes a twist a displacement: the radius of the top (or only) specimen [mm].
  double twist_length() const { return upper_gel().radius; }
};

} // namespace tribogel
