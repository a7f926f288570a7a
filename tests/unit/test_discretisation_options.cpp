// How large a mesh may be. No PETSc.
#include "option_texts.hpp"
#include "options/discretisation_options.hpp"

using namespace tribogel;

TEST(DiscretisationOptions, refuses_absurd_meshes_with_their_number_of_elements)
{
  expect_refused("-elements_radial", "330000");
  EXPECT_TRUE(contains(refusal({{"-elements_radial", "330000"}}), "1.02e+11 elements"));
  EXPECT_NE(refusal({{"-top_radius", "1e-6"}}), ""); // by geometry: the bottom specimen would need 2e14
  EXPECT_EQ(refusal({{"-elements_radial", "500"}}), "");
  Scene scene;
  scene.top.radius = 10;
  scene.top.height = 4;
  scene.bottom.radius = 12;
  scene.bottom.height = 6;
  scene.mesh.elements_radial = 5;
  EXPECT_EQ(estimated_elements(scene), 5 * 2 + 6 * 3);
  scene.arrangement = Arrangement::single_gel;
  EXPECT_EQ(estimated_elements(scene), 5 * 3); // edge 12 / 5
  scene.mesh.refinements = 3;
  EXPECT_EQ(estimated_elements(scene), 40 * 20);
  EXPECT_TRUE(
      contains(refusal({{"-elements_radial", "330"}, {"-mesh_refinements", "10"}}), "1.07e+11 elements"));
}
