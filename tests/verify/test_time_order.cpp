/// Order in time of both rules: N(t) and T(t) of the paper scene under step halving, through loading,
/// early hold and rotation. The limit at each time is extrapolated from the last run and one with half its
/// step: a single fine run would flatter the order. Each phase ends on a common multiple of the steps.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tribogel::test
{

namespace
{

constexpr double sampling = 1.5, coarsest = 0.75; // [s]
constexpr std::array<double, 4> phase_ends = {0, 27, 36, 45};

/// N [N] and T [N mm] at the multiples of `sampling`.
using Curve = std::vector<std::array<double, 2>>;

Curve curve(const Scene &scene, double dt)
{
  const SolverOptions options(fixed_steps(dt, 1e-11));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  const auto stride = static_cast<std::size_t>(std::lround(sampling / dt));
  EXPECT_EQ(recorder.rows.size(), 1 + stride * std::lround(phase_ends.back() / sampling))
      << "a step was cut, the order cannot be measured";
  Curve sampled;
  for (std::size_t n = 0; n < recorder.rows.size(); n += stride) {
    const HistoryRow &row = recorder.rows[n];
    EXPECT_NEAR(row.time, sampling * static_cast<double>(sampled.size()), 1e-9);
    sampled.push_back({row.measurement.normal_force, row.measurement.torque});
  }
  return sampled;
}

/// Largest errors of N and T over a phase (from 0), over the largest N and T of the run.
std::array<double, 2> error(const Curve &is, const Curve &limit, std::size_t phase)
{
  std::array<double, 2> worst{}, largest{};
  for (std::size_t n = 0; n < limit.size(); ++n) {
    const double t = sampling * static_cast<double>(n);
    for (std::size_t i = 0; i < 2; ++i) {
      largest[i] = std::max(largest[i], std::abs(limit[n][i]));
      if (t > phase_ends[phase] && t <= phase_ends[phase + 1])
        worst[i] = std::max(worst[i], std::abs(is[n][i] - limit[n][i]));
    }
  }
  return {worst[0] / largest[0], worst[1] / largest[1]};
}

/// Three halvings; at least 0.1 below the rule's order in each phase, N in all, T in the last.
void expect_order(int order, const PolynomialFriction<double> &friction, double rate)
{
  Scene scene = paper_scene(4, 1);
  scene.friction = friction;
  scene.time.rule = order == 1 ? TimeRule::exponential_euler : TimeRule::sdirk2;
  scene.schedule =
      schedule_from_rates({phase_ends[1], phase_ends[2], phase_ends[3]}, {0.79, 0.79, 0.79}, {0, 0, rate});
  constexpr int halvings = 3;
  std::vector<Curve> curves;
  for (int k = 0; k <= halvings + 1; ++k) curves.push_back(curve(scene, std::ldexp(coarsest, -k)));
  Curve limit = curves.back();
  for (std::size_t n = 0; n < limit.size(); ++n)
    for (std::size_t i = 0; i < 2; ++i)
      limit[n][i] += (limit[n][i] - curves[halvings][n][i]) / ((1 << order) - 1);
  for (std::size_t phase = 0; phase < 3; ++phase) {
    std::array<double, 2> before{};
    for (int k = 0; k <= halvings; ++k) {
      const auto now = error(curves[static_cast<std::size_t>(k)], limit, phase);
      std::printf("phase %zu, step %.4f s: errors of N %.2e, T %.2e\n", phase + 1, std::ldexp(coarsest, -k),
                  now[0], now[1]);
      for (std::size_t i = 0; i < (phase == 2 ? 2u : 1u); ++i) {
        if (k > 0) {
          EXPECT_GE(std::log2(before[i] / now[i]), order - 0.1) << (i ? "T" : "N") << ", phase " << phase + 1;
        }
      }
      before = now;
    }
  }
}

} // namespace

TEST(time_order, OfForceAndTorqueWithThePapersLaw)
{
  expect_order(1, {{0, 8e-4}, {0, 1}}, 1);
}

TEST(time_order, OfSdirk2WithThePapersLaw)
{
  expect_order(2, {{0, 8e-4}, {0, 1}}, 1);
}

/// The contact takes about seven seconds to twist the gels.
TEST(time_order, OfForceAndTorqueWhileTheGelsAreTwisted)
{
  expect_order(1, {{2}, {1}}, 0.01);
}

TEST(time_order, OfSdirk2WhileTheGelsAreTwisted)
{
  expect_order(2, {{2}, {1}}, 0.01);
}

} // namespace tribogel::test
