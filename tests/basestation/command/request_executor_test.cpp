// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/request_executor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::command {
namespace {

const Person kAda{.console = 1, .name = "Ada"}, kBob{.console = 2, .name = "Bob"};

struct Bench {
  RadioRig rig;
  state::VehicleState vehicle;
  alarms::Evaluator evaluator;
  RequestExecutor executor{
      {.budget = {.most = 256.0, .now = 256.0}}, rig.station->endpoint(), vehicle, evaluator};

  Result<bool, Problem> ask(const Request& request, const Person& by = kAda) {
    return executor.execute(request, by, rig.now);
  }
};

TEST(RequestExecutor, TheFuelThatWasEnteredIsForTheCarToo) {
  Bench bench;
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kTake}));
  ASSERT_TRUE(bench.ask(ReportFuel{.litres = 40.0}));
  ASSERT_EQ(bench.executor.queue().tickets().size(), 1u);
  const telemetry::Command& issued = bench.executor.queue().tickets().front().command;
  EXPECT_EQ(issued.type, telemetry::CommandType::kFuelEntered);
  EXPECT_EQ(issued.argument, 40.0);
  EXPECT_EQ(bench.evaluator.known().expected.fuel_loaded_l, 40.0)
      << "whether the car heard it or not: here it has no link";
  EXPECT_FALSE(bench.ask(IssueCommand{.type = telemetry::CommandType::kFuelEntered, .argument = 9}))
      << "nothing was said: the link's gate";
  EXPECT_EQ(bench.evaluator.known().expected.fuel_loaded_l, 40.0);
}

// All that changes how the base judges is said by who may also command the car.
std::vector<Request> of_the_holder() {
  const alarms::AlarmIndex slip = *alarms::find_alarm("wheel_slip");
  EditAlarm alarm;
  alarm.edit.key = "wheel_slip";
  alarm.edit.setting = alarms::default_setting(slip);
  alarm.edit.setting.limit = 0.1;
  alarm.reason = "x";
  EditLimit limit;
  limit.edit.field = state::field_id("electric.battery");
  limit.edit.limit.bad_low = 11.0;
  limit.reason = "x";
  return {ExpectRoundSpeed{.speed_mps = 51.4}, ReportFuel{.litres = 40.0}, alarm, limit,
          EditBudget{.up_kbit_s = 100.0, .reason = "x"}};
}

TEST(RequestExecutor, WithoutTheAuthorityNothingIsSaidOrSet) {
  Bench bench;
  for (const Request& request : of_the_holder()) {
    const std::uint64_t lines = bench.executor.audit().count();
    const auto done = bench.ask(request);
    ASSERT_FALSE(done) << request.index();
    EXPECT_EQ(done.error().what, "you do not hold the authority");
    EXPECT_EQ(bench.executor.audit().count(), lines + 1) << "a refusal leaves its line, too";
  }
  EXPECT_TRUE(std::isnan(bench.evaluator.known().expected.round_speed_mps));
  EXPECT_EQ(bench.evaluator.known().expected.fuel_entries, 0u);
  EXPECT_EQ(bench.executor.settings().revision(), 0u);
  EXPECT_EQ(bench.executor.entries().revision, 0u);
}

TEST(RequestExecutor, TheHolderSaysAndSets) {
  Bench bench;
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kTake}));
  for (const Request& request : of_the_holder()) {
    ASSERT_TRUE(bench.ask(request)) << request.index();
    EXPECT_FALSE(bench.ask(request, kBob)) << request.index();
  }
  EXPECT_EQ(bench.evaluator.known().expected.round_speed_mps, 51.4);
  EXPECT_EQ(bench.evaluator.known().expected.fuel_loaded_l, 40.0);
  EXPECT_EQ(bench.evaluator.known().expected.fuel_entries, 1u);
  EXPECT_EQ(bench.executor.entries().fuel_by, "Ada");
  EXPECT_EQ(bench.executor.settings().revision(), 3u);
  EXPECT_EQ(bench.executor.settings().budget().now, 100.0);
  ASSERT_TRUE(bench.ask(ExpectRoundSpeed{}));
  EXPECT_TRUE(std::isnan(bench.evaluator.known().expected.round_speed_mps));
  EXPECT_EQ(bench.evaluator.known().expected.fuel_loaded_l, 40.0) << "the other is kept";
}

TEST(RequestExecutor, AStopAsksForNothing) {
  Bench bench;
  ASSERT_TRUE(bench.ask(Stop{.level = telemetry::StopLevel::kEmergency}, kBob));
  bench.rig.run(seconds(1));
  EXPECT_EQ(bench.rig.car->view(bench.rig.now).stop, telemetry::StopLevel::kEmergency);
}

TEST(RequestExecutor, WhatIsNotThereIsRefusedWithItsPlace) {
  Bench bench;
  EXPECT_EQ(bench.ask(ReleaseStop{}).error().place, "release_stop");
  EXPECT_FALSE(bench.ask(ShelveAlarm{.alarm = 7, .length = seconds(60), .reason = "x"}));
  EXPECT_FALSE(bench.ask(CancelTicket{.ticket = 9}));
}

// The two consoles of a pit wall: asked, refused, asked again, granted; the epoch tells the car.
TEST(RequestExecutor, TwoConsolesHandTheAuthorityOver) {
  Bench bench;
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kTake}));
  EXPECT_FALSE(bench.ask(ClaimAuthority{.claim = Claim::kTake}, kBob));
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kRequest}, kBob));
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kRefuse}));
  EXPECT_EQ(bench.executor.authority().holder(bench.rig.now), kAda.console);
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kRequest}, kBob));
  ASSERT_TRUE(bench.ask(ClaimAuthority{.claim = Claim::kGrant}));
  EXPECT_EQ(bench.executor.authority().holder(bench.rig.now), kBob.console);
  EXPECT_FALSE(bench.ask(EditBudget{.up_kbit_s = 90.0, .reason = "x"}));
  EXPECT_TRUE(bench.ask(EditBudget{.up_kbit_s = 90.0, .reason = "x"}, kBob));
}

}  // namespace
}  // namespace pitwall::command
