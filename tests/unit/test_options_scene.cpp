// Option texts -> Scene: defaults, that each option reaches its place, refusals, notes. No PETSc.
#include "option_texts.hpp"

using namespace tribogel;

TEST(OptionsScene, defaults_are_the_paper_scene)
{
  const SceneInput input = scene_from_options({});
  const Scene &scene = input.scene;
  EXPECT_TRUE(scene.has_top());
  EXPECT_EQ(scene.top.radius, 10);
  EXPECT_EQ(scene.top.height, 4.4);
  EXPECT_EQ(scene.bottom.radius, 12.5);
  EXPECT_EQ(scene.bottom.height, 4);
  EXPECT_EQ(scene.initial_gap, 0);
  for (const Specimen *specimen : {&scene.top, &scene.bottom}) {
    const Viscoelastic<double> &material = specimen->material;
    EXPECT_EQ(material.equilibrium.moduli, (std::vector<double>{0.75, 0.45, 0.18}));
    EXPECT_EQ(material.equilibrium.exponents, (std::vector<double>{1.3, 2, 5}));
    EXPECT_EQ(material.equilibrium.bulk_modulus, 200);
    ASSERT_EQ(material.branches.size(), 1u);
    EXPECT_EQ(material.branches[0].spring.moduli, (std::vector<double>{0.25, 0.45, 0.18}));
    EXPECT_EQ(material.branches[0].spring.exponents, (std::vector<double>{1.3, 2, 5}));
    EXPECT_EQ(material.branches[0].spring.bulk_modulus, 200);
    EXPECT_EQ(material.branches[0].deviatoric_viscosity, 4.5);
    EXPECT_EQ(material.branches[0].volumetric_viscosity, 200);
  }
  EXPECT_EQ(scene.friction.law()->values(), (LawValues{{0, 8e-4}, {0, 1}, {1}, {1e-5}}));
  ASSERT_EQ(scene.schedule.size(), 5u);
  EXPECT_EQ(scene.schedule[0].end_time, 27);
  EXPECT_EQ(scene.schedule[4].end_time, 6300);
  EXPECT_EQ(scene.schedule[4].rate, 1);
  for (const Phase &phase : scene.schedule) EXPECT_EQ(phase.end_approach, 0.79);
  EXPECT_EQ(scene.mesh.element_order, 2);
  EXPECT_EQ(scene.mesh.elements_radial, 12);
  EXPECT_EQ(scene.mesh.grading, 30);
  const Scene solid = scene_from_options({{"-model", "solid"}}).scene;
  EXPECT_EQ(solid.mesh.elements_radial, 3);
  EXPECT_EQ(solid.mesh.grading, 1);
  EXPECT_EQ(scene_from_options({{"-model", "solid"}, {"-elements_radial", "5"}}).scene.mesh.elements_radial,
            5);
  EXPECT_EQ(input.output.directory, "tribogel-output");
  EXPECT_FALSE(input.output.overwrite);
  EXPECT_FALSE(input.output.error_estimate);
  EXPECT_TRUE(input.warnings.empty()) << joined(input.warnings);
  EXPECT_TRUE(input.notes.empty()) << joined(input.notes);
}

TEST(OptionsScene, each_option_reaches_its_place)
{
  const SceneInput input = scene_from_options({{"-top_radius", "7"},
                                               {"-top_height", "3.1"},
                                               {"-bottom_radius", "8.5"},
                                               {"-bottom_height", "2.9"},
                                               {"-initial_gap", "0.25"},
                                               {"-top_ogden_moduli", "-1.5,2.5"},
                                               {"-top_ogden_exponents", "-2,3"},
                                               {"-top_bulk_modulus", "70"},
                                               {"-bottom_volumetric_law", "quadratic"},
                                               {"-bottom_maxwell_ogden_moduli", "0.6"},
                                               {"-bottom_maxwell_ogden_exponents", "2.2"},
                                               {"-bottom_maxwell_bulk_modulus", "90"},
                                               {"-bottom_maxwell_viscosities", "6,80"},
                                               {"-friction_coefficients", "0.3,0.02,0.004"},
                                               {"-friction_exponents", "0,0.5,1.5"},
                                               {"-friction_pressure_exponent", "0.7"},
                                               {"-friction_pressure_floor", "3e-4"},
                                               {"-schedule_end_times", "5,11"},
                                               {"-schedule_approach", "0.4,0.6"},
                                               {"-schedule_rates", "0.2,-0.3"},
                                               {"-element_order", "1"},
                                               {"-elements_radial", "9"},
                                               {"-mesh_grading", "3.5"},
                                               {"-mesh_refinements", "2"},
                                               {"-output_directory", "here/there"},
                                               {"-overwrite", ""},
                                               {"-error_estimate", "true"},
                                               {"-checkpoint_every", "7.5"},
                                               {"-wall_time", "86000"}});
  const Scene &scene = input.scene;
  EXPECT_EQ(scene.top.radius, 7);
  EXPECT_EQ(scene.top.height, 3.1);
  EXPECT_EQ(scene.bottom.radius, 8.5);
  EXPECT_EQ(scene.bottom.height, 2.9);
  EXPECT_EQ(scene.initial_gap, 0.25);
  EXPECT_EQ(scene.top.material.equilibrium.moduli, (std::vector<double>{-1.5, 2.5}));
  EXPECT_EQ(scene.top.material.equilibrium.exponents, (std::vector<double>{-2, 3}));
  EXPECT_EQ(scene.top.material.equilibrium.bulk_modulus, 70);
  EXPECT_EQ(scene.bottom.material.equilibrium.bulk_modulus, 200);
  EXPECT_EQ(scene.top.material.equilibrium.volumetric_law, VolumetricLaw::logarithmic);
  EXPECT_EQ(scene.bottom.material.equilibrium.volumetric_law, VolumetricLaw::quadratic);
  EXPECT_EQ(scene.bottom.material.branches[0].spring.volumetric_law, VolumetricLaw::quadratic);
  EXPECT_EQ(scene.bottom.material.branches[0].spring.moduli, std::vector<double>{0.6});
  EXPECT_EQ(scene.bottom.material.branches[0].spring.exponents, std::vector<double>{2.2});
  EXPECT_EQ(scene.bottom.material.branches[0].spring.bulk_modulus, 90);
  EXPECT_EQ(scene.bottom.material.branches[0].deviatoric_viscosity, 6);
  EXPECT_EQ(scene.bottom.material.branches[0].volumetric_viscosity, 80);
  EXPECT_EQ(scene.friction.law()->values(), (LawValues{{0.3, 0.02, 0.004}, {0, 0.5, 1.5}, {0.7}, {3e-4}}));
  ASSERT_EQ(scene.schedule.size(), 2u);
  EXPECT_EQ(scene.schedule[1].start_time, 5);
  EXPECT_EQ(scene.schedule[1].end_approach, 0.6);
  EXPECT_EQ(scene.schedule[1].rate, -0.3);
  EXPECT_EQ(scene.mesh.element_order, 1);
  EXPECT_EQ(scene.mesh.elements_radial, 9);
  EXPECT_EQ(scene.mesh.grading, 3.5);
  EXPECT_EQ(scene.mesh.refinements, 2);
  EXPECT_TRUE(input.output.error_estimate);
  EXPECT_EQ(input.output.directory, "here/there");
  EXPECT_TRUE(input.output.overwrite);
  EXPECT_EQ(input.output.checkpoint_every, 7.5);
  EXPECT_EQ(input.output.wall_time, 86000);
  EXPECT_FALSE(input.output.restart);
}

TEST(OptionsScene, resolves_every_option_once)
{
  const SceneInput input = scene_from_options({{"-top_radius", "9"}, {"-overwrite", ""}});
  EXPECT_EQ(resolved(input, "top_radius"), "9");
  EXPECT_EQ(resolved(input, "bottom_radius"), "12.5");
  EXPECT_EQ(resolved(input, "overwrite"), "true");
  EXPECT_EQ(resolved(input, "schedule_rates"), "0,0,0.01,0.1,1");
  EXPECT_EQ(resolved(input, "schedule_twists"), "absent");
  for (const auto &[name, text] : input.options)
    EXPECT_EQ(std::count_if(input.options.begin(), input.options.end(),
                            [&](const auto &o) { return o.first == name; }),
              1)
        << name;
}

TEST(OptionsScene, refuses_numbers_out_of_range)
{
  expect_refused("-top_height", "0");
  expect_refused("-top_height", "-3");
  expect_refused("-bottom_radius", "nan");
  expect_refused("-bottom_radius", "");
  expect_refused("-top_radius", "12.6"); // larger than the bottom one
  expect_refused("-initial_gap", "-0.1");
  expect_refused("-element_order", "3");
  expect_refused("-element_order", "1.0");
  expect_refused("-elements_radial", "0");
  expect_refused("-elements_radial", "99999999999999999999");
  expect_refused("-mesh_grading", "0.9");
  expect_refused("-overwrite", "results");
  expect_refused("-output_directory", "");
  EXPECT_EQ(refusal({{"-top_radius", "12.5"}}), ""); // equal radii may be
}

TEST(OptionsScene, refuses_unknown_words)
{
  expect_refused("-model", "spherical");
  expect_refused("-task", "identify");
  expect_refused("-specimens", "top");
  expect_refused("-schedule_kind", "periodic");
  expect_refused("-contact_integration", "elements");
  expect_refused("-maxwell_integrator", "bdf2");
  expect_refused("-time_tolerance", "0");
  expect_refused("-top_volumetric_law", "printed");
  expect_refused("-friction_law", "polynomal");
  EXPECT_TRUE(contains(refusal({{"-friction_law", "polynomal"}}), "did you mean polynomial?"));
}

TEST(OptionsScene, wrong_values_are_refused_even_where_they_have_no_effect)
{
  expect_refused("-top_maxwell_viscosities", "4.5,-1", {{"-top_material", "hyperelastic"}});
  expect_refused("-top_height", "0", {{"-specimens", "bottom"}});
  expect_refused("-friction_coefficients", "0,,1", {{"-friction_law", "none"}});
  expect_refused("-friction_speed_range", "2,1", {{"-friction_law", "none"}});
  expect_refused("-friction_speed_range", "2,1", {{"-specimens", "bottom"}});
}

TEST(OptionsScene, refuses_friction_the_program_cannot_do)
{
  expect_refused("-friction_exponents", "-1,1");
  expect_refused("-friction_pressure_exponent", "-0.1");
  expect_refused("-friction_pressure_exponent", "1.1");
  expect_refused("-friction_pressure_floor", "0");
  expect_refused("-friction_coefficients", "-0.1,8e-4"); // negative at rest
  EXPECT_TRUE(contains(refusal({{"-friction_coefficients", "1,2,3"}}), "equal lengths"));
  const std::string falling =
      refusal({{"-friction_coefficients", "1,-0.2"}, {"-friction_exponents", "0,0.5"}});
  EXPECT_TRUE(contains(falling, "-friction_coefficients = 1,-0.2: -0.2 with exponent 0.5")) << falling;
}

TEST(OptionsScene, refusals_show_the_way_out)
{
  const std::string wider = refusal({{"-top_radius", "13"}});
  EXPECT_TRUE(contains(wider, "exchange the two")) << wider;
  const std::string minus = refusal({{"-schedule_rates", "0,0,0,0,\xE2\x88\x92"
                                                         "1"}});
  EXPECT_TRUE(contains(minus, "it holds a minus sign (U+2212)")) << minus;
  const std::string curly = refusal({{"-model", "\xE2\x80\x9Csolid\xE2\x80\x9D"}});
  EXPECT_TRUE(contains(curly, "it holds a typographic quotation mark (U+201C)")) << curly;
}

TEST(OptionsScene, notes_options_without_effect)
{
  const std::string alone = joined(
      scene_from_options({{"-specimens", "bottom"}, {"-friction_coefficients", "1,2"}, {"-top_radius", "3"}})
          .notes);
  EXPECT_TRUE(contains(alone, "-friction_coefficients, -top_radius")) << alone;
  const std::string stiff = joined(
      scene_from_options({{"-top_material", "hyperelastic"}, {"-top_maxwell_viscosities", "4,5"}}).notes);
  EXPECT_TRUE(contains(stiff, "-top_maxwell_viscosities")) << stiff;
  const std::string smooth =
      joined(scene_from_options({{"-friction_law", "none"}, {"-friction_exponents", "0,1"}}).notes);
  EXPECT_TRUE(contains(smooth, "-friction_exponents")) << smooth;
  EXPECT_TRUE(
      contains(joined(scene_from_options({{"-friction_pressure_floor", "1e-4"}}).notes), "pressure_floor"));
  const std::string apart = joined(scene_from_options({{"-initial_gap", "2"}}).notes);
  EXPECT_TRUE(contains(apart, "never pressed")) << apart;
  const std::string weak = joined(scene_from_options({{"-friction_coefficients", "0.1,-1e-3"}}).notes);
  EXPECT_TRUE(contains(weak, "weakens")) << weak;
}
