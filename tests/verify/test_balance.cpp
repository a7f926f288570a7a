/// C3, force and torque balance: in each row of a run of the paper scene the top plate's reactions equal the resultants
/// of the contact tractions. Their difference is the sum of the residuals that Newton's method leaves in the top gel,
/// so it follows the solver's tolerance and nothing else.
#include "scenes.hpp"
#include "solver_options.hpp"

namespace tribogel::test
{

namespace
{

Scene shortened(int elements_radial, int order = 2)
{
  Scene scene = paper_scene(elements_radial, order);
  scene.schedule = schedule_from_rates({27, 200, 300, 350}, {0.79, 0.79, 0.79, 0.7}, {0, 0, 0.04, 0.9});
  return scene;
}

/// Largest mismatches over the rows, over the largest N and N R.
std::array<double, 2> mismatch(const Scene &scene, double tolerance)
{
  const SolverOptions options(newton_tolerance(tolerance));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  double N = 0, T = 0, force = 0, torque = 0;
  for (const HistoryRow &row : recorder.rows) {
    N = std::max(N, row.measurement.normal_force);
    T = std::max(T, std::abs(row.measurement.torque));
    force = std::max(force, std::abs(row.measurement.force_mismatch()));
    torque = std::max(torque, std::abs(row.measurement.torque_mismatch()));
  }
  EXPECT_GT(N, 10);
  EXPECT_GT(recorder.rows.size(), 50u);
  std::cout << "[  numbers ] tolerance " << tolerance << ": force " << force / N << " torque " << torque / T
            << " of N " << N << " T " << T << " rows " << recorder.rows.size() << " newton "
            << problem.counts.newton_iterations << std::endl;
  return {force / N, T > 0 ? torque / T : torque};
}

void expect_balance(const Scene &scene)
{
  for (const double tolerance : {1e-5, 1e-10}) {
    const auto [force, torque] = mismatch(scene, tolerance);
    EXPECT_LE(force, 10 * tolerance);
    EXPECT_LE(torque, 10 * tolerance);
  }
}

} // namespace

TEST(balance, ViscousFriction) { expect_balance(shortened(4)); }

TEST(balance, Order1AndCoarserBottom)
{
  Scene scene = shortened(6, 1);
  scene.mesh.bottom_elements_radial = 4;
  expect_balance(scene);
}

TEST(balance, InitialGap)
{
  Scene scene = shortened(4);
  scene.initial_gap = 0.23;
  for (Phase &phase : scene.schedule) {
    phase.end_approach += scene.initial_gap;
    if (phase.start_approach > 0) phase.start_approach += scene.initial_gap;
  }
  expect_balance(scene);
}

TEST(balance, CoulombFriction)
{
  Scene scene = shortened(4);
  scene.friction = {{2.6e-4, 1e-5}, {0, 2}};
  expect_balance(scene);
}

} // namespace tribogel::test
