/// Scenes and a runner for tests that go through the whole program.
#pragma once

#include "observe/recorder.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

namespace tribogel::test
{

/// The gel of the paper scene, without and with its Maxwell branch.
inline Viscoelastic<double> hyperelastic_gel()
{
  return {{{0.75, 0.45, 0.18}, {1.3, 2, 5}, 200}, {}};
}

inline Viscoelastic<double> viscoelastic_gel()
{
  Viscoelastic<double> gel = hyperelastic_gel();
  gel.branches.push_back({{{0.25, 0.45, 0.18}, {1.3, 2, 5}, 200}, 4.5, 200});
  return gel;
}

/// The paper's rheometer on a coarse mesh.
inline Scene paper_scene(int elements_radial, int order = 2)
{
  Scene scene;
  scene.top = {10, 4.4, viscoelastic_gel()};
  scene.bottom = {12.5, 4, viscoelastic_gel()};
  scene.friction = PolynomialFriction<double>{{0, 8e-4}, {0, 1}};
  scene.schedule =
      schedule_from_rates({27, 3600, 4500, 5400, 6300}, {0.79, 0.79, 0.79, 0.79, 0.79}, {0, 0, 0.01, 0.1, 1});
  scene.mesh.element_order = order;
  scene.mesh.elements_radial = elements_radial;
  scene.mesh.grading = 4;
  return scene;
}

/// Two discs of equal radius that slide radially on lubricated plates: uniform states are exact.
inline Scene lubricated_discs(double radius, double top_height, double bottom_height, int order)
{
  Scene scene;
  scene.top = {radius, top_height, hyperelastic_gel()};
  scene.bottom = {radius, bottom_height, hyperelastic_gel()};
  scene.plate_bond = PlateBond::lubricated;
  scene.plate_contact = false; // the walls stay upright
  scene.mesh.element_order = order;
  scene.mesh.elements_radial = 5;
  scene.mesh.grading = 2;
  return scene;
}

/// Runs the scene with bodies of these outlines, nothing written. The schedule must complete.
inline void run(const Scene &scene, const std::vector<MeridianBlock> &blocks, Problem &problem,
                Recorder &recorder)
{
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, blocks), 0);
  ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
}

inline void run(const Scene &scene, Problem &problem, Recorder &recorder)
{
  run(scene, meridian_blocks(scene), problem, recorder);
}

} // namespace tribogel::test
