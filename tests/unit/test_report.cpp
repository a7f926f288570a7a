// What a run says of itself before it begins. No PETSc.
#include "option_texts.hpp"
#include "options/report.hpp"

using namespace tribogel;

TEST(Report, says_what_is_solved)
{
  const std::string text = scene_report(scene_from_options({{"-top_bulk_modulus", "0.5"}}));
  for (const char *part : {"radius 10 mm", "G 1.387 MPa", "4.235 s", "mu = 0 + 0.0008 v", "143.2",
                           "159 turns", "10 mm/s", "warning: -top_bulk_modulus"})
    EXPECT_TRUE(contains(text, part)) << part << "\n" << text;
}

/// Each option that changes the numbers is in what the run says of itself.
TEST(Report, shows_what_is_not_as_usual)
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
