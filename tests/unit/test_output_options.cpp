// Options of the output, and of a run that goes on. No PETSc.
#include "option_texts.hpp"
#include "options/stored_options.hpp"

#include <nlohmann/json.hpp>

using namespace tribogel;

TEST(OutputOptions, a_restart_goes_on_where_the_run_is)
{
  const SceneInput input = scene_from_options({{"-restart", "runs/a"}, {"-output_directory", "runs/./a/"}});
  EXPECT_TRUE(input.output.restart);
  EXPECT_EQ(input.output.directory, "runs/a");
  EXPECT_EQ(resolved(input, "output_directory"), "runs/a");
}

TEST(OutputOptions, a_restart_takes_the_stored_scene_only)
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
