/// C3, force and torque balance: in each row of a run of the paper scene the top plate's reactions equal the resultants
/// of the contact tractions. Their difference is the sum of the residuals that Newton's method leaves in the top gel,
/// so it follows the solver's tolerance and nothing else.
#include "uniform_compression.hpp"

namespace tribogel::test
{

namespace
{

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

TEST(balance, ViscousFriction) { expect_balance(paper_scene(5)); }

TEST(balance, Order1AndCoarserBottom)
{
  Scene scene = paper_scene(7, 1);
  scene.mesh.bottom_elements_radial = 4;
  expect_balance(scene);
}

TEST(balance, InitialGap)
{
  Scene scene = paper_scene(5);
  scene.initial_gap = 0.23;
  for (Phase &phase : scene.schedule) {
    phase.end_approach += scene.initial_gap;
    if (phase.start_approach > 0) phase.start_approach += scene.initial_gap;
  }
  expect_balance(scene);
}

TEST(balance, CoulombFriction)
{
  Scene scene = paper_scene(5);
  scene.friction = {{2.6e-4, 1e-5}, {0, 2}};
  expect_balance(scene);
}

} // namespace tribogel::test
