// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/stop_episode.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/command/people.hpp"
#include "tests/basestation/healthy_race.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::command {
namespace {

using enum RecoveryStep;
using telemetry::field;

// Values of telemetry labels.
constexpr double kDisarmed = 0.0, kStandby = 1.0, kDriving = 2.0, kControlled = 3.0, kHalted = 5.0,
                 kDeadReckoning = 23.0, kOperatorStop = 8.0;

struct StopPit {
  HealthyRace wall;
  RadioRig radio;
  Audit audit;
  CommandQueue queue{{}, false, audit};
  std::deque<telemetry::Event> events;
  telemetry::HolderId holder = kAda.console;
  StopEpisode episode;

  StopPit() {
    wall.set(field("mode.first_stop_cause"), 0.0);
    wall.set(field("mode.stop_challenge"), 0.0);
    run(seconds(3));
  }
  void run(Duration length) {
    for (const Instant end = wall.now + length; wall.now < end;) {
      wall.run(milliseconds(100));
      episode.advance({{wall.reported.vehicle, wall.evaluator, holder, wall.now}, queue, events});
    }
  }
  void mode(double mode) {
    wall.set(field("mode.mode"), mode);
    run(milliseconds(300));
  }
  void latch(double level, double challenge) {
    wall.set(field("mode.stop_latch"), level);
    wall.set(field("mode.stop_challenge"), challenge);
    run(milliseconds(300));
  }
  void stand() {
    wall.set(field("ego.vx"), 0.0);
    run(milliseconds(300));
  }
  void on_alarms(bool reset) {
    alarms::Evaluator& evaluator = wall.evaluator;
    for (const alarms::ListedAlarm& alarm : evaluator.alarms().active()) {
      using Kind = alarms::AlarmAction::Kind;
      const auto kind = reset ? Kind::kReset : Kind::kAcknowledge;
      (void)evaluator.take(
          alarms::AlarmAction{.kind = kind, .alarm = alarm.id, .by = "Ada", .reason = {}});
    }
    run(milliseconds(300));
  }
  const RecoveryState& step(RecoveryStep which) const {
    return episode.now()->steps.at(static_cast<std::size_t>(which));
  }
  // "d" done, "p" possible, "-" neither, in their order.
  std::string steps() const {
    if (!episode.now()) return "none";
    std::string text;
    for (const RecoveryState& step : episode.now()->steps) {
      EXPECT_TRUE(step.done || step.possible || !step.why.empty());
      text += step.done ? "d" : step.possible ? "p" : "-";
    }
    return text;
  }
};

TEST(StopEpisode, ACarThatDrivesHasNone) {
  StopPit pit;
  EXPECT_EQ(pit.steps(), "none");
  pit.mode(kDisarmed);
  EXPECT_EQ(pit.steps(), "none") << "disarmed without a stop";
}

TEST(StopEpisode, TheWayBackAfterAPressGoesStepByStep) {
  StopPit pit;
  pit.queue.stop(telemetry::StopLevel::kControlled, telemetry::StopReason::kOperator, kAda,
                 pit.wall.now, pit.radio.station->endpoint());
  pit.wall.set(field("mode.first_stop_cause"), kOperatorStop);
  pit.wall.set(field("mode.mode"), kControlled);
  pit.latch(1.0, 4711.0);
  ASSERT_EQ(pit.steps(), "-p--");
  const StoppedCar& stopped = *pit.episode.now();
  EXPECT_EQ(stopped.level, "controlled stop");
  EXPECT_EQ(stopped.cause, "operator: stop");
  EXPECT_EQ(stopped.by, "Ada");
  EXPECT_TRUE(stopped.latched);
  ASSERT_TRUE(stopped.since);
  EXPECT_NEAR((pit.wall.now - *stopped.since).seconds(), 0.3, 0.15);
  EXPECT_NE(pit.step(kRelease).why.find("standing: 50.0 m/s"), std::string::npos)
      << pit.step(kRelease).why;
  pit.stand();
  pit.mode(kHalted);
  EXPECT_EQ(pit.steps(), "pp--");
  EXPECT_EQ(pit.step(kReset).why, "release the stop first");
  pit.latch(0.0, 0.0);
  EXPECT_EQ(pit.steps(), "dp--");
  EXPECT_EQ(pit.step(kReset).why, "acknowledge the alarm first");
  pit.on_alarms(false);
  EXPECT_EQ(pit.steps(), "ddp-");
  EXPECT_EQ(pit.step(kArm).why, "reset the car first");
  pit.on_alarms(true);
  pit.wall.set(field("mode.first_stop_cause"), 0.0);  // the car forgets it
  pit.mode(kDisarmed);
  EXPECT_EQ(pit.steps(), "dddp") << pit.step(kArm).why;
  EXPECT_EQ(pit.step(kArm).why, "");
  pit.wall.set(field("faults.now"), 16.0 + 8192.0);
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.step(kArm).why,
            "the car reports: drive-by-wire: emergency brake, drive-by-wire: does not hear us");
  EXPECT_TRUE(pit.step(kArm).possible) << "which of them bar it the car knows";
  EXPECT_EQ(pit.episode.now()->cause, "operator: stop") << "and the base does not";
  pit.mode(kStandby);
  EXPECT_EQ(pit.steps(), "none");
  pit.mode(kDriving);
  EXPECT_EQ(pit.steps(), "none");
}

TEST(StopEpisode, AStopOfTheCarSaysWhatCrossedItsLimitAndNeedsNoRelease) {
  StopPit pit;
  pit.events.push_back(telemetry::make_event(
      telemetry::FaultEvent{.cause = 23, .begins = true, .value = 1.6F}, pit.wall.now));
  pit.wall.set(field("mode.first_stop_cause"), kDeadReckoning);
  pit.mode(kControlled);
  const StoppedCar& stopped = *pit.episode.now();
  EXPECT_EQ(stopped.cause, "dead reckoning too long");
  EXPECT_FLOAT_EQ(static_cast<float>(stopped.value), 1.6F);
  EXPECT_EQ(stopped.unit, "s");
  EXPECT_EQ(stopped.by, "");
  EXPECT_EQ(pit.steps(), "dp--");
  pit.on_alarms(false);
  EXPECT_EQ(pit.step(kReset).why, "the car still comes to a stop");
}

// Ada stopped the car an hour ago; Eve, at another base, stops it now, and Bob harder than she.
TEST(StopEpisode, APressOfAnEarlierStopIsNotTakenForThisOne) {
  StopPit pit;
  const auto press = [&](telemetry::StopLevel level, const Person& by) {
    pit.queue.stop(level, telemetry::StopReason::kOperator, by, pit.wall.now,
                   pit.radio.station->endpoint());
  };
  press(telemetry::StopLevel::kControlled, kAda);
  pit.run(seconds(10));
  pit.wall.set(field("mode.first_stop_cause"), kOperatorStop);
  pit.wall.set(field("mode.mode"), kControlled);
  pit.latch(1.0, 4711.0);
  EXPECT_EQ(pit.episode.now()->by, "");
  press(telemetry::StopLevel::kEmergency, kBob);
  pit.latch(2.0, 4712.0);
  EXPECT_EQ(pit.episode.now()->by, "Bob");
  press(telemetry::StopLevel::kEmergency, kEve);
  pit.run(seconds(1));
  EXPECT_EQ(pit.episode.now()->by, "Bob") << "it was latched already";
  pit.latch(0.0, 0.0);
  pit.latch(1.0, 4713.0);
  EXPECT_EQ(pit.episode.now()->by, "Eve") << "latched anew";
}

// A base that is started while the car stands.
TEST(StopEpisode, WhatBeganBeforeHasNoTime) {
  StopPit pit;
  pit.episode = StopEpisode{};
  pit.stand();
  pit.mode(kHalted);
  ASSERT_TRUE(pit.episode.now());
  EXPECT_TRUE(pit.episode.now()->since) << "it has driven before this one's eyes";
  pit.episode = StopEpisode{};
  pit.run(milliseconds(300));
  ASSERT_TRUE(pit.episode.now());
  EXPECT_FALSE(pit.episode.now()->since);
}

TEST(StopEpisode, WithoutAuthorityOrALinkAStepSaysSo) {
  StopPit pit;
  pit.stand();
  pit.wall.set(field("mode.mode"), kHalted);
  pit.latch(2.0, 4711.0);
  EXPECT_EQ(pit.episode.now()->level, "EMERGENCY STOP");
  pit.holder = 0;
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.step(kRelease).why, "authority: nobody holds it");
  pit.holder = kAda.console;
  pit.wall.packets = false;
  pit.run(seconds(3));
  ASSERT_TRUE(pit.episode.now()) << "a silent car is as stopped as it was";
  EXPECT_NE(pit.step(kRelease).why.find("link: link lost"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::command
