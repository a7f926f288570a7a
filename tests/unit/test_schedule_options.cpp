// Options of the schedule -> phases: twists, one number for all, steady states; refusals. No PETSc.
#include "option_texts.hpp"

using namespace tribogel;

TEST(ScheduleOptions, twists_are_angles_reached)
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

TEST(ScheduleOptions, one_number_holds_for_all_phases)
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

TEST(ScheduleOptions, refuses_inconsistent_schedules)
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

TEST(ScheduleOptions, refuses_steady_states_that_depend_on_the_way_there)
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
