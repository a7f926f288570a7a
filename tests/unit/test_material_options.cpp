// Options of the materials -> Scene: refusals, Maxwell branches, warnings. No PETSc.
#include "option_texts.hpp"
#include "tribogel/material/relaxation.hpp"

using namespace tribogel;

TEST(MaterialOptions, derived_numbers_of_the_paper_material)
{
  const Scene scene = scene_from_options({}).scene;
  const MaxwellBranch<double> &branch = scene.top.material.branches[0];
  EXPECT_NEAR(shape_relaxation_time(branch), 4.5 / 1.0625, 1e-12);
  EXPECT_NEAR(volume_relaxation_time(branch), 1, 1e-12);
  Ogden<double> law{{3}, {2}, 5}; // G = 3, K = 5: nu = (15 - 6) / (2 (15 + 3))
  EXPECT_NEAR(initial_poisson_ratio(law), 0.25, 1e-15);
}

TEST(MaterialOptions, refuses_unphysical_materials)
{
  expect_refused("-top_ogden_moduli", "-0.75,0.45,0.18");
  expect_refused("-top_ogden_moduli", "0.75,0,0.18");
  expect_refused("-bottom_ogden_exponents", "1.3,0,5");
  expect_refused("-top_bulk_modulus", "0");
  expect_refused("-top_maxwell_bulk_modulus", "-200");
  expect_refused("-bottom_maxwell_viscosities", "4.5,0");
  expect_refused("-bottom_maxwell_viscosities", "4.5");
  expect_refused("-bottom_maxwell_viscosities", "4.5,2,3");
  EXPECT_TRUE(refusal({{"-top_ogden_moduli", "0.75,0.45"}})
                  .starts_with("-top_ogden_exponents = 1.3,2,5 (default) has 3"));
}

TEST(MaterialOptions, further_branches_need_all_four_options)
{
  GivenOptions given{{"-top_maxwell2_ogden_moduli", "0.3"},
                     {"-top_maxwell2_ogden_exponents", "2.5"},
                     {"-top_maxwell2_bulk_modulus", "60"}};
  EXPECT_TRUE(refusal(given).starts_with("-top_maxwell2_viscosities: value missing"));
  given["-top_maxwell2_viscosities"] = "30,70";
  const SceneInput input = scene_from_options(given);
  ASSERT_EQ(input.scene.top.material.branches.size(), 2u);
  EXPECT_EQ(input.scene.bottom.material.branches.size(), 1u);
  EXPECT_EQ(input.scene.top.material.branches[1].deviatoric_viscosity, 30);
  EXPECT_EQ(input.scene.top.material.branches[1].spring.exponents, std::vector<double>{2.5});
  EXPECT_EQ(resolved(input, "top_maxwell2_bulk_modulus"), "60");
}

TEST(MaterialOptions, warns_of_suspicious_materials_and_goes_on)
{
  const std::string auxetic = joined(scene_from_options({{"-top_bulk_modulus", "0.5"}}).warnings);
  EXPECT_TRUE(contains(auxetic, "-top_bulk_modulus = 0.5")) << auxetic;
  EXPECT_TRUE(contains(auxetic, "auxetic")) << auxetic;
  const std::string fast =
      joined(scene_from_options({{"-bottom_maxwell_viscosities", "4.5e-6,2e-4"}}).warnings);
  EXPECT_TRUE(contains(fast, "-bottom_maxwell_viscosities")) << fast;
  EXPECT_TRUE(contains(fast, "relaxation time")) << fast;
  EXPECT_TRUE(scene_from_options({{"-specimens", "bottom"}, {"-top_bulk_modulus", "0.5"}}).warnings.empty());
}

TEST(MaterialOptions, hyperelastic_and_frictionless_scenes_carry_nothing)
{
  const Scene scene =
      scene_from_options({{"-top_material", "hyperelastic"}, {"-friction_law", "none"}}).scene;
  EXPECT_TRUE(scene.top.material.branches.empty());
  EXPECT_EQ(scene.bottom.material.branches.size(), 1u);
  EXPECT_EQ(scene.friction.law(), nullptr);
}
