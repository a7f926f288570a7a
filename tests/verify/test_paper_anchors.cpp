/// What the paper prints of its own scene (Fig. 8 and text), and what follows from its model, on the default mesh's scene.
#include "scenes.hpp"

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
    EXPECT_NEAR(with.phases[k].measurement.normal_force / without.phases[k].measurement.normal_force, 1, 1e-4);
  const auto torque = [&](int k) { return with.phases[k].measurement.torque; };
  EXPECT_NEAR(torque(3) / torque(2), 10, 1e-4);
  EXPECT_NEAR(torque(4) / torque(3), 10, 1e-3);
}

} // namespace tribogel::test
