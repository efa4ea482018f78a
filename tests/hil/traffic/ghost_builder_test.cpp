// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost_builder.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::traffic {
namespace {

GhostPlan good() {
  GhostPlan plan;
  plan.speed.mps = 50.0;
  plan.place = "s.yaml:9:5";
  return plan;
}

void expect_refused(const GhostPlan& plan, const std::string& what,
                    const world::RacelineBank* lines = &bank()) {
  const auto ghost = build_ghost(plan, oval(), lines);
  ASSERT_FALSE(ghost) << what;
  EXPECT_NE(to_string(ghost.error()).find(what), std::string::npos) << to_string(ghost.error());
  EXPECT_EQ(ghost.error().place.substr(0, 6), "s.yaml");
}

TEST(GhostBuilder, RefusesALineThatItCannotFollow) {
  EXPECT_TRUE(build_ghost(good(), oval(), nullptr));
  GhostPlan plan = good();
  plan.line.name = "swing";
  EXPECT_TRUE(build_ghost(plan, oval(), &bank()));
  expect_refused(plan, "names no bank", nullptr);
  plan.line.name = "apex";
  expect_refused(plan, "\"apex\" is not in oval.json");
  plan.line.name = "pit";
  expect_refused(plan, "pit lane");
  plan = good();
  plan.line.offset_m = 7.5;
  expect_refused(plan, "touches a wall");
  plan.line.offset_m = 6.5;
  EXPECT_TRUE(build_ghost(plan, oval(), nullptr));
  plan.drift = {.sigma_m = 0.3, .correlation_s = 10.0, .most_m = 1.0};
  expect_refused(plan, "touches a wall");
}

TEST(GhostBuilder, RefusesAStartOrADriftThatCannotBe) {
  GhostPlan plan = good();
  plan.start_n_m = -7.5;
  expect_refused(plan, "start.n_m puts the car into a wall");
  plan = good();
  plan.start_s_m = 9'000.0;
  expect_refused(plan, "start.s_m");
  plan = good();
  plan.drift = {.sigma_m = 0.3, .correlation_s = 2.0, .most_m = 0.5};
  expect_refused(plan, "the drift needs more");
}

TEST(GhostBuilder, RefusesSpeedsThatDoNotExist) {
  GhostPlan plan = good();
  plan.speed = {.lap_share = 0.9};
  expect_refused(plan, "lap_share");
  plan.line.name = "plain";
  expect_refused(plan, "lap_share");
  plan.line.name = "swing";
  EXPECT_TRUE(build_ghost(plan, oval(), &bank()));
  plan = good();
  plan.speed = {.by_station = {{10.0, 30.0}, {9'000.0, 30.0}}};
  expect_refused(plan, "station of the speeds");
}

TEST(GhostBuilder, RefusesEntriesOfTheScriptWithTheirPlace) {
  const auto with = [](const ScriptPlan& entry) {
    GhostPlan plan = good();
    plan.script.push_back(entry);
    plan.script.back().place = "s.yaml:12:9";
    return plan;
  };
  const auto place_of = [](const GhostPlan& plan) {
    return build_ghost(plan, oval(), &bank()).error().place;
  };
  const ScriptPlan spin{.value = 1.0, .action = Action::kSpin, .decel_mps2 = 5.0, .turn_rad = 3.0};
  ScriptPlan entry{.trigger = Trigger::kStation, .value = 9'000.0, .action = Action::kStand};
  expect_refused(with(entry), "beyond the end of the track");
  EXPECT_EQ(place_of(with(entry)), "s.yaml:12:9");
  entry = {.value = 1.0, .action = Action::kBrake, .decel_mps2 = 9.0};
  expect_refused(with(entry), "brake_mps2");
  entry = {.value = 1.0, .action = Action::kLine, .line = {.name = "apex"}, .over_s = 2.0};
  expect_refused(with(entry), "apex");
  entry = {.value = 1.0, .action = Action::kSpeed, .speed = {.lap_share = 1.0}};
  expect_refused(with(entry), "lap_share");
  GhostPlan plan = with(spin);
  EXPECT_TRUE(build_ghost(plan, oval(), &bank()));
  plan.script.push_back(spin);
  plan.script.back().place = "s.yaml:13:9";
  expect_refused(plan, "nothing can follow a spin");
  // The lap of a line goes with its speed profile.
  plan = with({.value = 1.0, .action = Action::kLine, .line = {.name = "plain"}, .over_s = 2.0});
  plan.line.name = "swing";
  plan.speed = {.lap_share = 1.0};
  expect_refused(plan, "lap_share");
  plan = good();
  plan.script.assign(kScriptMost + 1,
                     {.value = 1.0, .action = Action::kStand, .place = "s.yaml:1:1"});
  expect_refused(plan, "too long");
}

}  // namespace
}  // namespace pitwall::traffic
