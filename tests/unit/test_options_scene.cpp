// Option texts -> Scene: defaults, combinations, refusals, warnings and notes. No PETSc.
#include "options/material_input.hpp"
#include "options/report.hpp"
#include "options/scene_input.hpp"
#include "options/stored_options.hpp"
#include "tribogel/material/relaxation.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace tribogel;

namespace
{

std::string refusal(const GivenOptions &given)
{
  try {
    scene_from_options(given);
  } catch (const UserError &error) {
    return error.text;
  }
  return {};
}

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

std::string joined(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines) text += line + "\n";
  return text;
}

std::string resolved(const SceneInput &input, const std::string &name)
{
  const auto found = std::find_if(input.options.begin(), input.options.end(),
                                  [&](const auto &o) { return o.first == name; });
  return found == input.options.end() ? "absent" : found->second;
}

/// Refused, and the line begins with the option and its value and says what is allowed.
void expect_refused(const std::string &name, const std::string &value, GivenOptions others = {})
{
  others[name] = value;
  const std::string text = refusal(others);
  const std::string head = value.empty() ? name + ": value missing" : name + " = " + value;
  EXPECT_TRUE(text.starts_with(head)) << name << " = " << value << " gave '" << text << "'";
  EXPECT_TRUE(contains(text, "allowed:")) << text;
}

} // namespace

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
  EXPECT_EQ(scene.output.directory, "tribogel-output");
  EXPECT_FALSE(scene.output.overwrite);
  EXPECT_FALSE(scene.output.error_estimate);
  EXPECT_TRUE(input.warnings.empty()) << joined(input.warnings);
  EXPECT_TRUE(input.notes.empty()) << joined(input.notes);
}

TEST(OptionsScene, derived_numbers_of_the_paper_material)
{
  const Scene scene = scene_from_options({}).scene;
  const MaxwellBranch<double> &branch = scene.top.material.branches[0];
  EXPECT_NEAR(shape_relaxation_time(branch), 4.5 / 1.0625, 1e-12);
  EXPECT_NEAR(volume_relaxation_time(branch), 1, 1e-12);
  Ogden<double> law{{3}, {2}, 5}; // G = 3, K = 5: nu = (15 - 6) / (2 (15 + 3))
  EXPECT_NEAR(initial_poisson_ratio(law), 0.25, 1e-15);
}

TEST(OptionsScene, each_option_reaches_its_place)
{
  const Scene scene = scene_from_options({{"-top_radius", "7"},
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
                                          {"-wall_time", "86000"}})
                          .scene;
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
  EXPECT_TRUE(scene.output.error_estimate);
  EXPECT_EQ(scene.output.directory, "here/there");
  EXPECT_TRUE(scene.output.overwrite);
  EXPECT_EQ(scene.output.checkpoint_every, 7.5);
  EXPECT_EQ(scene.output.wall_time, 86000);
  EXPECT_FALSE(scene.output.restart);
}

TEST(OptionsScene, a_restart_goes_on_where_the_run_is)
{
  const SceneInput input = scene_from_options({{"-restart", "runs/a"}, {"-output_directory", "runs/./a/"}});
  EXPECT_TRUE(input.scene.output.restart);
  EXPECT_EQ(input.scene.output.directory, "runs/a");
  EXPECT_EQ(resolved(input, "output_directory"), "runs/a");
}

TEST(OptionsScene, a_restart_takes_the_stored_scene_only)
{
  nlohmann::json stored;
  for (const auto &[name, text] :
       scene_from_options({{"-top_height", "4.10"}, {"-checkpoint_every", "9"}}).options)
    stored["resolved"]["-" + name] = text;
  const auto refusal_of = [&](const GivenOptions &given) -> std::string {
    try {
      expect_unchanged(scene_from_options(given), stored.dump());
    } catch (const UserError &error) {
      return error.text;
    }
    return {};
  };
  EXPECT_EQ(refusal_of({{"-top_height", "4.1"}, {"-checkpoint_every", "3"}, {"-wall_time", "5"}}), "");
  EXPECT_NE(
      refusal_of({{"-top_height", "4.2"}}).find("-top_height = 4.2: the run in tribogel-output has 4.10"),
      std::string::npos);
  EXPECT_NE(
      refusal_of(
          {{"-top_height", "4.1"}, {"-maxwell_integrator", "exponential_euler"}, {"-mesh_grading", "3"}})
          .find("-mesh_grading = 3"),
      std::string::npos);
}

TEST(OptionsScene, twists_are_angles_reached)
{
  const GivenOptions given{{"-schedule_end_times", "4,10"}, {"-schedule_twists", "0,1.5"}};
  const SceneInput input = scene_from_options(given);
  EXPECT_EQ(input.scene.schedule[0].rate, 0);
  EXPECT_EQ(input.scene.schedule[1].rate, 0.25);
  EXPECT_EQ(input.scene.schedule[1].end_rotation(), 1.5);
  EXPECT_EQ(input.scene.schedule[1].end_approach, 0.79); // the default, in each phase
  EXPECT_EQ(resolved(input, "schedule_twists"), "0,1.5");
  EXPECT_EQ(resolved(input, "schedule_rates"), "absent");
  EXPECT_EQ(resolved(input, "schedule_approach"), "0.79,0.79");
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

TEST(OptionsScene, refuses_steady_states_that_depend_on_the_way_there)
{
  const GivenOptions turning{{"-schedule_kind", "steady"},
                             {"-friction_coefficients", "0.1,8e-4"},
                             {"-schedule_rates", "0.01,0.01,0.01,0.1,1"}};
  EXPECT_EQ(scene_from_options(turning).scene.schedule_kind, ScheduleKind::steady);
  EXPECT_EQ(refusal({{"-schedule_kind", "steady"}}), ""); // rests, but without static friction
  expect_refused("-schedule_kind", "steady", {{"-friction_coefficients", "0.1,8e-4"}});
  EXPECT_TRUE(
      contains(refusal({{"-schedule_kind", "steady"}, {"-friction_coefficients", "0.1,8e-4"}}), "phase 1"));
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

TEST(OptionsScene, refuses_unphysical_materials)
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

TEST(OptionsScene, refuses_inconsistent_schedules)
{
  expect_refused("-schedule_end_times", "27,3600,3600,5400,6300");
  expect_refused("-schedule_end_times", "27,20,30,40,50");
  expect_refused("-schedule_end_times", "0,1,2,3,4");
  EXPECT_TRUE(contains(refusal({{"-schedule_end_times", "1,2"}}),
                       "-schedule_rates = 0,0,0.01,0.1,1 (default) has 5"));
  EXPECT_TRUE(contains(refusal({{"-schedule_approach", "0.5,0.6"}}), "equal lengths"));
  expect_refused("-schedule_approach", "0.79,0.79,0.79,0.79,8.4");
  EXPECT_EQ(refusal({{"-schedule_approach", "0.79,0.79,0.79,0.79,8.39"}}), "");
  EXPECT_EQ(refusal({{"-schedule_approach", "0.79,0.79,0.79,0.79,8.4"}, {"-initial_gap", "0.1"}}), "");
  expect_refused("-schedule_approach", "4,4,4,4,4", {{"-specimens", "bottom"}});
  expect_refused("-schedule_twists", "0,0,0,0,1", {{"-schedule_rates", "0,0,0,0,1"}});
}

TEST(OptionsScene, one_number_holds_for_all_phases)
{
  const SceneInput input = scene_from_options(
      {{"-schedule_end_times", "1,2,4"}, {"-schedule_approach", "0.108"}, {"-schedule_rates", "-0.5"}});
  ASSERT_EQ(input.scene.schedule.size(), 3u);
  for (const Phase &phase : input.scene.schedule) {
    EXPECT_EQ(phase.end_approach, 0.108);
    EXPECT_EQ(phase.rate, -0.5);
  }
  EXPECT_EQ(resolved(input, "schedule_approach"), "0.108,0.108,0.108");
  EXPECT_EQ(resolved(input, "schedule_rates"), "-0.5,-0.5,-0.5");
  const Schedule held =
      scene_from_options({{"-schedule_end_times", "2,3"}, {"-schedule_twists", "0.6"}}).scene.schedule;
  EXPECT_DOUBLE_EQ(held[0].rate, 0.3); // reached at the first phase's end
  EXPECT_EQ(held[1].rate, 0);
  const std::string wrong = refusal({{"-schedule_approach", "0.1,0.2"}});
  EXPECT_TRUE(contains(wrong, "has 2") && contains(wrong, "or one number for all phases")) << wrong;
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

TEST(OptionsScene, refuses_absurd_meshes_with_their_number_of_elements)
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

TEST(OptionsScene, further_branches_need_all_four_options)
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

TEST(OptionsScene, warns_of_suspicious_materials_and_goes_on)
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

TEST(OptionsScene, hyperelastic_and_frictionless_scenes_carry_nothing)
{
  const Scene scene =
      scene_from_options({{"-top_material", "hyperelastic"}, {"-friction_law", "none"}}).scene;
  EXPECT_TRUE(scene.top.material.branches.empty());
  EXPECT_EQ(scene.bottom.material.branches.size(), 1u);
  EXPECT_EQ(scene.friction.law(), nullptr);
}

TEST(OptionsScene, report_says_what_is_solved)
{
  const std::string text = scene_report(scene_from_options({{"-top_bulk_modulus", "0.5"}}));
  for (const char *part : {"radius 10 mm", "G 1.387 MPa", "4.235 s", "mu = 0 + 0.0008 v", "143.2",
                           "159 turns", "10 mm/s", "warning: -top_bulk_modulus"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
}

/// Each option that changes the numbers is in what the run says of itself.
TEST(OptionsScene, report_shows_what_is_not_as_usual)
{
  const auto shows = [](const GivenOptions &given, const std::string &part) {
    const std::string text = scene_report(scene_from_options(given));
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
    EXPECT_FALSE(contains(scene_report(scene_from_options({})), part)) << part;
  };
  shows({{"-model", "solid"}, {"-top_tilt", "0.013"}}, "inclined by 0.013 rad");
  shows({{"-model", "solid"}, {"-top_offset", "1.5,-0.25"}}, "x = 1.5 mm, y = -0.25 mm");
  shows({{"-plate_contact", "false"}}, "do not feel the plates");
  shows({{"-friction_speed_range", "0.01,7.5"}}, "found for 0.01 to 7.5 mm/s");
  shows({{"-friction_pressure_exponent", "0.7"}, {"-friction_pressure_floor", "3e-4"}},
        "mu p^0.7 (p in MPa, above 0.0003)");
  shows({{"-bottom_elements_radial", "7"}}, "bottom gel: 7");
  shows({{"-model", "solid"}, {"-contact_integration", "elements"}}, "Gauss points");
  shows({{"-maxwell_integrator", "exponential_euler"}}, "time rule exponential_euler");
  shows({{"-time_tolerance", "0.37"}}, "0.37 %");
  shows({{"-schedule_kind", "steady"}}, "steady states only");
  shows({{"-phase_end_tolerance", "0.02"}}, "less than 0.02 %");
  shows({{"-wall_time", "86000"}}, "stops after 8.6e+04 s");
  shows({{"-restart", "runs/a"}}, "continues the run in runs/a");
}
