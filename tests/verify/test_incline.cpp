/// A block pushed up an incline: at full slip the horizontal force over the weight is
///
///   F/W = (tan alpha + mu)/(1 - mu tan alpha).
///
/// The plates only turn and travel, so the block stands far from the axis, at x = distance, where turning is
/// pushing along y: F = T/distance, W = N. Compression bends the interface, by angles that fall with it: so
/// does the error.
#include "solids.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

constexpr double slope = 0.1, mu = 0.3, distance = 1e4, exact = (slope + mu) / (1 - mu * slope);

/// Compression [mm] of two blocks, each 1 mm high; then the upper one slides up by five times that.
Measurement pushed(int order, double compression)
{
  const std::optional<Side> free;
  const auto beside = [](double a, double b, int cells) {
    std::vector<double> levels = even(a, b, cells);
    for (double &x : levels) x += distance;
    return levels;
  };
  const Box lower{{beside(-1, 1, 3), even(-1, 1, 3), even(-1, 0, 2)},
                  {free, free, free, free, Side::bottom_plate, Side::master}},
      upper{{beside(-0.5, 0.5, 2), even(-0.5, 0.5, 2), even(0, 1, 2)},
            {free, free, free, free, Side::slave, Side::top_plate}};
  SerialMesh mesh = stacked(lower, upper);
  for (const int body : {bottom_body, top_body})
    mesh.shape[body] = [](const std::array<double, 3> &X) -> std::array<double, 3> {
      return {X[0], X[1], X[2] + slope * X[1] * (1 - std::abs(X[2]))}; // the plates' faces stay level
    };
  Scene scene;
  scene.model = Model::solid;
  scene.plate_contact = false;
  scene.top = {1, 1, neo_hookean(0.6, 5)};
  scene.bottom = {1, 1, neo_hookean(0.6, 5)};
  scene.mesh.element_order = order;
  scene.friction = PolynomialFriction<double>{{mu}, {0}};
  scene.schedule = schedule_from_rates({1, 2}, {compression, compression}, {0, 5 * compression / distance});
  const SolverOptions options(fixed_steps(0.5, 1e-9));
  Problem problem;
  Recorder recorder("");
  bool completed = false;
  std::string why;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, mesh), 0);
  EXPECT_EQ(problem.Run({&recorder}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  return recorder.rows.back().measurement;
}

} // namespace

TEST(incline, TakesTheForceOfFullSlip)
{
  for (int order : {1, 2}) {
    double before = 0;
    for (const double compression : {1e-2, 1e-3}) {
      const Measurement m = pushed(order, compression);
      const double ratio = m.torque / distance / m.normal_force, error = ratio / exact - 1;
      std::printf("order %d, compression %.0e mm: W %.3e N, F/W %.6f of %.6f\n", order, compression,
                  m.normal_force, ratio, exact);
      EXPECT_NEAR(m.mu_pressure_weighted, mu, 1e-9); // no node sticks
      if (before != 0) {
        EXPECT_LT(std::abs(error), 0.12 * std::abs(before));
        EXPECT_LT(std::abs(error - (before - error) / 9), 2e-4) << "without compression";
      }
      before = error;
    }
  }
}

} // namespace tribogel::test
