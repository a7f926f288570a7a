/// Torque of a bonded viscoelastic cylinder that is turned a little by an angle theta and then held.
/// Simple shear of every point, no volume change, hence for any history of the small twist per length theta/h
///
///   T(t) = (pi/2) a^4/h [G theta + G_v s],   s' = theta' - s/tau,   tau = eta_D/G_v                 (Maxwell
///   1867)
///
/// so that T(t) = (pi/2) a^4 (theta/h) (G + G_v exp(-t/tau)) after a jump at t = 0. Backward Euler in the
/// elastic strain has its own exact solution, s_(n+1) = (s_n + theta_(n+1) - theta_n)/(1 + dt/tau): the
/// program is held against it to the floor that finite strain (the twist squared) and the round-off of the
/// bulk modulus leave. SDIRK2 is linear there too: two such steps, the second from where the first arrives
/// when carried on.
#include "bulk_scenes.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 4.5, height = 3, theta = 3e-5, G = 0.7, G_branch = 1.3, viscosity = 2.6, relaxation = 2;
constexpr double stiffness = std::numbers::pi / 2 * a * a * a * a / height;

/// The plate turns until `ramp`, then rests until `end`; all times are multiples of dt.
std::vector<HistoryRow> history_of(int order, double ramp, double end, double dt,
                                   TimeRule rule = TimeRule::exponential_euler)
{
  Viscoelastic<double> material = neo_hookean(G, 40);
  material.branches.push_back({{{G_branch}, {2}, 30}, viscosity, 17});
  Scene scene = cylinder(a, height, material, order, 3);
  scene.schedule = schedule_from_twists({ramp, end}, {0, 0}, {theta, theta});
  scene.time.rule = rule;
  const SolverOptions options(fixed_steps(dt, 1e-13));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows;
}

double elastic_twist(double t, double ramp)
{
  const double rate = theta / ramp * relaxation;
  return t <= ramp ? -rate * std::expm1(-t / relaxation)
                   : -rate * std::expm1(-ramp / relaxation) * std::exp((ramp - t) / relaxation);
}

} // namespace

TEST(torque_relaxation, FollowsBackwardEulersOwnRecursion)
{
  for (int order : {1, 2}) {
    const std::vector<HistoryRow> rows = history_of(order, 1.5, 6, 0.25);
    ASSERT_EQ(rows.size(), 25u);
    double s = 0, worst = 0;
    for (std::size_t n = 1; n < rows.size(); ++n) {
      const double dt = rows[n].time - rows[n - 1].time;
      s = (s + rows[n].rotation - rows[n - 1].rotation) / (1 + dt / relaxation);
      worst = std::max(
          worst,
          std::abs(rows[n].measurement.torque / (stiffness * (G * rows[n].rotation + G_branch * s)) - 1));
    }
    std::printf("order %d: largest deviation from the recursion %.2e\n", order, worst);
    EXPECT_LT(worst, 1e-9);
  }
}

TEST(torque_relaxation, FollowsSdirk2sOwnRecursion)
{
  for (int order : {1, 2}) {
    const std::vector<HistoryRow> rows = history_of(order, 1.5, 6, 0.25, TimeRule::sdirk2);
    ASSERT_EQ(rows.size(), 25u);
    double flown = 0, worst = 0; // the twist per length that the dashpot has taken up
    for (std::size_t n = 1; n < rows.size(); ++n) {
      const double length = sdirk2::gamma * (rows[n].time - rows[n - 1].time), before = rows[n - 1].rotation;
      const double middle = before + sdirk2::gamma * (rows[n].rotation - before);
      flown += sdirk2::reach * length * (middle - flown) / (relaxation + length);
      flown += length * (rows[n].rotation - flown) / (relaxation + length);
      const double s = rows[n].rotation - flown;
      worst = std::max(
          worst,
          std::abs(rows[n].measurement.torque / (stiffness * (G * rows[n].rotation + G_branch * s)) - 1));
    }
    std::printf("order %d: largest deviation from the recursion %.2e\n", order, worst);
    EXPECT_LT(worst, 1e-9);
  }
}

void expect_order_in_time(TimeRule rule, double ratio, double tolerance)
{
  constexpr double times[] = {0.75, 1.5, 2.25, 6};
  double before[4] = {};
  for (double dt : {0.125, 0.0625, 0.03125}) {
    const std::vector<HistoryRow> rows = history_of(1, 1.5, 6, dt, rule);
    for (int k = 0; k < 4; ++k) {
      const HistoryRow &row = rows[static_cast<std::size_t>(std::lround(times[k] / dt))];
      ASSERT_NEAR(row.time, times[k], 1e-12);
      const double exact = stiffness * (G * row.rotation + G_branch * elastic_twist(row.time, 1.5));
      const double error = row.measurement.torque / exact - 1;
      std::printf("dt %.5f t %.2f: error %.3e\n", dt, row.time, error);
      if (before[k] != 0) {
        EXPECT_NEAR(before[k] / error, ratio, tolerance);
      }
      before[k] = error;
    }
  }
}

TEST(torque_relaxation, IsFirstOrderAccurateInTime)
{
  expect_order_in_time(TimeRule::exponential_euler, 2, 0.1);
}

TEST(torque_relaxation, IsSecondOrderAccurateInTimeWithSdirk2)
{
  expect_order_in_time(TimeRule::sdirk2, 4, 0.2);
}

/// A twist within a step far below the relaxation time is a jump; what follows, in steps as small, is the
/// exponential.
TEST(torque_relaxation, OfAJumpIsExponential)
{
  constexpr double step = 1.0 / 256;
  for (const HistoryRow &row : history_of(1, step, 6, step)) {
    if (row.time == 0) continue;
    const double exact = stiffness * theta * (G + G_branch * std::exp(-row.time / relaxation));
    EXPECT_NEAR(row.measurement.torque / exact, 1, step / relaxation) << row.time;
  }
}

} // namespace tribogel::test
