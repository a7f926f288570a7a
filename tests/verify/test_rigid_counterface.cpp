/// A gel on a rigid plane (gel on glass), held to states that are known without this program:
///
/// - Uniform pressure. A lubricated disc is pressed evenly; N is the uniaxial state's, and in steady rotation
///   v = omega r, T = 2 pi int tau(omega r, p) r^2 dr = sum_m b_m omega^m 2 pi p R^(m+3)/(m+3). One gel takes
///   the whole compression.
/// - Hertz: a sphere of plane modulus E* on a rigid plane, a^3 = 3 N R/(4 E*), p_0 = 3 N/(2 pi a^2).
/// - Hertz turned, partial slip (Lubkin, test_hertz_torsion.cpp): for c/a = 0.8, 0.5, 0.2 the twist is
///   0.079419, 0.225712, 0.469255 mu N/(G a^2) and the torque 0.310527, 0.528576, 0.585543 mu N a; sliding
///   everywhere 3 pi/16. The gel is nearly incompressible: a half-space of nu = 1/2 does not spread under a
///   normal pressure, and no friction is used up against that.
/// - A thin disc that nothing lets slide is a bonded one (test_locking.cpp): E_c/G = 51.55 and 125.13 for K/G
///   = 100 and 1000 at S = 5, by a theory that is about 2 % low.
///
/// In all of them plate and contact agree in force and torque. Walls that roll onto the plane:
/// test_walls.cpp; the tangent: test_jacobian.cpp.
#include "hertz.hpp"
#include "uniform_compression.hpp"

namespace tribogel::test
{

namespace
{

constexpr double pi = std::numbers::pi;

void expect_balance(const Measurement &m, double radius)
{
  EXPECT_NEAR(m.contact_force / m.normal_force, 1, 1e-7);
  EXPECT_NEAR(m.contact_torque, m.torque, 1e-7 * (std::abs(m.torque) + m.normal_force * radius));
}

Scene on_plane(Scene scene)
{
  scene.arrangement = Arrangement::gel_on_rigid;
  return scene;
}

/// Compressed by 3 %, turned at 0.1 rad/s: N and T over the exact ones.
std::array<double, 2> uniform_ratios(int order, int elements, const std::vector<double> &b,
                                     const std::vector<double> &exponents)
{
  constexpr double compression = 0.03, rate = 0.1;
  const UniaxialState state = uniaxial_state(hyperelastic_gel().equilibrium, 1 - compression);
  Scene scene = on_plane(lubricated_discs(10 / state.lateral, 4.4, 4, order));
  scene.mesh.elements_radial = elements;
  scene.mesh.grading = 1;
  scene.friction = PolynomialFriction<double>{b, exponents};
  const double approach = compression * scene.top.height;
  scene.schedule = schedule_from_rates({2.5, 10}, {approach, approach}, {0, rate});
  const SolverOptions options(fixed_steps(1.25, 1e-11));
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  const Measurement &m = recorder.rows.back().measurement;
  expect_balance(m, 10);
  double exact = 0;
  for (std::size_t k = 0; k < b.size(); ++k)
    exact += b[k] * std::pow(rate, exponents[k]) * 2 * pi * state.pressure * std::pow(10, exponents[k] + 3) /
             (exponents[k] + 3);
  return {m.normal_force / (state.pressure * pi * 100), m.torque / exact};
}

/// The cap of HertzScene on the plane.
struct CapOnPlane : HertzScene {
  Hertz run_to(const std::vector<double> &twists, int steps, Problem &problem, Recorder &recorder,
               std::vector<double> &torque) const
  {
    std::vector<double> times{1}, approaches{approach()}, twist{0};
    for (const double angle : twists) {
      times.push_back(times.back() + 1);
      approaches.push_back(approach());
      twist.push_back(angle);
    }
    OptionList list = fixed_steps(1.0 / steps, 1e-10);
    list.push_back({"-snes_max_it", "8"}); // as in test_hertz_torsion
    const SolverOptions options(list);
    Scene scene = on_plane(HertzScene::scene(schedule_from_twists(times, approaches, twist)));
    run(scene, {HertzScene::blocks().back()}, problem, recorder);
    for (std::size_t k = 1; k < recorder.phases.size(); ++k)
      torque.push_back(recorder.phases[k].measurement.torque);
    Hertz hertz(*this, recorder.rows.back().measurement.normal_force);
    hertz.radius = std::cbrt(3 * hertz.N * sphere() / (4 * elastic().plane()));
    hertz.peak = 3 * hertz.N / (2 * pi * hertz.radius * hertz.radius);
    return hertz;
  }
};

} // namespace

class rigid_counterface : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(order, rigid_counterface, ::testing::Values(1, 2));

TEST_P(rigid_counterface, UniformPressure)
{
  const auto [N, coulomb] = uniform_ratios(GetParam(), 4, {3.1e-4}, {0});
  EXPECT_NEAR(N, 1, 1e-7);
  EXPECT_NEAR(coulomb, 1, 1e-7); // the interpolant of r is exact at both orders
  const auto [same, linear] = uniform_ratios(GetParam(), 16, {2.2e-4, 3.26e-5}, {0, 1});
  EXPECT_NEAR(same, 1, 1e-7);
  EXPECT_NEAR(linear, 1, GetParam() == 1 ? 2e-3 : 1e-7); // second order in 1/16, and exact
}

/// The same gel in space and in the half plane, bonded, with a law that depends on the current area: what
/// differs is the mesh.
TEST_P(rigid_counterface, SpaceAgreesWithTheHalfPlane)
{
  const SolverOptions options(newton_tolerance(1e-10));
  Measurement of[2];
  for (const Model model : {Model::axisymmetric, Model::solid}) {
    Scene scene = on_plane(paper_scene(GetParam() == 1 ? 6 : 4, GetParam()));
    scene.model = model;
    scene.mesh.grading = 1;
    scene.friction = PolynomialFriction<double>{{0.01, 4e-3}, {0, 1}, 0.5};
    scene.schedule = schedule_from_rates({1}, {0.3}, {0.4});
    scene.schedule_kind = ScheduleKind::steady;
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    Measurement &m = of[model == Model::solid];
    m = recorder.rows.back().measurement;
    expect_balance(m, scene.top.radius);
  }
  const double allowed = GetParam() == 1 ? 0.03 : 0.005;
  EXPECT_NEAR(of[1].normal_force / of[0].normal_force, 1, allowed);
  EXPECT_NEAR(of[1].torque / of[0].torque, 1, allowed);
}

TEST_P(rigid_counterface, HertzPressure)
{
  CapOnPlane is;
  is.order = GetParam();
  is.level = is.order == 1 ? 2 : 1;
  Problem problem;
  Recorder recorder("");
  std::vector<double> torque;
  const Hertz hertz = is.run_to({}, 4, problem, recorder, torque);
  expect_balance(recorder.rows.back().measurement, hertz.radius);
  double largest = 0;
  for (const ProfileRow &row : recorder.last_profile)
    if (row.pressure == row.pressure && row.r < 0.9 * hertz.radius)
      largest = std::max(largest, std::abs(row.pressure - hertz.pressure(row.r)) / hertz.peak);
  EXPECT_LT(largest, 0.03);
  EXPECT_NEAR(recorder.rows.back().measurement.contact_radius / hertz.radius, 1, 0.1); // of a node: a/16
  // The approach of a cap as high as 20 a is less than the half-space's by some a/(20 a).
  EXPECT_NEAR(is.approach() * is.sphere() / (hertz.radius * hertz.radius), 1, 0.1);
}

TEST_P(rigid_counterface, LubkinsTorque)
{
  constexpr double mu = 0.37;
  const double angle[3] = {0.079419, 0.225712, 0.469255}, reference[3] = {0.310527, 0.528576, 0.585543};
  CapOnPlane is;
  is.order = GetParam();
  is.level = is.order == 1 ? 2 : 1;
  is.bulk_over_shear = 1e3;
  std::vector<double> none;
  Problem first;
  Recorder recorded("");
  const Hertz before = is.run_to({}, 4, first, recorded, none); // N does not depend on friction's coefficient
  is.friction = {{mu}, {0}};
  std::vector<double> twists, torque;
  for (const double each : angle)
    twists.push_back(each * mu * before.N / (is.elastic().G * before.radius * before.radius));
  twists.push_back(10 * twists.back());
  Problem problem;
  Recorder recorder("");
  const Hertz hertz = is.run_to(twists, 8, problem, recorder, torque);
  ASSERT_EQ(torque.size(), 4u);
  EXPECT_NEAR(hertz.N / before.N, 1, 1e-3);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(torque[k] / (mu * hertz.N * hertz.radius) / reference[k], 1, 0.01) << k;
  EXPECT_NEAR(torque[3] / (mu * hertz.N * hertz.radius) / (3 * pi / 16), 1, 0.012);
}

TEST(rigid_counterface_stick, IsABond)
{
  constexpr double a = 7, height = 0.7, G = 0.6, strain = 1e-4;
  for (const auto &[bulk_over_shear, thin_disc] : {std::pair{1e2, 51.55}, {1e3, 125.13}}) {
    Scene scene = cylinder(a, height, neo_hookean(G, bulk_over_shear), 2, 40);
    scene.top = scene.bottom;
    scene = on_plane(scene);
    scene.friction = PolynomialFriction<double>{{100}, {0}};
    scene.schedule = schedule_from_twists({2}, {strain * height}, {0});
    const SolverOptions options(fixed_steps(2, 1e-12));
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    const Measurement &m = recorder.rows.back().measurement;
    const double E = m.normal_force / (pi * a * a * strain * G);
    expect_balance(m, a);
    EXPECT_GT(E / thin_disc, 1.00);
    EXPECT_LT(E / thin_disc, 1.05);
  }
}

} // namespace tribogel::test
