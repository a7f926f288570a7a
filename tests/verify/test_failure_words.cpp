/// What the program says of the place where it cannot go on.
#include "scenes.hpp"

namespace tribogel::test
{

namespace
{

std::string words(const Scene &scene, int body, std::array<double, 3> X, double compression = 0.13)
{
  return describe_end(scene, {body, X}, compression);
}

void expect_part(const std::string &text, const std::string &part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nhas no: " << part;
}

} // namespace

TEST(failure_words, NameThePartOfTheGel)
{
  const Scene scene = paper_scene(12);
  expect_part(words(scene, top_body, {9.97, 4.28, 0}), "rim where the top gel is bonded to its plate");
  expect_part(words(scene, bottom_body, {12.3, -3.9, 0}), "rim where the bottom gel is bonded to its plate");
  expect_part(words(scene, top_body, {9.94, 0, 0}), "lower edge of the top gel");
  expect_part(words(scene, bottom_body, {12.4, -0.1, 0}), "upper edge of the bottom gel");
  expect_part(words(scene, bottom_body, {10.05, -0.17, 0}), "contact face of the bottom gel");
  expect_part(words(scene, top_body, {0, 0, 0}), "contact face of the top gel");
  expect_part(words(scene, top_body, {10, 2.2, 0}), "side wall of the top gel");
  expect_part(words(scene, top_body, {3, 2.2, 0}), "inside the top gel");
  expect_part(words(scene, top_body, {9.94, 0, 0}), "rolls over and folds");
  expect_part(describe_end(scene, {top_body, {9.94, 0, 0}, false}, 0.13),
              "side wall, which may be about to fold;");
  expect_part(words(scene, top_body, {9.94, 0, 0}), "compressed by 13 % of their height");
  expect_part(words(scene, top_body, {9.94, 0, 0}), "What may help: less compression");
  EXPECT_EQ(words(scene, top_body, {9.94, 0, 0}, 0).find("compressed"), std::string::npos);
}

/// The gel's edges move with it: a gap lifts the top one; a thin one's are coarse; in space they are circles.
TEST(failure_words, FollowTheScene)
{
  Scene scene = paper_scene(12);
  scene.initial_gap = 2;
  expect_part(words(scene, top_body, {9.94, 2, 0}), "lower edge of the top gel");
  scene = paper_scene(12);
  scene.top.height = scene.bottom.height = 0.5;
  expect_part(words(scene, top_body, {9.72762, 0, 0}), "lower edge of the top gel");
  expect_part(words(scene, bottom_body, {9.47442, -0.125, 0}), "contact face of the bottom gel");
  expect_part(words(scene, top_body, {9.72762, 0, 0}), "(-elements_radial 40)"); // 0.25 mm each
  scene.mesh.elements_radial = 40;
  EXPECT_EQ(words(scene, top_body, {9.72762, 0, 0}).find("-elements_radial"), std::string::npos);
  scene.mesh.elements_radial = 12;
  scene.model = Model::solid;
  expect_part(words(scene, top_body, {0, -9.9, 0.5}), "rim where the top gel is bonded to its plate");
  scene.round = false; // its walls are elsewhere
  EXPECT_EQ(words(scene, top_body, {0, -9.9, 0.5}), "");
  scene = paper_scene(12);
  scene.arrangement = Arrangement::single_gel;
  expect_part(words(scene, bottom_body, {12.4, -0.1, 0}), "rim where the bottom gel is bonded to its plate");
}

} // namespace tribogel::test
