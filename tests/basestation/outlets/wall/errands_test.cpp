// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/errands.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::outlets::wall {
namespace {

const command::Person kAda{.console = 1, .name = "Ada"}, kBob{.console = 2, .name = "Bob"};

struct Bench {
  RadioRig rig;
  picture::Picture picture;
  picture::Watch watch;
  command::Audit audit;
  command::AuthorityTalk talk{rig.station->endpoint().authority(), audit};
  command::Desk desk{{}, audit};
  command::SettingsDesk settings{watch, audit, 0, {.most = 256.0, .now = 256.0}, {}};
  PeopleSaid said;
  ConsoleRoom room{"{}"};
  web::Tokens tokens;

  Result<bool, Problem> ask(const Request& request, const command::Person& by = kAda) {
    const ErrandParts parts{.picture = picture,
                            .watch = watch,
                            .audit = audit,
                            .talk = talk,
                            .desk = desk,
                            .settings = settings,
                            .said = said,
                            .room = room,
                            .tokens = tokens};
    return carry_out(request, parts, *rig.station, by, rig.now);
  }
};

// All that changes how the base judges is said by who may also command the car.
std::vector<Request> of_the_holder() {
  const alarms::AlarmIndex slip = *alarms::find_alarm("wheel_slip");
  AskEditAlarm alarm;
  alarm.edit.key = "wheel_slip";
  alarm.edit.setting = alarms::default_setting(slip);
  alarm.edit.setting.limit = 0.1;
  alarm.reason = "x";
  AskEditLimit limit;
  limit.edit.field = picture::field_id("electric.battery");
  limit.edit.limit.bad_low = 11.0;
  limit.reason = "x";
  return {AskExpect{.round_speed_mps = 51.4}, AskFuelLoaded{.litres = 40.0}, alarm, limit,
          AskEditBudget{.up_kbit_s = 100.0, .reason = "x"}};
}

TEST(Errands, WithoutTheAuthorityNothingIsSaidOrSet) {
  Bench bench;
  for (const Request& request : of_the_holder()) {
    const std::uint64_t lines = bench.audit.count();
    const auto done = bench.ask(request);
    ASSERT_FALSE(done) << request.index();
    EXPECT_EQ(done.error().what, "you do not hold the authority");
    EXPECT_EQ(bench.audit.count(), lines + 1) << "a refusal leaves its line, too";
  }
  EXPECT_TRUE(std::isnan(bench.watch.known().expected.round_speed_mps));
  EXPECT_EQ(bench.watch.known().expected.fuel_entries, 0u);
  EXPECT_EQ(bench.settings.revision(), 0u);
  EXPECT_EQ(bench.said.revision, 0u);
}

TEST(Errands, TheHolderSaysAndSets) {
  Bench bench;
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kTake}));
  for (const Request& request : of_the_holder()) {
    ASSERT_TRUE(bench.ask(request)) << request.index();
    EXPECT_FALSE(bench.ask(request, kBob)) << request.index();
  }
  EXPECT_EQ(bench.watch.known().expected.round_speed_mps, 51.4);
  EXPECT_EQ(bench.watch.known().expected.fuel_loaded_l, 40.0);
  EXPECT_EQ(bench.watch.known().expected.fuel_entries, 1u);
  EXPECT_EQ(bench.said.fuel_by, "Ada");
  EXPECT_EQ(bench.settings.revision(), 3u);
  EXPECT_EQ(bench.settings.budget().now, 100.0);
  ASSERT_TRUE(bench.ask(AskExpect{}));
  EXPECT_TRUE(std::isnan(bench.watch.known().expected.round_speed_mps));
  EXPECT_EQ(bench.watch.known().expected.fuel_loaded_l, 40.0) << "the other is kept";
}

TEST(Errands, AStopAsksForNothing) {
  Bench bench;
  ASSERT_TRUE(bench.ask(AskStop{.level = telemetry::StopLevel::kEmergency}, kBob));
  bench.rig.run(seconds(1));
  EXPECT_EQ(bench.rig.car->view(bench.rig.now).stop, telemetry::StopLevel::kEmergency);
}

TEST(Errands, WhatIsNotThereIsRefusedWithItsPlace) {
  Bench bench;
  EXPECT_EQ(bench.ask(AskStage{.name = "fly"}).error().place, "stage.name");
  EXPECT_EQ(bench.ask(AskReleaseStop{}).error().place, "release_stop");
  EXPECT_EQ(bench.ask(AskPlayback{}).error().place, "playback");
  EXPECT_FALSE(bench.ask(AskShelve{.alarm = 7, .minutes = 1.0, .reason = "x"}));
  EXPECT_FALSE(bench.ask(AskCancel{.ticket = 9}));
}

// Also without a desk: who wanted to start what is in the audit log.
TEST(Errands, AWishForTheBenchLeavesALine) {
  Bench bench;
  const AskBench start{{.start = true, .scenario = "red", .seed = 7}};
  const auto refused = bench.ask(start);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "bench");
  ASSERT_EQ(bench.audit.count(), 1U);
  EXPECT_EQ(bench.audit.lines().back().who, "Ada");
  EXPECT_EQ(bench.audit.lines().back().what, "bench: start red, lockstep, seed 7");
  EXPECT_TRUE(bench.audit.lines().back().result.starts_with("refused: "));
}

// The two consoles of a pit wall: asked, refused, asked again, granted; the epoch tells the car.
TEST(Errands, TwoConsolesHandTheAuthorityOver) {
  Bench bench;
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kTake}));
  EXPECT_FALSE(bench.ask(AskAuthority{.claim = Claim::kTake}, kBob));
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kRequest}, kBob));
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kRefuse}));
  EXPECT_EQ(bench.talk.holder(bench.rig.now), kAda.console);
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kRequest}, kBob));
  ASSERT_TRUE(bench.ask(AskAuthority{.claim = Claim::kGrant, .to = kBob.console}));
  EXPECT_EQ(bench.talk.holder(bench.rig.now), kBob.console);
  EXPECT_FALSE(bench.ask(AskEditBudget{.up_kbit_s = 90.0, .reason = "x"}));
  EXPECT_TRUE(bench.ask(AskEditBudget{.up_kbit_s = 90.0, .reason = "x"}, kBob));
}

}  // namespace
}  // namespace pitwall::outlets::wall
