/// Rigid co-rotation through the whole program: both plates turn together for hundreds of revolutions
/// under load. Exact: no slip, no torque, and the normal force of the scene that does not turn, to round-off;
/// and a relative rotation gives the same torque whether the bottom plate stands still or both turn.
#include "scenes.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

constexpr double spin = 3.7; // rad/s, 530 revolutions

Scene turning_scene(double both, double relative, const PolynomialFriction<double> &friction)
{
  Scene scene = paper_scene(4);
  scene.friction = friction;
  scene.bottom_plate_rate = both;
  scene.schedule = schedule_from_rates({27, 300, 900}, {0.79, 0.79, 0.79}, {both, both, both + relative});
  return scene;
}

void expect_no_effect(const PolynomialFriction<double> &friction)
{
  Problem still, turning;
  Recorder without(""), with("");
  run(turning_scene(0, 0, friction), still, without);
  run(turning_scene(spin, 0, friction), turning, with);
  ASSERT_EQ(with.rows.size(), without.rows.size());
  const double N = without.rows.back().measurement.normal_force;
  const double R = still.system.scene.top.radius;
  ASSERT_GT(N, 1);
  double force = 0, torque = 0, slip = 0;
  for (std::size_t k = 0; k < with.rows.size(); ++k) {
    EXPECT_EQ(with.rows[k].time, without.rows[k].time);
    const Measurement &a = with.rows[k].measurement, &b = without.rows[k].measurement;
    force = std::max(force, std::abs(a.normal_force - b.normal_force) / N);
    torque = std::max({torque, std::abs(a.torque) / (N * R), std::abs(a.contact_torque) / (N * R)});
  }
  for (std::size_t k = 0; k < with.last_profile.size(); ++k) {
    const ProfileRow &a = with.last_profile[k], &b = without.last_profile[k];
    if (!std::isnan(a.sliding_velocity))
      slip = std::max(slip, std::abs(a.sliding_velocity - b.sliding_velocity) / (spin * R));
  }
  EXPECT_LE(force, 1e-13);
  EXPECT_LE(torque, 1e-15);
  EXPECT_LE(slip, 1e-15);
}

void expect_same_relative_rotation(const PolynomialFriction<double> &friction)
{
  const double relative = 0.13;
  Problem one, two;
  Recorder fixed(""), turning("");
  run(turning_scene(0, relative, friction), one, fixed);
  run(turning_scene(spin, relative, friction), two, turning);
  const Measurement &a = fixed.phases.back().measurement, &b = turning.phases.back().measurement;
  ASSERT_GT(a.torque, 1e-4 * a.normal_force);
  EXPECT_NEAR(b.torque / a.torque, 1, 1e-9); // Newton's tolerance: the iterations differ in their round-off
  EXPECT_NEAR(b.normal_force / a.normal_force, 1, 1e-9);
}

const PolynomialFriction<double> viscous{{8e-4}, {1}}, coulomb{{2.6e-4, 1e-5}, {0, 2}};

} // namespace

TEST(corotation, HundredsOfTurnsUnderLoadLeaveNoTraceViscous)
{
  expect_no_effect(viscous);
}

TEST(corotation, HundredsOfTurnsUnderLoadLeaveNoTraceCoulomb)
{
  expect_no_effect(coulomb);
}

TEST(corotation, OnlyTheRelativeRotationMattersViscous)
{
  expect_same_relative_rotation(viscous);
}

TEST(corotation, OnlyTheRelativeRotationMattersCoulomb)
{
  expect_same_relative_rotation(coulomb);
}

} // namespace tribogel::test
