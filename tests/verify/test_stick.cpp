/// Coulomb friction mu = b0 under uniform pressure: two discs on lubricated plates, pressed and twisted.
/// Torsion of a cylinder gives a traction G_s psi r, which reaches b0 p first at the rim, at the twist
///
///     theta_slip = b0 p h / (G_s a)           (a, h: current radius and total height)
///
/// Below it everything sticks: T = k theta with k = G_s pi a^4/(2 h), no sliding and no creep however long
/// the hold. The mesh errs in T only because the node on the axis holds no torque, a share of (facet on the
/// axis)/a to the fourth. Far above it everything slides: T = 2/3 pi a^3 b0 p. Between, a ring slides that
/// grows from the rim. The numbers are those of scalar equations (uniform_compression.hpp); b0 is so small
/// that the twist's second order, about b0^2, is below the tolerances.
#include "tribogel/friction/polynomial.hpp"
#include "uniform_compression.hpp"

#include <algorithm>

namespace tribogel::test
{

namespace
{

constexpr double b0 = 3e-4;

struct Twisted {
  Problem problem;
  Recorder recorder{""};
  UniaxialState state;
  double radius, pressure, stiffness, slip_twist, full_torque;

  const Measurement &at_end_of_phase(std::size_t k) const
  {
    return recorder.phases[k].measurement;
  } ///< from 1
};

/// Compressed in phase 1, turned by `twist` times theta_slip in phase 2 (4 s), held to `end` in phase 3.
void twist_and_hold(Twisted &is, int order, double twist, double end, int elements = 5)
{
  const SolverOptions options(newton_tolerance(1e-12));
  const double compression = 0.08;
  Scene scene = lubricated_discs(7, 3.1, 2.3, order);
  scene.mesh.elements_radial = elements;
  scene.mesh.bottom_elements_radial = elements + elements / 2;
  scene.friction = PolynomialFriction<double>{{b0}, {0}};
  const UniaxialState state = uniaxial_state(scene.top.material.equilibrium, 1 - compression);
  const double a = scene.top.radius * state.lateral,
               h = (scene.top.height + scene.bottom.height) * state.axial;
  is.state = state;
  is.radius = a;
  is.pressure = state.pressure;
  is.stiffness = state.shear_stiffness() * std::numbers::pi / 2 * std::pow(a, 4) / h;
  is.slip_twist = b0 * state.pressure * h / (state.shear_stiffness() * a);
  is.full_torque = 2.0 / 3 * std::numbers::pi * std::pow(a, 3) * b0 * state.pressure;
  const double approach = compression * (scene.top.height + scene.bottom.height);
  scene.schedule = schedule_from_twists({3, 7, end}, {approach, approach, approach},
                                        {0, twist * is.slip_twist, twist * is.slip_twist});
  run(scene, is.problem, is.recorder);
  ASSERT_EQ(is.recorder.phases.size(), 3u);
}

} // namespace

TEST(stick, BelowTheLimitTheTorqueIsThatOfTorsionAndNothingCreeps)
{
  const double share = 0.8;
  for (int order : {1, 2}) {
    std::vector<double> error;
    for (int elements : {3, 6, 12}) {
      Twisted is;
      twist_and_hold(is, order, share, 1e5, elements);
      const double turned = is.at_end_of_phase(1).torque, held = is.at_end_of_phase(2).torque;
      error.push_back(turned / (is.stiffness * share * is.slip_twist) - 1);
      EXPECT_NEAR(held / turned, 1, 1e-11);
      int carrying = 0;
      double fastest = 0;
      for (const ProfileRow &row : is.recorder.last_profile) {
        if (std::isnan(row.pressure) || row.reference_z > 0) continue; // the wall stays open
        ++carrying;
        EXPECT_STREQ(row.status, "stick");
        fastest = std::max(fastest, row.sliding_velocity);
      }
      EXPECT_GE(carrying, 3);
      EXPECT_LE(fastest, 1e-14 * is.slip_twist * is.radius);
    }
    EXPECT_GE(std::log2(error[1] / error[2]), 4); // measured 4.5 and 5
    EXPECT_LE(std::abs(error[2]), 1e-4);
  }
}

TEST(stick, FarAboveTheLimitEverythingSlides)
{
  for (int order : {1, 2})
    for (double direction : {1.0, -1.0}) {
      Twisted is;
      twist_and_hold(is, order, 40 * direction, 11);
      EXPECT_NEAR(is.at_end_of_phase(1).torque / is.full_torque, direction, 1e-6);
      EXPECT_NEAR(is.at_end_of_phase(2).torque / is.full_torque, direction, 1e-6); // held: no unloading
    }
}

TEST(stick, SlidingStartsAtTheRim)
{
  for (int order : {1, 2}) {
    Twisted is;
    const double share = 1.25;
    twist_and_hold(is, order, share, 11);
    const double T = is.at_end_of_phase(1).torque;
    EXPECT_LT(T, is.full_torque);
    EXPECT_LT(T, 0.999 * is.stiffness * share * is.slip_twist);
    EXPECT_GT(T, is.stiffness * is.slip_twist); // torque at which the rim starts
    bool sliding = false;
    int stick = 0, slip = 0;
    double beyond = 0, short_of = 0;
    for (const ProfileRow &row : is.recorder.last_profile) {
      if (std::isnan(row.pressure)) continue;
      const bool at_limit = row.mu > b0 * (1 - 1e-9);
      beyond = std::max(beyond, row.mu / b0 - 1);
      if (sliding) short_of = std::max(short_of, 1 - row.mu / b0);
      sliding = sliding || at_limit;
      (at_limit ? slip : stick) += 1;
    }
    EXPECT_GE(stick, 2);
    EXPECT_GE(slip, 1);
    EXPECT_LE(beyond, 1e-9);
    EXPECT_LE(short_of, 1e-9); // outwards of the first sliding node all slide
  }
}

} // namespace tribogel::test
