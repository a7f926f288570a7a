/// Scenes whose side walls touch something.
#pragma once

#include "scenes.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

/// Phases that end at approach - h, approach, approach + h.
inline Schedule around(double approach, double h)
{
  return schedule_from_rates({10, 11, 12}, {approach - h, approach, approach + h}, {0, 0, 0});
}

/// A soft gel stuck to a stiff one: its wall rolls on.
inline Scene mushroom(int order)
{
  Scene scene = paper_scene(order == 1 ? 12 : 6, order);
  scene.top = {5, 5, hyperelastic_gel()};
  scene.bottom = {9, 2.3, hyperelastic_gel()};
  for (double &G : scene.bottom.material.equilibrium.moduli) G *= 10;
  scene.bottom.material.equilibrium.bulk_modulus *= 10;
  scene.friction = PolynomialFriction<double>{{20}, {0}};
  scene.mesh.grading = 3;
  scene.mesh.bottom_elements_radial =
      scene.mesh.elements_radial + 1; // nodes that do not meet, as in test_jacobian
  scene.schedule = around(2.2, 0.01);
  return scene;
}

} // namespace tribogel::test
