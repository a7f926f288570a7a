/// Friction that is not smooth at rest, through the whole program: tau = b v^m p^a on the paper's rheometer,
/// from rest through three rates of rotation. Once the gels' twist has settled v = omega r, so each slipping
/// node must carry the law's Cauchy traction and, N being the same, T must grow with omega^m.
#include "scenes.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

struct Case {
  PolynomialFriction<double> law;
  double torque_ratio; ///< for ten times the rate; 0: not a power of the rate
};

void check(const Case &c, int order)
{
  Problem problem;
  Recorder recorder("");
  Scene scene = paper_scene(6, order);
  scene.friction = c.law;
  run(scene, problem, recorder);
  ASSERT_EQ(recorder.phases.size(), 5u);
  const auto torque = [&](std::size_t k) { return recorder.phases[k].measurement.torque; };
  if (c.torque_ratio > 0) {
    EXPECT_NEAR(torque(3) / torque(2) / c.torque_ratio, 1, 1e-3);
    EXPECT_NEAR(torque(4) / torque(3) / c.torque_ratio, 1, 2e-2); // N grows a little with the torque
  }
  EXPECT_EQ(std::isnan(recorder.phases.back().measurement.mu_apparent), c.law.pressure_exponent != 1);
  int slipping = 0;
  for (const ProfileRow &row : recorder.last_profile) {
    if (row.status != std::string("slip")) continue;
    ++slipping;
    EXPECT_NEAR(row.mu / c.law.coefficient(row.sliding_velocity, row.pressure), 1, 1e-5) << "r " << row.r;
    EXPECT_NEAR(row.sliding_velocity / (recorder.phases.back().rate * row.r), 1, 1e-5);
  }
  EXPECT_GE(slipping, 6);
  PetscInt most = 0, all = 0;
  for (const HistoryRow &row : recorder.rows) {
    most = std::max(most, row.report.newton_iterations);
    all += row.report.newton_iterations;
  }
  EXPECT_LE(most, 12);
  ::testing::Test::RecordProperty("most_order_" + std::to_string(order), static_cast<int>(most));
  ::testing::Test::RecordProperty("all_order_" + std::to_string(order), static_cast<int>(all));
  ::testing::Test::RecordProperty("steps_order_" + std::to_string(order),
                                  static_cast<int>(recorder.rows.size()));
}

} // namespace

TEST(steep_friction, SquareRoot)
{
  for (const int order : {1, 2}) check({{{1e-3}, {0.5}}, std::sqrt(10)}, order);
}

TEST(steep_friction, SquareRootOnAThreshold)
{
  for (const int order : {1, 2}) check({{{1e-3, 1e-3, 1e-4}, {0, 0.5, 1}}, 0}, order);
}

TEST(steep_friction, NearlyCoulomb)
{
  for (const int order : {1, 2}) check({{{1e-3}, {0.1}}, std::pow(10, 0.1)}, order);
}

TEST(steep_friction, Kagata)
{
  for (const int order : {1, 2}) check({{{5e-4}, {0.5}, 0.5}, std::sqrt(10)}, order);
}

TEST(steep_friction, ViscousWithoutPressure)
{
  for (const int order : {1, 2}) check({{{1e-4}, {1}, 0}, 10}, order);
}

} // namespace tribogel::test
