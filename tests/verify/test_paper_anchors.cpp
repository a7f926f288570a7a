/// What the paper says of its own scene, and what the default run owes its user. From the paper: Fig. 8 (the
/// bottom surface goes down by 0.31151 mm in the centre and 0.12338 mm at the edge of the patch), a contact
/// radius of about 10.9 mm, Fig. 6 (the axial force does not notice the friction; the torque of mu = b1 v
/// steps tenfold with the rate). The heights and the approach are calibrated to Fig. 8 (src/PAPER.md), so
/// these three numbers check the calibration and the mesh.
#include "scenes.hpp"

#include <algorithm>

namespace tribogel::test
{

TEST(paper_anchors, TorqueStepsTenfoldWithTheRateAndForceDoesNotNoticeFriction)
{
  Problem slippery, rough;
  Recorder without(""), with("");
  Scene scene = paper_scene(6);
  run(scene, rough, with);
  scene.friction = {};
  run(scene, slippery, without);
  ASSERT_EQ(with.phases.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(with.phases[k].measurement.normal_force / without.phases[k].measurement.normal_force, 1,
                1e-4);
  const auto torque = [&](int k) { return with.phases[k].measurement.torque; };
  EXPECT_NEAR(torque(3) / torque(2), 10, 1e-4);
  EXPECT_NEAR(torque(4) / torque(3), 10, 1e-2); // N grows a little with the torque at the fastest rate
  EXPECT_EQ(without.phases.back().measurement.torque, 0);
}

TEST(paper_anchors, DefaultRunMeetsFigure8InFewIterationsAndLongSteps)
{
  Problem problem;
  Recorder recorder("");
  run(paper_scene(MeshParameters{}.elements_radial), problem, recorder);
  ASSERT_EQ(recorder.phases.size(), 5u);
  const PhaseEnd &end = recorder.phases.back();
  EXPECT_NEAR(end.centre_displacement, 0.31151, 0.02 * 0.31151);
  EXPECT_NEAR(end.rim_displacement, 0.12338, 0.02 * 0.12338);
  EXPECT_GT(end.measurement.contact_radius, 10.8);
  EXPECT_LT(end.measurement.contact_radius, 11.0);
  double longest_in_hold = 0;
  PetscInt most = 0;
  for (const HistoryRow &row : recorder.rows) {
    if (row.phase == 2) longest_in_hold = std::max(longest_in_hold, row.step);
    most = std::max(most, row.report.newton_iterations);
  }
  EXPECT_GE(longest_in_hold, 300);
  EXPECT_LE(most, 12);
  int slipping =
      0; // once the gels' twist has settled, every point slides at the plate's rate times its radius
  for (const ProfileRow &row : recorder.last_profile)
    if (row.status == std::string("slip")) {
      ++slipping;
      EXPECT_NEAR(row.sliding_velocity / (end.rate * row.r), 1, 1e-6);
    }
  EXPECT_GE(slipping, 24); // every node but the one on the axis
  // (3.13) assumes a flat contact under uniform pressure: 0.5 % above the pressure-weighted mean here.
  EXPECT_NEAR(end.measurement.mu_apparent / end.measurement.mu_pressure_weighted, 1.005, 0.001);
}

} // namespace tribogel::test
