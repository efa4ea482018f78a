// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost_driver.hpp"

#include <gtest/gtest.h>

#include "hil/traffic/ghost.hpp"
#include "hil/traffic/ghost_builder.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::traffic {
namespace {

constexpr double kRound_mps = 50.0, kCar_m = 4.9;

MatchTask attacker(double lead_m, bool pass_allowed) {
  return {.role = rules::Role::kAttacker,
          .pass_allowed = pass_allowed,
          .round_speed_mps = kRound_mps,
          .lead_m = lead_m,
          .length_m = kCar_m,
          .other_mps = kRound_mps,
          .is_other_inside = true};
}

MatchTask defender(double lead_m) {
  return {.role = rules::Role::kDefender,
          .round_speed_mps = kRound_mps,
          .lead_m = lead_m,
          .length_m = kCar_m,
          .other_mps = kRound_mps};
}

TEST(GhostDriver, PassesWithinItsRightsAtEveryLead) {
  for (double lead_m = -200.0; lead_m <= 200.0; lead_m += 0.5)
    for (const bool pass_allowed : {false, true}) {
      const MatchTask task = attacker(lead_m, pass_allowed);
      const DriverOrder order = order_of(Manner::kPass, Defence::kHold, task);
      const rules::Rights rights = rules::rights_of(
          {},
          {.role = task.role, .pass_allowed = pass_allowed, .lead_m = lead_m, .length_m = kCar_m});
      EXPECT_TRUE(rights.may_take_inside || !order.inside) << lead_m;
      if (!pass_allowed && lead_m > -20.0) {
        EXPECT_LT(order.speed_mps, kRound_mps) << lead_m;
      }
    }
}

TEST(GhostDriver, TrailsAtAGapThatItKeeps) {
  const double lead_m = -25.0 - kCar_m;
  EXPECT_NEAR(order_of(Manner::kPass, Defence::kHold, attacker(lead_m, false)).speed_mps,
              kRound_mps, 1e-9);
  EXPECT_GT(order_of(Manner::kPass, Defence::kHold, attacker(lead_m - 5.0, false)).speed_mps,
            kRound_mps);
  EXPECT_LT(order_of(Manner::kPass, Defence::kHold, attacker(lead_m + 5.0, false)).speed_mps,
            kRound_mps);
}

TEST(GhostDriver, BreaksExactlyTheRuleOfItsManner) {
  EXPECT_TRUE(order_of(Manner::kCutIn, Defence::kHold, attacker(kCar_m + 11.0, true)).inside);
  EXPECT_FALSE(order_of(Manner::kPass, Defence::kHold, attacker(kCar_m + 11.0, true)).inside);
  EXPECT_TRUE(order_of(Manner::kRam, Defence::kHold, attacker(-20.0, true)).inside);
  EXPECT_LT(order_of(Manner::kFollow, Defence::kHold, attacker(-20.0, true)).speed_mps, kRound_mps);
  EXPECT_FALSE(order_of(Manner::kOpenDoor, Defence::kHold, attacker(90.0, true)).inside);
  EXPECT_TRUE(order_of(Manner::kPass, Defence::kHold, attacker(90.0, true)).inside);
  EXPECT_GT(order_of(Manner::kEarly, Defence::kHold, attacker(-20.0, false)).speed_mps, kRound_mps);
  EXPECT_TRUE(order_of(Manner::kDecline, Defence::kHold, attacker(-20.0, true)).declines);
  EXPECT_FALSE(order_of(Manner::kDecline, Defence::kHold, attacker(-20.0, false)).declines);
}

TEST(GhostDriver, DefendsOnTheInsideAtTheRoundSpeed) {
  MatchTask task = defender(30.0);
  EXPECT_TRUE(order_of(Manner::kPass, Defence::kHold, task).inside);
  EXPECT_EQ(order_of(Manner::kPass, Defence::kHold, task).speed_mps, kRound_mps);
  task.pass_allowed = true;
  task.lead_m = 0.0;
  EXPECT_TRUE(order_of(Manner::kPass, Defence::kHold, task).inside);
  EXPECT_FALSE(order_of(Manner::kPass, Defence::kWide, task).inside);
  EXPECT_LT(order_of(Manner::kPass, Defence::kSlow, task).speed_mps, kRound_mps - 5.0);
}

// Whatever lanes the two are in, they are not in one while the defender gets by.
TEST(GhostDriver, LeavesALaneToACarThatGetsBy) {
  for (const bool first_inside : {false, true})
    for (const bool second_inside : {false, true}) {
      MatchTask falls_back = attacker(10.0, false), gets_by = defender(-10.0);
      falls_back.is_cautioned = true;
      falls_back.is_inside = gets_by.is_other_inside = first_inside;
      falls_back.is_other_inside = gets_by.is_inside = second_inside;
      const DriverOrder one = order_of(Manner::kPass, Defence::kHold, falls_back);
      const DriverOrder other = order_of(Manner::kPass, Defence::kHold, gets_by);
      EXPECT_NE(one.inside, other.inside);
      EXPECT_LT(one.speed_mps, other.speed_mps);
    }
}

TEST(GhostDriver, KeepsOutsideWhereItsLeadIsUnknown) {
  const DriverOrder order = order_of(Manner::kPass, Defence::kHold, attacker(kUnset, true));
  EXPECT_FALSE(order.inside);
  EXPECT_EQ(order.speed_mps, kRound_mps);
}

// A ghost obeys its orders within its limits: lane after 3 s, speed by accel_mps2.
TEST(GhostDriver, OrdersMoveAGhostWithLanesAndNoOther) {
  for (const bool has_lanes : {false, true}) {
    GhostPlan plan;
    plan.start_mps = 30.0, plan.speed.mps = 30.0, plan.line.offset_m = 3.0;
    if (has_lanes) plan.lanes = LanePlan{.inside_m = 3.0, .outside_m = -3.0};
    const auto ghost = build_ghost(plan, oval(), nullptr);
    ASSERT_TRUE(ghost) << to_string(ghost.error());
    GhostState state = begin(*ghost, oval(), Instant{});
    const Surroundings around{.order = GhostOrder{.inside = false, .speed_mps = 40.0}};
    for (Instant now = Instant{} + milliseconds(10); now <= Instant{} + seconds(5);
         now += milliseconds(10))
      state = step(*ghost, oval(), state, around, now);
    EXPECT_NEAR(state.speed_mps, has_lanes ? 40.0 : 30.0, 1e-9);
    EXPECT_NEAR(state.pose.n_m, has_lanes ? -3.0 : 3.0, 1e-9);
  }
}

TEST(GhostDriver, ALaneInAWallIsRefused) {
  GhostPlan plan;
  plan.start_mps = 30.0, plan.speed.mps = 30.0;
  plan.lanes = LanePlan{.inside_m = 3.0, .outside_m = -7.5};
  EXPECT_FALSE(build_ghost(plan, oval(), nullptr));
}

}  // namespace
}  // namespace pitwall::traffic
