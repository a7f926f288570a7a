/// Energy of the paper scene: work of the plates = stored + viscous dissipation + frictional dissipation.
/// The residual is of backward Euler and the sums in time, first order in dt (second where no dashpot works),
/// down to a floor of the mesh: the contact holds the weighted gap, so sliding surfaces leave the normal
/// tractions a little work. Where they stick there is none.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <array>
#include <cmath>

namespace tribogel::test
{

namespace
{

/// Pressed in 27 s, held, turned.
Scene pressed_and_turned(int order, const PolynomialFriction<double> &friction, double rate)
{
  Scene scene = paper_scene(4, order);
  scene.time.rule = TimeRule::exponential_euler;
  scene.friction = friction;
  scene.schedule = schedule_from_rates({27, 36, 45}, {0.79, 0.79, 0.79}, {0, 0, rate});
  return scene;
}

/// Frictionless springs, pressed only.
Scene pressed_springs(int elements_radial)
{
  Scene scene = paper_scene(elements_radial, 2);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.friction = {};
  scene.schedule.resize(1);
  return scene;
}

/// Balances at the phases' ends; heat never flows back.
std::vector<EnergyBalance> balances(const Scene &scene, double dt)
{
  const SolverOptions options(fixed_steps(dt, 1e-11));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  EXPECT_EQ(recorder.rows.size(),
            1u + static_cast<std::size_t>(std::lround(scene.schedule.back().end_time / dt)))
      << "a step was cut, the order cannot be measured";
  std::vector<EnergyBalance> ends;
  for (std::size_t n = 1; n < recorder.rows.size(); ++n) {
    const EnergyBalance &last = recorder.rows[n - 1].energy, &now = recorder.rows[n].energy;
    EXPECT_GE(now.viscous, last.viscous);
    EXPECT_GE(now.friction, last.friction - 1e-12 * now.work); // round-off where there is no friction
    if (!recorder.rows[n].report.ends_phase) continue;
    ends.push_back(now);
    std::printf(
        "step %.5f s, phase %zu: work %.5f stored %.5f viscous %.5f friction %.5f N mm, residual %.3e\n", dt,
        ends.size(), now.work, now.stored, now.viscous, now.friction, now.residual() / now.work);
  }
  return ends;
}

double residual(const EnergyBalance &end)
{
  return end.residual() / end.work;
}

/// Relative residuals of three runs, the step halved from one to the next, at the end of one phase (from 0).
std::array<double, 3> residuals(const std::array<std::vector<EnergyBalance>, 3> &runs, std::size_t phase)
{
  return {residual(runs[0].at(phase)), residual(runs[1].at(phase)), residual(runs[2].at(phase))};
}

std::array<std::vector<EnergyBalance>, 3> halvings(const Scene &scene, double dt)
{
  return {balances(scene, dt), balances(scene, dt / 2), balances(scene, dt / 4)};
}

/// Without the floor.
double order_in_time(const std::array<double, 3> &r)
{
  return std::log2((r[0] - r[1]) / (r[1] - r[2]));
}

} // namespace

TEST(energy, OfPressingAndTurningBalancesToFirstOrder)
{
  for (int order : {1, 2}) {
    const auto runs = halvings(pressed_and_turned(order, {{2}, {1}}, 0.02), 0.1875);
    const EnergyBalance &end = runs[2].back();
    EXPECT_GT(end.stored, 0.3 * end.work);
    EXPECT_GT(end.viscous, 0.1 * end.work);
    EXPECT_GT(end.friction, 0.1 * end.work);
    for (std::size_t phase : {0, 2}) {
      const std::array<double, 3> r = residuals(runs, phase);
      EXPECT_GE(order_in_time(r), 0.9);
      EXPECT_LE(std::abs(r[2]), 1e-3);
    }
  }
}

TEST(energy, OfPressingAndTurningBalancesToSecondOrderWithSdirk2)
{
  Scene scene = pressed_and_turned(2, {{2}, {1}}, 0.02);
  scene.time.rule = TimeRule::sdirk2;
  const auto runs = halvings(scene, 0.375);
  for (std::size_t phase : {0, 2}) {
    const std::array<double, 3> r = residuals(runs, phase);
    EXPECT_GE(order_in_time(r), 1.8);
    EXPECT_LE(std::abs(r[2]), 1e-3);
  }
}

TEST(energy, OfCoulombSlidingBalances)
{
  const Scene scene = pressed_and_turned(2, {{0.1}, {0}}, 0.03);
  const EnergyBalance coarse = balances(scene, 0.375).back(), fine = balances(scene, 0.1875).back();
  EXPECT_GT(fine.friction, 0.2 * fine.work);
  EXPECT_LE(std::abs(residual(fine)), 0.6 * std::abs(residual(coarse)));
  EXPECT_LE(std::abs(residual(fine)), 3e-3);
}

TEST(energy, OfStickingContactMakesNoHeatAndHasNoFloor)
{
  const auto runs = halvings(pressed_and_turned(2, {{2.0}, {0}}, 0.01), 1.5);
  for (const auto &ends : runs)
    for (const EnergyBalance &end : ends) EXPECT_EQ(end.friction, 0);
  for (std::size_t phase : {0, 2}) {
    const std::array<double, 3> r = residuals(runs, phase);
    EXPECT_GE(std::log2(r[0] / r[1]), 1);
    EXPECT_GE(std::log2(r[1] / r[2]), 1);
    EXPECT_LE(std::abs(r[2]), 1e-3);
  }
}

TEST(energy, OfFrictionlessSpringsErrsByTheQuadratureAndAFloorThatFallsWithTheMesh)
{
  EXPECT_NEAR(order_in_time(residuals(halvings(pressed_springs(4), 3), 0)), 2, 0.1);
  std::vector<double> floors;
  for (int elements : {4, 8, 16}) {
    const double coarse = residual(balances(pressed_springs(elements), 3).front()),
                 fine = residual(balances(pressed_springs(elements), 1.5).front());
    floors.push_back(std::abs(4 * fine - coarse) / 3);
    std::printf("%d elements: floor %.3e\n", elements, floors.back());
  }
  EXPECT_LE(floors[0], 1e-3);
  EXPECT_LE(floors[1], 0.7 * floors[0]);
  EXPECT_LE(floors[2], 0.7 * floors[1]);
}

} // namespace tribogel::test
