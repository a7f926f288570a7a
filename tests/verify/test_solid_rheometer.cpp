/// Two gels in space: the rheometer's steady states against the axisymmetric model, rigid co-rotation,
/// balance.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <cstdio>

namespace tribogel::test
{

namespace
{

Scene steady_scene(Model model, int order, int elements)
{
  Scene scene = paper_scene(elements, order);
  scene.model = model;
  scene.plate_contact = false;
  scene.mesh.grading = 1;
  scene.schedule = schedule_from_rates({3600, 6300}, {0.79, 0.79}, {0, 1});
  scene.schedule_kind = ScheduleKind::steady;
  return scene;
}

} // namespace

/// On the same radii and heights the solid's N and T differ by what the circle's polygon (order 1) or
/// parabolas (order 2) make of it, which falls at the elements' order or better. Newton takes at most 12
/// iterations.
TEST(solid_rheometer, TendsToTheAxisymmetricModel)
{
  for (const auto &[order, coarse, fine] : {std::array{1, 4, 6}, std::array{2, 2, 3}}) {
    double difference[2][2];
    for (const int level : {0, 1}) {
      const int elements = level == 0 ? coarse : fine;
      Problem flat, solid;
      Recorder one(""), two("");
      run(steady_scene(Model::axisymmetric, order, elements), flat, one);
      run(steady_scene(Model::solid, order, elements), solid, two);
      const Measurement &a = one.rows.back().measurement, &b = two.rows.back().measurement;
      difference[level][0] = std::abs(b.normal_force / a.normal_force - 1);
      difference[level][1] = std::abs(b.torque / a.torque - 1);
      std::printf("order %d, %d elements: N %.3f N (axisymmetric %.3f), T %.4f N mm (%.4f)\n", order,
                  elements, b.normal_force, a.normal_force, b.torque, a.torque);
      EXPECT_LT(std::abs(b.force_mismatch()), 1e-6 * b.normal_force);
      EXPECT_LT(std::abs(b.torque_mismatch()), 0.02 * b.torque); // gap times traction on curved facets
      for (const HistoryRow &row : two.rows) EXPECT_LE(row.report.newton_iterations, 12);
    }
    const double expected = std::pow(static_cast<double>(coarse) / fine, order) * 1.1;
    for (const int k : {0, 1})
      EXPECT_LT(difference[1][k], expected * difference[0][k]) << order << (k ? " T" : " N");
    EXPECT_LT(difference[1][0], order == 1 ? 0.03 : 2e-3);
  }
}

/// Both plates turn together by 1000 rad under load. The friction is stiff enough to see any slip.
TEST(solid_rheometer, CommonRotationLeavesNoTrace)
{
  for (int order : {1, 2}) {
    Scene scene = steady_scene(Model::solid, order, order == 1 ? 3 : 2);
    scene.friction = PolynomialFriction<double>{{0.3}, {1}};
    scene.schedule = schedule_from_rates({100, 250}, {0.4, 0.4}, {4, 4});
    Problem still, turning;
    Recorder without(""), with("");
    scene.bottom_plate_rate = 4;
    run(scene, turning, with);
    scene.bottom_plate_rate = 0;
    scene.schedule = schedule_from_rates({100, 250}, {0.4, 0.4}, {0, 0});
    run(scene, still, without);
    const Measurement &a = with.rows.back().measurement, &b = without.rows.back().measurement;
    EXPECT_GT(b.normal_force, 10);
    EXPECT_NEAR(a.normal_force / b.normal_force, 1, 1e-12);
    EXPECT_LT(std::abs(a.torque - b.torque), 1e-12 * b.normal_force * scene.top.radius);
    EXPECT_LT(std::abs(b.torque), 1e-8 * b.normal_force * scene.top.radius);
  }
}

} // namespace tribogel::test
