/// Rate-and-state friction of two thin rings on lubricated plates: pressed evenly, and so far from their axis
/// that all of the contact slides alike, they are a spring and a slider. With the mean radius R, the plate's
/// speed V = omega R, the pressure p and the gels' shear stiffness k per area [MPa/mm]
///
///     p d mu/d t = k (V - v),    mu = a asinh[v / (2 v_0) exp((mu_0 + b ln(v_0 theta / L))/a)],
///     d theta / d t = 1 - v theta / L,
///
/// which Boost integrates. The rings are held for 3 s, turned, and turned three times faster: a static peak
/// that knows of the hold, the direct effect, the evolution over L. T/N over the contact's mean arm is mu.
/// The rest is the shear strain squared (2.6e-3 here) and the ring's width over R.
#include "outlines.hpp"
#include "tribogel/friction/rate_and_state.hpp"
#include "uniform_compression.hpp"

#include <boost/numeric/odeint.hpp>

namespace tribogel::test
{

namespace
{

constexpr double mu_0 = 0.3, a = 0.03, b = 0.04, L = 0.004, v_0 = 0.02, theta_0 = 0.5;
constexpr double R = 3e5, width = 300, compression = 1e-5; // undeformed [mm]
constexpr double top_height = 1320, heights = top_height + 1200, speeds[2] = {0.01, 0.03},
                 phase_ends[] = {1, 3, 9, 11};
const UniaxialState state = uniaxial_state(hyperelastic_gel().equilibrium, 1 - compression);

Friction friction()
{
  RateAndStateFriction<double> law;
  law.set({{mu_0}, {a}, {b}, {L}, {v_0}, {theta_0}});
  return law;
}

/// Mean over the contact's area of the distance from the axis, deformed [mm].
double mean_arm()
{
  const double outer = R + width / 2, inner = R - width / 2;
  return state.lateral * 2 * (std::pow(outer, 3) - std::pow(inner, 3)) /
         (3 * (outer * outer - inner * inner));
}

Scene rings()
{
  Scene scene = lubricated_discs(R + width / 2, top_height, heights - top_height, 1);
  scene.friction = friction();
  const double approach = compression * heights;
  scene.schedule = schedule_from_rates({phase_ends[0], phase_ends[1], phase_ends[2], phase_ends[3]},
                                       std::vector<double>(4, approach),
                                       {0, 0, speeds[0] / mean_arm(), speeds[1] / mean_arm()});
  return scene;
}

/// The friction coefficient in time, as the torque shows it.
std::vector<std::array<double, 2>> measured(const Scene &scene, std::vector<std::string> *notices = nullptr)
{
  std::vector<MeridianBlock> blocks = meridian_blocks(scene);
  for (MeridianBlock &ring : blocks) {
    ring.R = equal_points(R - width / 2, R + width / 2, width);
    ring.Z = {ring.Z.front(), ring.Z.back()};
    ring.inner = Side::wall;
  }
  Problem problem;
  Recorder recorder("");
  run(scene, blocks, problem, recorder);
  if (notices) *notices = recorder.notices;
  std::vector<std::array<double, 2>> curve;
  for (const HistoryRow &row : recorder.rows) {
    const Measurement &m = row.measurement;
    if (row.time > 0) curve.push_back({row.time, m.torque / m.normal_force / mean_arm()});
  }
  return curve;
}

/// Of the gels that are pressed [MPa/mm].
double stiffness()
{
  return state.shear_stiffness() / (state.axial * heights);
}

/// mu and theta of spring and slider after `duration` at V.
using SpringSlider = std::array<double, 2>;
void go_on(SpringSlider &at, double V, double duration)
{
  namespace odeint = boost::numeric::odeint;
  const double k = stiffness();
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_dopri5<SpringSlider>>(1e-11, 1e-11),
      [&](const SpringSlider &x, SpringSlider &rate, double) {
        const double strength = mu_0 + b * std::log(v_0 * x[1] / L);
        const double v = 2 * v_0 * std::sinh(x[0] / a) * std::exp(-strength / a);
        rate = {k / state.pressure * (V - v), 1 - v * x[1] / L};
      },
      at, 0.0, duration, 1e-4 * duration);
}

/// Largest difference of mu from spring and slider in each phase that turns.
std::array<double, 2> error(TimeRule rule, double dt)
{
  OptionList given = fixed_steps(dt, 1e-10);
  given.push_back({"-ts_atol", "1"}); // no second stage is damped, which is of first order
  const SolverOptions options(given);
  Scene scene = rings();
  scene.time.rule = rule;
  const auto curve = measured(scene);
  EXPECT_EQ(curve.size(), static_cast<std::size_t>(std::lround(phase_ends[3] / dt)));
  SpringSlider at{0, theta_0 + phase_ends[1]};
  double time = phase_ends[1];
  std::array<double, 2> worst{};
  double highest = 0;
  for (const auto &[t, mu] : curve) {
    if (t <= phase_ends[1] + dt / 2) {
      EXPECT_NEAR(mu, 0, 1e-9);
      continue;
    }
    const std::size_t phase = t > phase_ends[2] + dt / 2;
    go_on(at, speeds[phase], t - time);
    time = t;
    worst[phase] = std::max(worst[phase], std::abs(mu - at[0]));
    highest = std::max(highest, at[0]);
  }
  const double steady = mu_0 + (a - b) * std::log(speeds[1] / v_0);
  EXPECT_NEAR(at[0], steady, 1e-5); // the evolution is over
  EXPECT_GT(highest, steady + 0.03);
  return worst;
}

} // namespace

TEST(rate_and_state, IsSpringAndSliderInTime)
{
  for (const TimeRule rule : {TimeRule::exponential_euler, TimeRule::sdirk2}) {
    const int order = rule == TimeRule::sdirk2 ? 2 : 1;
    const double coarsest = order == 2 ? 0.1 : 0.05;
    std::array<double, 2> before{};
    for (const double dt : {coarsest, coarsest / 2, coarsest / 4}) {
      const auto now = error(rule, dt);
      std::printf("order %d, step %.4f s: errors of mu %.2e from rest, %.2e after the jump\n", order, dt,
                  now[0], now[1]);
      for (std::size_t k = 0; k < 2; ++k) {
        if (dt < coarsest) {
          EXPECT_GE(std::log2(before[k] / now[k]), order - 0.2) << "phase " << k;
        }
        EXPECT_LT(now[k], order == 2 ? 1e-3 : 1e-2);
      }
      before = now;
    }
  }
}

/// A steady schedule finds mu_ss = mu_0 + (a - b) ln(v / v_0) at once, up to exp(-2 mu/a) = 2e-9.
TEST(rate_and_state, IsTheSteadyStateOfASteadySchedule)
{
  Scene scene = rings();
  scene.friction = friction();
  scene.schedule_kind = ScheduleKind::steady;
  scene.schedule = schedule_from_rates({1, 2}, std::vector<double>(2, compression * heights),
                                       {speeds[0] / mean_arm(), speeds[1] / mean_arm()});
  const SolverOptions options(newton_tolerance(1e-11));
  const auto curve = measured(scene);
  for (const auto &[t, mu] : curve)
    if (t == 1 || t == 2) {
      EXPECT_NEAR(mu, mu_0 + (a - b) * std::log(speeds[t == 2] / v_0), 1e-7);
    }
  EXPECT_EQ(curve.back()[0], 2);
}

/// Sliding that weakens is stable where the gels are stiffer than k_c = p (b - a)/L (Ruina 1983); the program
/// says where they are not.
TEST(rate_and_state, SaysWhereTheGelsAreTooSoftToSlideSteadily)
{
  for (const double ratio : {0.9, 1.1}) { // k_c over the gels' stiffness
    Scene scene = rings();
    RateAndStateFriction<double> law;
    law.set({{mu_0}, {a}, {b}, {state.pressure * (b - a) / (ratio * stiffness())}, {v_0}, {theta_0}});
    scene.friction = law;
    scene.schedule_kind = ScheduleKind::steady;
    scene.schedule = schedule_from_rates({1}, {compression * heights}, {speeds[0] / mean_arm()});
    std::vector<std::string> notices;
    measured(scene, &notices);
    ASSERT_EQ(notices.size(), ratio > 1 ? 1u : 0u);
    if (ratio > 1) {
      EXPECT_NE(notices[0].find("sticks and slips"), std::string::npos) << notices[0];
    }
  }
}

} // namespace tribogel::test
