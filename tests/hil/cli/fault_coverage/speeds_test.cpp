// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/speeds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "hil/bench/loading.hpp"

namespace pitwall::fault_coverage {
namespace {

scenario::Scenario racing() {
  scenario::Scenario out;
  out.name = "f01_x";
  out.duration = seconds(30);
  out.race_control = {
      {.at = seconds(9), .track = world::TrackFlag::kYellow, .round_target_speed_mph = 60},
      {.at = seconds(10), .track = world::TrackFlag::kGreen, .round_target_speed_mph = 147}};
  out.expect = {{.condition = {"speed_mps", grading::Op::kGreater, 30.0}},
                {.condition = {"speed_mps", grading::Op::kLess, 0.5}}};
  return out;
}

TEST(Speeds, ATwinHasNoGreenFlagAndDrivesOnMoreSlowly) {
  ASSERT_EQ(speed_of(racing()), Speed::kRacing);
  EXPECT_EQ(at_speed(racing(), Speed::kRacing)->name, "f01_x");
  const auto yellow = at_speed(racing(), Speed::kYellow);
  ASSERT_TRUE(yellow);
  EXPECT_EQ(yellow->name, "f01_x@yellow");
  EXPECT_EQ(speed_of(*yellow), Speed::kYellow);
  EXPECT_EQ(yellow->expect[0].condition.number, kYellowOn_mps);
  EXPECT_EQ(yellow->expect[1].condition.number, 0.5) << "to stand is the same at every speed";
  EXPECT_TRUE(yellow->operator_texts.empty());
  const auto walking = at_speed(racing(), Speed::kWalking);
  ASSERT_TRUE(walking);
  EXPECT_EQ(speed_of(*walking), Speed::kWalking);
  EXPECT_EQ(walking->expect[0].condition.number, kWalksOn_mps);
  EXPECT_TRUE(std::ranges::is_sorted(walking->operator_texts, {}, &scenario::OperatorText::at));
  EXPECT_FALSE(at_speed(*yellow, Speed::kRacing)) << "nothing is made faster";
}

TEST(Speeds, AScenarioForOneSpeedHasNoTwin) {
  EXPECT_EQ(group_of("f34_throttle_stuck_racing"), "f34_throttle_stuck");
  EXPECT_EQ(group_of("f01_frames_lost"), "f01_frames_lost");
  scenario::Scenario own = racing();
  own.name = "f34_throttle_stuck_racing";
  EXPECT_FALSE(at_speed(own, Speed::kYellow));
}

// At each of the three speeds every fault has a scenario, a twin, or a reason why not; and no
// reason stands for a scenario that there is none of.
TEST(Speeds, EveryFaultIsThereAtEachSpeedOrSaysWhyNot) {
  const std::string root = PITWALL_SOURCE_DIR;
  std::map<std::string, std::set<Speed>> there;
  for (const auto& entry : std::filesystem::directory_iterator(root + "/hil/scenarios/faults")) {
    const auto loaded = bench::load(entry.path().string(), root);
    ASSERT_TRUE(loaded) << entry.path();
    const std::string group{group_of(loaded->scenario.name)};
    for (const Speed speed : {Speed::kWalking, Speed::kYellow, Speed::kRacing})
      if (at_speed(loaded->scenario, speed)) there[group].insert(speed);
  }
  for (const auto& [group, speeds] : there)
    for (const Speed speed : {Speed::kWalking, Speed::kYellow, Speed::kRacing}) {
      const NotAtSpeed* why = not_at(group, speed);
      const bool own = why != nullptr && why->reason.starts_with("has a scenario of its own");
      const auto name = kSpeedNames[static_cast<std::size_t>(speed)];
      EXPECT_EQ(speeds.contains(speed), why == nullptr || own) << group << " at " << name;
    }
  for (const NotAtSpeed& row : all_not_at()) EXPECT_TRUE(there.contains(std::string(row.scenario)));
}

}  // namespace
}  // namespace pitwall::fault_coverage
