/// A spherical cap pressed on a flat block of the same gel: Hertz's contact, with the finest mesh where they
/// meet.
///
/// The loads are so small (contact radius over sphere radius 1e-4) that finite strain and the difference
/// between sphere and paraboloid are far below the meshes' errors. The blocks are 20 and 10 times as wide and
/// high as the contact: that changes the pressure by (a/L)^3 only. The cap is narrower than the block, so
/// that no normal of its rim misses it.
#pragma once

#include "outlines.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <numbers>

namespace tribogel::test
{

struct HertzScene {
  int order = 2, level = 0;              ///< edges at the contact are a/4 2^-level long
  PolynomialFriction<double> friction{}; ///< none: frictionless
  double width = 20;                     ///< of the block over a
  double slope = 1e-4;                   ///< a over the sphere's radius
  double a = 1.3;                        ///< about the contact radius at the full load [mm]
  double bulk_over_shear = 5;            ///< of the gels

  double sphere() const { return a / slope; }
  /// Approach that would make the contact radius `part` of a between half-spaces [mm].
  double approach(double part = 1) const { return part * part * a * slope; }
  Viscoelastic<double> gel() const { return neo_hookean(0.4, bulk_over_shear); }
  Elastic elastic() const { return Elastic(gel().equilibrium); }

  Scene scene(const Schedule &schedule) const
  {
    Scene scene;
    scene.top = {0.9 * width * a, width * a, gel()};
    scene.bottom = {width * a, width * a, gel()};
    scene.mesh.element_order = order;
    scene.friction = friction;
    scene.plate_contact = false;
    scene.schedule = schedule;
    return scene;
  }

  std::vector<MeridianBlock> blocks() const
  {
    const double L = width * a;
    return {lower_body(graded_outwards(1.25 * a, 0.3125 * a, L, 1.4, level),
                       graded_outwards(0.5 * a, 0.25 * a, L, 1.4, level)),
            spherical_cap(sphere(), graded_outwards(1.25 * a, 0.25 * a, 0.9 * L, 1.4, level),
                          graded_outwards(0.5 * a, 0.25 * a, L, 1.4, level))};
  }
};

/// What follows from the measured force N.
struct Hertz {
  double N, radius, peak, approach; ///< [N, mm, MPa, mm]

  Hertz(const HertzScene &is, double force) : N(force)
  {
    const double modulus = is.elastic().plane() / 2; // of two equal bodies
    radius = std::cbrt(3 * N * is.sphere() / (4 * modulus));
    peak = 3 * N / (2 * std::numbers::pi * radius * radius);
    approach = radius * radius / is.sphere();
  }
  double pressure(double r) const { return r < radius ? peak * std::sqrt(1 - r * r / (radius * radius)) : 0; }
};

} // namespace tribogel::test
