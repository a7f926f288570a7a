// Why a run is to end: requests, obstacles, and which of them counts.
#include "support/stop_wish.hpp"

#include <gtest/gtest.h>

using tribogel::StopWish;

TEST(StopWish, is_none_at_first)
{
  const StopWish stop;
  EXPECT_FALSE(stop.wanted() || stop.is_request() || stop.given_up());
  EXPECT_EQ(stop.reason(), "");
}

TEST(StopWish, a_request_lets_the_run_go_on_later)
{
  StopWish stop;
  stop.request("a signal");
  stop.request("another");
  EXPECT_TRUE(stop.wanted() && stop.is_request());
  EXPECT_FALSE(stop.given_up());
  EXPECT_EQ(stop.reason(), "another");
  stop.clear();
  EXPECT_FALSE(stop.wanted());
}

TEST(StopWish, an_obstacle_counts_more_than_a_request_whichever_came_first)
{
  for (const bool request_first : {true, false}) {
    StopWish stop;
    if (request_first) stop.request("a signal");
    stop.give_up("the disk is full");
    if (!request_first) stop.request("a signal");
    EXPECT_TRUE(stop.wanted() && stop.given_up());
    EXPECT_FALSE(stop.is_request());
    EXPECT_EQ(stop.reason(), "the disk is full");
  }
}

TEST(StopWish, tells_each_obstacle_once)
{
  StopWish stop;
  for (const char *why : {"no room", "mu < 0", "no room"}) stop.give_up(why);
  EXPECT_EQ(stop.reason(), "no room; mu < 0");
}
