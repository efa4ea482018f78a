// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/evaluator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/basestation/healthy_race.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::alarms {
namespace {

using telemetry::field;

double value(const HealthyRace& wall, state::BaseField which) {
  return wall.evaluator.view(wall.reported.vehicle, state::id_of(which), wall.now).value;
}

TEST(Evaluator, AHealthyRaceIsSilent) {
  HealthyRace wall;
  wall.run(seconds(60));
  EXPECT_EQ(wall.evaluator.alarms().events(), 0U);
  EXPECT_TRUE(wall.evaluator.notices().all().empty());
  EXPECT_EQ(wall.evaluator.link_state(), state::LinkState::kGood);
  EXPECT_EQ(wall.evaluator.steps_left_out(), 0U);
}

// Before the paper's spin: the rear wheels faster than the front ones, and these than GPS.
TEST(Evaluator, WheelSlipIsSeenWithinItsDelay) {
  HealthyRace wall;
  wall.run(seconds(2));
  for (const auto wheel : {field("wheels.rear_left"), field("wheels.rear_right")})
    wall.set(wheel, 55);
  wall.run(milliseconds(180));
  EXPECT_TRUE(wall.alarm("wheel_slip"));
}

TEST(Evaluator, ColdTyresForTheSpeedAskedAreSeen) {
  HealthyRace wall;
  wall.tyres(29.0);
  wall.run(seconds(3));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  wall.set(field("track.target_speed"), 25.0);  // warm-up lap
  wall.run(seconds(5));
  EXPECT_FALSE(wall.alarm("tyres_cold"));
}

TEST(Evaluator, FlagSkewOfEightTenthsIsNoConflict) {
  HealthyRace wall;
  wall.run(seconds(2));
  for (int i = 0; i < 10; ++i) {  // the car follows 0.8 s after race control, each time
    wall.set(field("flags.track"), i % 2 == 0 ? 3.0 : 4.0);
    wall.run(milliseconds(800));
    wall.set(field("flags.track_acted_on"), i % 2 == 0 ? 3.0 : 4.0);
    wall.run(seconds(3));
  }
  EXPECT_FALSE(wall.ever("flag_conflict"));
  wall.set(field("flags.track"), 1.0);
  wall.run(milliseconds(1'100));
  EXPECT_TRUE(wall.alarm("flag_conflict"));
}

TEST(Evaluator, AWrongRoundSpeedIsSeenBeforeGreen) {
  HealthyRace wall;
  wall.evaluator.expect({.round_speed_mps = from_mph(115)});
  wall.set(field("flags.round_target_speed"), from_mph(125));
  wall.run(seconds(2));
  EXPECT_TRUE(wall.alarm("round_speed_conflict"));
  wall.set(field("flags.round_target_speed"), from_mph(115));
  wall.run(seconds(3));
  EXPECT_FALSE(wall.alarm("round_speed_conflict"));
}

// Each with the bit that an end sets, without a delay of its own.
TEST(Evaluator, AttacksAndKeyErrorsAreAlarmsWhicheverEndSeesThem) {
  constexpr std::array kAlarms{"wrong_key",   "mode_mismatch",     "refused_at_rate",
                               "second_peer", "replayed_openings", "relay"};
  for (const bool by_car : {false, true}) {
    for (std::size_t i = 0; i < kAlarms.size(); ++i) {
      HealthyRace wall;
      wall.link.threats = 0.0;
      wall.run(seconds(1));
      const double bit = static_cast<double>(1U << i);
      if (by_car) {
        wall.set(field("radio.threats"), bit);
      } else {
        wall.link.threats = bit;
      }
      wall.run(milliseconds(200));
      for (const char* const key : kAlarms) EXPECT_EQ(wall.alarm(key), key == kAlarms[i]) << key;
      // A minute of it is one alarm.
      wall.run(seconds(60));
      EXPECT_EQ(wall.evaluator.alarms().events(), 1U);
    }
  }
}

// A wrong key: there is no session, and never was.
TEST(Evaluator, AKeyErrorNeedsNoCar) {
  state::VehicleState nothing;
  Evaluator evaluator;
  const Instant start{seconds(100).ns};
  evaluator.advance(nothing, start);
  state::LinkFigures link;
  link.threats = 1.0;
  evaluator.link(link);
  evaluator.advance(nothing, start + milliseconds(100));
  ASSERT_EQ(evaluator.alarms().active().size(), 1U);
  EXPECT_EQ(evaluator.alarms().active()[0].key, "wrong_key");
  EXPECT_FALSE(evaluator.alarms().active()[0].response.empty());
}

TEST(Evaluator, FuelForNoAttemptIsSeenBeforeItBegins) {
  HealthyRace wall;
  double level = 22.0, lap = 3.0;
  const auto drive_lap = [&] {
    for (int i = 0; i < 8; ++i) {
      level -= 2.5 / 8;
      wall.set(field("fuel.level"), level);
      wall.run(seconds(5));
    }
    wall.set(field("track.lap"), ++lap);
    wall.run(seconds(2));
  };
  for (int i = 0; i < 5; ++i) drive_lap();
  EXPECT_FALSE(wall.ever("fuel_no_attempt"));  // 9.5 l: one attempt and home
  drive_lap();
  EXPECT_TRUE(wall.alarm("fuel_no_attempt"));  // 7 l
  EXPECT_FALSE(wall.ever("fuel_home_now"));
  drive_lap();
  drive_lap();
  EXPECT_TRUE(wall.alarm("fuel_home_now"));
}

// A car without a level: reckoned from what was loaded, and the same alarm comes of it.
TEST(Evaluator, FuelIsReckonedWhereTheCarDoesNotTellIt) {
  HealthyRace wall;
  wall.set(field("fuel.level"), kUnset);
  wall.set(field("engine.speed"), 6'000.0);
  wall.set(field("powertrain.throttle_position"), 0.8);
  wall.run(seconds(2));
  EXPECT_TRUE(std::isnan(value(wall, state::BaseField::kFuelAttempts)));
  wall.evaluator.expect({.fuel_loaded_l = 40.0, .fuel_entries = 1});
  wall.run(seconds(1));
  EXPECT_NEAR(value(wall, state::BaseField::kFuelLevel), 40.0, 0.2);
  EXPECT_EQ(value(wall, state::BaseField::kFuelEstimated), 1.0);
  EXPECT_GE(value(wall, state::BaseField::kFuelAttempts), 1.0);
  while (value(wall, state::BaseField::kFuelLevel) > 11.0) wall.run(seconds(5));
  EXPECT_TRUE(wall.alarm("fuel_no_attempt"));  // 11 l, of which 3.8 l may be burnt
  while (value(wall, state::BaseField::kFuelLevel) > 5.0) wall.run(seconds(5));
  EXPECT_TRUE(wall.alarm("fuel_home_now"));
  wall.evaluator.expect({.fuel_loaded_l = 40.0, .fuel_entries = 2});
  wall.run(seconds(6));
  EXPECT_FALSE(wall.alarm("fuel_no_attempt"));
  EXPECT_FALSE(wall.alarm("fuel_home_now"));
  wall.set(field("fuel.level"), 12.0);  // a measurement holds from its first on
  wall.run(seconds(4));
  EXPECT_EQ(value(wall, state::BaseField::kFuelEstimated), 0.0);
  EXPECT_EQ(value(wall, state::BaseField::kFuelLevel), 12.0);
}

TEST(Evaluator, InThePitLaneNoAlarmIsMadeOfTyresAndLine) {
  alarms::EvaluatorConfig config = HealthyRace::with_track();
  config.course->set_pit({.from_s_m = 0.0, .to_s_m = 100.0, .offset_m = 20.0});
  HealthyRace wall{std::move(config)};
  wall.tyres(29.0);
  wall.set(field("track.offset"), 20.0);
  wall.set(field("dynamics.lateral_error"), 3.0);
  wall.run(seconds(3));
  EXPECT_EQ(value(wall, state::BaseField::kInPit), 1.0);
  EXPECT_FALSE(wall.alarm("tyres_cold"));
  EXPECT_FALSE(wall.alarm("off_line_far"));
  wall.set(field("track.offset"), 2.0);  // it leaves, as cold and as far off
  wall.run(seconds(3));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  EXPECT_TRUE(wall.alarm("off_line_far"));
}

// Corrections that two users take from each other, and a tunnel that takes both receivers' sky.
TEST(Evaluator, SharedCorrectionsAreSeenATunnelIsNot) {
  for (const bool tunnel : {false, true}) {
    HealthyRace wall;
    double age = 1.0;
    const auto part = [&](double length_s, bool flows) {
      for (double t = 0.0; t < length_s; t += 0.5) {
        age = flows ? 1.0 : age + 0.5;
        for (const auto unit : {field("gnss0.differential_age"), field("gnss1.differential_age")}) {
          wall.set(unit, age);
        }
        for (const auto unit : {field("gnss0.satellites"), field("gnss1.satellites")}) {
          wall.set(unit, tunnel && !flows ? 2.0 : 14.0);
        }
        wall.run(milliseconds(500));
      }
    };
    part(30, true);
    for (int i = 0; i < 4; ++i) {
      part(7, false);
      part(6, true);
    }
    EXPECT_EQ(wall.ever("correction_conflict"), !tunnel);
  }
}

TEST(Evaluator, ALostLinkIsOneAlarmAGhostAndOneMessage) {
  HealthyRace wall;
  wall.tyres(29.0);
  wall.run(seconds(5));
  ASSERT_TRUE(wall.alarm("tyres_cold"));
  wall.packets = false;
  wall.run(milliseconds(380));
  EXPECT_FALSE(wall.alarm("link_lost"));
  wall.run(milliseconds(60));
  ASSERT_EQ(wall.evaluator.alarms().active().size(), 1U);
  EXPECT_EQ(wall.evaluator.alarms().active().front().key, "link_lost");
  wall.run(seconds(3));
  EXPECT_EQ(wall.evaluator.alarms().active().size(), 1U);
  EXPECT_NEAR(value(wall, state::BaseField::kGhostX), 20.0 + 50.0 * 3.43, 3.0);
  EXPECT_GT(value(wall, state::BaseField::kGhostRadius), 20.0);
  wall.run(seconds(7));
  EXPECT_TRUE(std::isnan(value(wall, state::BaseField::kGhostX)));
  wall.packets = true;
  wall.run(seconds(10));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  ASSERT_EQ(wall.evaluator.notices().all().size(), 2U);
  EXPECT_EQ(wall.evaluator.notices().all()[0].kind, alarms::NoticeKind::kDegraded);
  EXPECT_EQ(wall.evaluator.notices().all()[1].kind, alarms::NoticeKind::kRestored);
}

// Whoever takes a receiver out of use knows it; the other one still has its alarm.
TEST(Evaluator, AnExcludedReceiverRaisesNoAlarmOfItself) {
  for (const double excluded : {0.0, 1.0, 4.0}) {  // none, GNSS 0, an inertial unit
    HealthyRace wall;
    wall.set(telemetry::field("localization.excluded"), excluded);
    wall.run(seconds(5));
    wall.set(telemetry::field("gnss0.status"), 1.0);
    wall.run(seconds(10));
    EXPECT_EQ(wall.ever("gnss_one_bad"), excluded != 1.0) << excluded;
    EXPECT_FALSE(wall.ever("gnss_both_bad"));
    wall.set(telemetry::field("gnss1.status"), 1.0);
    wall.run(seconds(10));
    EXPECT_TRUE(wall.alarm("gnss_both_bad")) << excluded;
  }
}

TEST(Evaluator, AStopThatNobodyHasSeenOutlivesTheLink) {
  HealthyRace wall;
  wall.run(seconds(5));
  wall.set(telemetry::field("mode.stop_latch"), 2.0);
  wall.run(seconds(1));
  ASSERT_TRUE(wall.alarm("emergency_stop"));
  wall.packets = false;
  wall.run(seconds(20));
  EXPECT_TRUE(wall.alarm("link_lost"));
  ASSERT_EQ(wall.evaluator.alarms().active().size(), 2U);
  EXPECT_EQ(wall.evaluator.alarms().state(*alarms::find_alarm("emergency_stop")),
            alarms::State::kUnack);
  for (const alarms::ListedAlarm& alarm : wall.evaluator.alarms().active()) {
    const auto shelved =
        wall.evaluator.take(alarms::AlarmAction{.kind = alarms::AlarmAction::Kind::kShelve,
                                                .alarm = alarm.id,
                                                .length = seconds(60),
                                                .by = "Ada",
                                                .reason = "noise"});
    EXPECT_EQ(static_cast<bool>(shelved), alarm.key != "emergency_stop") << alarm.key;
  }
}

TEST(Evaluator, OnlyTheTyresAreSilent) {
  HealthyRace wall;
  wall.run(seconds(3));
  wall.comes = [](telemetry::Group group) { return group != telemetry::Group::kTyres; };
  wall.tyres(29.0);
  wall.run(seconds(10));
  EXPECT_FALSE(wall.ever("tyres_cold"));  // the last that was heard was warm, and is old now
  EXPECT_TRUE(wall.alarm("picture_old"));
  EXPECT_EQ(
      wall.evaluator.view(wall.reported.vehicle, state::id_of(state::BaseField::kTyreMin), wall.now)
          .quality,
      state::Quality::kStale);
}

// What happens, when: the same for every wall that is given it.
struct Script {
  struct Event {
    Instant at;
    int what;
    double value;
  };
  std::vector<Event> events;

  explicit Script(unsigned seed) {
    std::mt19937 random{seed};
    Instant at = kStart;
    for (int i = 0; i < 300; ++i) {
      at += HealthyRace::kPacket * static_cast<std::int64_t>(1 + random() % 60);
      events.push_back({at, static_cast<int>(random() % 9), static_cast<double>(random() % 100)});
    }
  }

  void play(HealthyRace& wall, int polls) const {
    for (const Event& event : events) {
      wall.run(event.at - wall.now, polls);
      apply(wall, event);
    }
    wall.run(seconds(5), polls);
  }
  static void apply(HealthyRace& wall, const Event& event) {
    const auto list = wall.evaluator.alarms().active();
    const auto id =
        list.empty() ? 0U : list[static_cast<std::size_t>(event.value) % list.size()].id;
    switch (event.what) {
      case 0:
        return wall.tyres(event.value);
      case 1:
        return wall.set(field("wheels.rear_left"), 50.0 + event.value / 10.0);
      case 2:
        return wall.set(field("flags.track"), event.value > 50 ? 3.0 : 4.0);
      case 3:
        wall.link.down_loss = event.value / 200.0;
        return;
      case 4:
        wall.packets = event.value > 30.0;
        return;
      case 5:
        return wall.set(field("gnss1.sigma"), event.value / 100.0);
      case 6:
        (void)wall.evaluator.take(AlarmAction{.alarm = id, .by = "Ada"});
        return;
      case 7:
        (void)wall.evaluator.take(AlarmAction{.kind = AlarmAction::Kind::kShelve,
                                              .alarm = id,
                                              .length = seconds(20),
                                              .by = "Ada",
                                              .reason = "r"});
        return;
      default:
        wall.set(field("mode.stop_latch"), event.value > 80 ? 1.0 : 0.0);
    }
  }
};

TEST(Evaluator, TheSameEventsGiveTheSameAlarmsAtAnyRhythm) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Script script{seed};
    HealthyRace live, replay, seldom, often;
    script.play(live, 1);
    script.play(replay, 1);
    script.play(often, 7);
    script.play(seldom, 3);
    ASSERT_GT(live.evaluator.alarms().events(), 20U);
    for (const HealthyRace* other : {&replay, &often, &seldom}) {
      EXPECT_EQ(live.evaluator.alarms().history(), other->evaluator.alarms().history()) << seed;
      EXPECT_EQ(live.evaluator.notices().all(), other->evaluator.notices().all()) << seed;
      EXPECT_EQ(live.evaluator.alarms().revision(), other->evaluator.alarms().revision()) << seed;
    }
  }
}

TEST(Evaluator, ABaseThatSleptDoesNotJudgeThatHour) {
  HealthyRace wall;
  wall.run(seconds(1));
  wall.evaluator.advance(wall.reported.vehicle, wall.now + seconds(3'600));
  EXPECT_EQ(wall.evaluator.steps_left_out(), 360'000U - Evaluator::kStepsAtOnce);
  EXPECT_TRUE(wall.alarm("link_lost"));
}

TEST(Evaluator, AStepAllocatesNothing) {
  HealthyRace wall;
  wall.tyres(29.0);
  wall.run(seconds(5));  // with an alarm in the list
  const Instant next = wall.now + kGrid;
  const auto taken =
      testing::allocations_of([&] { wall.evaluator.advance(wall.reported.vehicle, next); });
  EXPECT_EQ(taken, 0U);
}

}  // namespace
}  // namespace pitwall::alarms
