/// The first touch: any travel and any radius of the bottom gel that is not less than the top's. In space N
/// tends to the axisymmetric model's, within what the mesh leaves, and is linear in the travel down to
/// round-off.
#include "scenes.hpp"

#include <algorithm>
#include <cstdio>

namespace tribogel::test
{

namespace
{

Scene pressed(Model model, int order, double travel, double bottom_radius)
{
  const bool flat = model == Model::axisymmetric;
  Scene scene = paper_scene(flat ? 8 : order == 1 ? 3 : 2, flat ? 2 : order);
  scene.model = model;
  scene.bottom.radius = bottom_radius;
  if (!flat) scene.mesh.grading = 1;
  scene.schedule = schedule_from_rates({1}, {travel}, {0});
  scene.schedule_kind = ScheduleKind::steady;
  return scene;
}

Measurement measured(const Scene &scene)
{
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows.empty() ? Measurement{} : recorder.rows.back().measurement;
}

double N(Model model, int order, double travel, double bottom_radius)
{
  return measured(pressed(model, order, travel, bottom_radius)).normal_force;
}

constexpr double mesh_error[] = {0, 0.03, 0.005}; // of order 1 with 3 elements, order 2 with 2

} // namespace

TEST(first_touch, NIsLinearInTheTravelDownToRoundOff)
{
  const double stiffness = N(Model::axisymmetric, 2, 1e-4, 12.5) / 1e-4;
  EXPECT_NEAR(N(Model::axisymmetric, 2, 1e-9, 12.5) / 1e-9 / stiffness, 1, 1e-3);
  for (int order : {1, 2}) {
    const double solid = N(Model::solid, order, 1e-4, 12.5) / 1e-4;
    std::printf("order %d: %.5f N/mm, axisymmetric %.5f\n", order, solid, stiffness);
    EXPECT_NEAR(solid / stiffness, 1, mesh_error[order]) << order;
    for (const double travel : {1e-9, 1e-6}) {
      if (order == 2 && travel == 1e-6) continue; // dear
      EXPECT_NEAR(N(Model::solid, order, travel, 12.5) / travel / solid, 1, 2e-3) << order << ' ' << travel;
    }
  }
}

TEST(first_touch, AnyRadiusOfTheBottomGel)
{
  const double travel = 0.1;
  for (int order : {1, 2}) {
    const double equal = N(Model::solid, order, travel, 10);
    for (const double radius : {10.000001, 10.01, 10.2, 10.7}) {
      if (order == 2 && radius != 10.01) continue;
      const double solid = N(Model::solid, order, travel, radius),
                   flat = N(Model::axisymmetric, 2, travel, radius);
      EXPECT_NEAR(solid / flat, 1, mesh_error[order]) << order << ' ' << radius;
      EXPECT_NEAR(solid / equal, 1, 0.2 * (radius - 10) + 1e-7) << order << ' ' << radius;
    }
  }
}

TEST(first_touch, TurnsAtOnce)
{
  Scene solid = pressed(Model::solid, 1, 1e-3, 12.5), flat = pressed(Model::axisymmetric, 2, 1e-3, 12.5);
  for (Scene *scene : {&solid, &flat}) {
    scene->schedule_kind = ScheduleKind::transient;
    scene->schedule = schedule_from_rates({1}, {1e-3}, {1});
  }
  const Measurement a = measured(solid), b = measured(flat);
  EXPECT_NEAR(a.normal_force / b.normal_force, 1, mesh_error[1]);
  EXPECT_NEAR(a.torque / b.torque, 1, 0.1);
}

/// A gel wider by a millionth of a millimetre is the gel of equal radius.
TEST(first_touch, HalfPlaneOfNearlyEqualRadii)
{
  Measurement at[2];
  for (const int wider : {0, 1}) {
    Scene scene = paper_scene(4);
    scene.bottom.radius = wider ? 10.000001 : 10;
    scene.schedule = schedule_from_rates({27}, {0.79}, {0});
    at[wider] = measured(scene);
  }
  EXPECT_GT(at[0].normal_force, 100);
  EXPECT_NEAR(at[1].normal_force / at[0].normal_force, 1, 1e-6);
}

/// The bottom gel's radii: what the paper's scene has is kept; nothing is narrower than the refined edges
/// under the top's rim, but for edges at the outer wall that are as fine as at the top's.
TEST(first_touch, NoRingIsNarrow)
{
  Scene scene = pressed(Model::solid, 2, 0.79, 12.5);
  scene.mesh.elements_radial = 3;
  const std::vector<double> expected{0, 10. / 3, 20. / 3, 10, 10.79, 11.645, 12.5};
  const auto radii = meridian_blocks(scene).front().R;
  ASSERT_EQ(radii.size(), expected.size());
  for (std::size_t k = 0; k < radii.size(); ++k) EXPECT_NEAR(radii[k], expected[k], 1e-14 * 12.5);
  for (const double grading : {1.0, 30.0})
    for (const double radius : {10.0, 10.0 + 1e-14, 10.000001, 10.01, 10.1, 10.3, 10.6, 11.0, 12.5, 40.0})
      for (const double travel : {1e-12, 1e-6, 0.01, 0.2, 0.79}) {
        scene.mesh.grading = grading;
        scene.bottom.radius = radius;
        scene.schedule = schedule_from_rates({1}, {travel}, {0});
        const auto R = meridian_blocks(scene).front().R;
        double narrowest = radius, widest = 0;
        for (std::size_t k = 1; k < R.size(); ++k) {
          narrowest = std::min(narrowest, R[k] - R[k - 1]);
          widest = std::max(widest, R[k] - R[k - 1]);
        }
        EXPECT_EQ(R.back(), radius);
        EXPECT_GT(narrowest, 0.9 * widest / std::max(8.5, grading))
            << radius << ' ' << travel << ' ' << grading;
      }
}

} // namespace tribogel::test
