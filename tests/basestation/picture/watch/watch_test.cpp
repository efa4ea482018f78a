// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/watch/watch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/basestation/race_wall.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::picture {
namespace {

using telemetry::field;

double value(const RaceWall& wall, BaseField which) {
  return wall.watch.view(wall.told.picture, id_of(which), wall.now).value;
}

TEST(Watch, AHealthyRaceIsSilent) {
  RaceWall wall;
  wall.run(seconds(60));
  EXPECT_EQ(wall.watch.alarms().events(), 0U);
  EXPECT_TRUE(wall.watch.notices().all().empty());
  EXPECT_EQ(wall.watch.link_state(), LinkState::kGood);
  EXPECT_EQ(wall.watch.steps_left_out(), 0U);
}

// Before the paper's spin: the rear wheels faster than the front ones, and these than GPS.
TEST(Watch, WheelSlipIsSeenWithinItsDelay) {
  RaceWall wall;
  wall.run(seconds(2));
  for (const auto wheel : {field("wheels.rear_left"), field("wheels.rear_right")})
    wall.set(wheel, 55);
  wall.run(milliseconds(180));
  EXPECT_TRUE(wall.alarm("wheel_slip"));
}

TEST(Watch, ColdTyresForTheSpeedAskedAreSeen) {
  RaceWall wall;
  wall.tyres(29.0);
  wall.run(seconds(3));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  wall.set(field("track.target_speed"), 25.0);  // warm-up lap
  wall.run(seconds(5));
  EXPECT_FALSE(wall.alarm("tyres_cold"));
}

TEST(Watch, FlagSkewOfEightTenthsIsNoConflict) {
  RaceWall wall;
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

TEST(Watch, AWrongRoundSpeedIsSeenBeforeGreen) {
  RaceWall wall;
  wall.watch.expect({.round_speed_mps = from_mph(115)});
  wall.set(field("flags.round_target_speed"), from_mph(125));
  wall.run(seconds(2));
  EXPECT_TRUE(wall.alarm("round_speed_conflict"));
  wall.set(field("flags.round_target_speed"), from_mph(115));
  wall.run(seconds(3));
  EXPECT_FALSE(wall.alarm("round_speed_conflict"));
}

// Each with the bit that an end sets, without a delay of its own.
TEST(Watch, AttacksAndKeyErrorsAreAlarmsWhicheverEndSeesThem) {
  constexpr std::array kAlarms{"wrong_key",   "mode_mismatch",     "refused_at_rate",
                               "second_peer", "replayed_openings", "relay"};
  for (const bool by_car : {false, true}) {
    for (std::size_t i = 0; i < kAlarms.size(); ++i) {
      RaceWall wall;
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
      EXPECT_EQ(wall.watch.alarms().events(), 1U);
    }
  }
}

// A wrong key: there is no session, and never was.
TEST(Watch, AKeyErrorNeedsNoCar) {
  Picture nothing;
  Watch watch;
  const Instant start{seconds(100).ns};
  watch.advance(nothing, start);
  LinkFigures link;
  link.threats = 1.0;
  watch.link(link);
  watch.advance(nothing, start + milliseconds(100));
  ASSERT_EQ(watch.alarms().active().size(), 1U);
  EXPECT_EQ(watch.alarms().active()[0].key, "wrong_key");
  EXPECT_FALSE(watch.alarms().active()[0].response.empty());
}

TEST(Watch, FuelForNoAttemptIsSeenBeforeItBegins) {
  RaceWall wall;
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
TEST(Watch, FuelIsReckonedWhereTheCarDoesNotTellIt) {
  RaceWall wall;
  wall.set(field("fuel.level"), kUnset);
  wall.set(field("engine.speed"), 6'000.0);
  wall.set(field("powertrain.throttle_position"), 0.8);
  wall.run(seconds(2));
  EXPECT_TRUE(std::isnan(value(wall, BaseField::kFuelAttempts)));
  wall.watch.expect({.fuel_loaded_l = 40.0, .fuel_entries = 1});
  wall.run(seconds(1));
  EXPECT_NEAR(value(wall, BaseField::kFuelLevel), 40.0, 0.2);
  EXPECT_EQ(value(wall, BaseField::kFuelEstimated), 1.0);
  EXPECT_GE(value(wall, BaseField::kFuelAttempts), 1.0);
  while (value(wall, BaseField::kFuelLevel) > 5.0) wall.run(seconds(5));
  EXPECT_TRUE(wall.alarm("fuel_no_attempt"));
  wall.watch.expect({.fuel_loaded_l = 40.0, .fuel_entries = 2});
  wall.run(seconds(4));
  EXPECT_FALSE(wall.alarm("fuel_no_attempt"));
  wall.set(field("fuel.level"), 12.0);  // a measurement holds from its first on
  wall.run(seconds(4));
  EXPECT_EQ(value(wall, BaseField::kFuelEstimated), 0.0);
  EXPECT_EQ(value(wall, BaseField::kFuelLevel), 12.0);
}

TEST(Watch, InThePitLaneNoAlarmIsMadeOfTyresAndLine) {
  picture::WatchConfig config = RaceWall::with_track();
  config.course->set_pit({.from_s_m = 0.0, .to_s_m = 100.0, .offset_m = 20.0});
  RaceWall wall{std::move(config)};
  wall.tyres(29.0);
  wall.set(field("track.offset"), 20.0);
  wall.set(field("dynamics.lateral_error"), 3.0);
  wall.run(seconds(3));
  EXPECT_EQ(value(wall, BaseField::kInPit), 1.0);
  EXPECT_FALSE(wall.alarm("tyres_cold"));
  EXPECT_FALSE(wall.alarm("off_line_far"));
  wall.set(field("track.offset"), 2.0);  // it leaves, as cold and as far off
  wall.run(seconds(3));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  EXPECT_TRUE(wall.alarm("off_line_far"));
}

// Corrections that two users take from each other, and a tunnel that takes both receivers' sky.
TEST(Watch, SharedCorrectionsAreSeenATunnelIsNot) {
  for (const bool tunnel : {false, true}) {
    RaceWall wall;
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

TEST(Watch, ALostLinkIsOneAlarmAGhostAndOneMessage) {
  RaceWall wall;
  wall.tyres(29.0);
  wall.run(seconds(5));
  ASSERT_TRUE(wall.alarm("tyres_cold"));
  wall.packets = false;
  wall.run(milliseconds(380));
  EXPECT_FALSE(wall.alarm("link_lost"));
  wall.run(milliseconds(60));
  ASSERT_EQ(wall.watch.alarms().active().size(), 1U);
  EXPECT_EQ(wall.watch.alarms().active().front().key, "link_lost");
  wall.run(seconds(3));
  EXPECT_EQ(wall.watch.alarms().active().size(), 1U);
  EXPECT_NEAR(value(wall, BaseField::kGhostX), 20.0 + 50.0 * 3.43, 3.0);
  EXPECT_GT(value(wall, BaseField::kGhostRadius), 20.0);
  wall.run(seconds(7));
  EXPECT_TRUE(std::isnan(value(wall, BaseField::kGhostX)));
  wall.packets = true;
  wall.run(seconds(10));
  EXPECT_TRUE(wall.alarm("tyres_cold"));
  ASSERT_EQ(wall.watch.notices().all().size(), 2U);
  EXPECT_EQ(wall.watch.notices().all()[0].kind, alarms::NoticeKind::kDegraded);
  EXPECT_EQ(wall.watch.notices().all()[1].kind, alarms::NoticeKind::kRestored);
}

TEST(Watch, OnlyTheTyresAreSilent) {
  RaceWall wall;
  wall.run(seconds(3));
  wall.comes = [](telemetry::Group group) { return group != telemetry::Group::kTyres; };
  wall.tyres(29.0);
  wall.run(seconds(10));
  EXPECT_FALSE(wall.ever("tyres_cold"));  // the last that was heard was warm, and is old now
  EXPECT_TRUE(wall.alarm("picture_old"));
  EXPECT_EQ(wall.watch.view(wall.told.picture, id_of(BaseField::kTyreMin), wall.now).quality,
            Quality::kStale);
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
      at += RaceWall::kPacket * static_cast<std::int64_t>(1 + random() % 60);
      events.push_back({at, static_cast<int>(random() % 9), static_cast<double>(random() % 100)});
    }
  }

  void play(RaceWall& wall, int polls) const {
    for (const Event& event : events) {
      wall.run(event.at - wall.now, polls);
      apply(wall, event);
    }
    wall.run(seconds(5), polls);
  }
  static void apply(RaceWall& wall, const Event& event) {
    const auto list = wall.watch.alarms().active();
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
        (void)wall.watch.take(AlarmAct{.alarm = id, .by = "Ada"});
        return;
      case 7:
        (void)wall.watch.take(AlarmAct{.kind = AlarmAct::Kind::kShelve,
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

TEST(Watch, TheSameEventsGiveTheSameAlarmsAtAnyRhythm) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Script script{seed};
    RaceWall live, replay, seldom, often;
    script.play(live, 1);
    script.play(replay, 1);
    script.play(often, 7);
    script.play(seldom, 3);
    ASSERT_GT(live.watch.alarms().events(), 20U);
    for (const RaceWall* other : {&replay, &often, &seldom}) {
      EXPECT_EQ(live.watch.alarms().history(), other->watch.alarms().history()) << seed;
      EXPECT_EQ(live.watch.notices().all(), other->watch.notices().all()) << seed;
      EXPECT_EQ(live.watch.alarms().revision(), other->watch.alarms().revision()) << seed;
    }
  }
}

TEST(Watch, ABaseThatSleptDoesNotJudgeThatHour) {
  RaceWall wall;
  wall.run(seconds(1));
  wall.watch.advance(wall.told.picture, wall.now + seconds(3'600));
  EXPECT_EQ(wall.watch.steps_left_out(), 360'000U - Watch::kStepsAtOnce);
  EXPECT_TRUE(wall.alarm("link_lost"));
}

TEST(Watch, AStepAllocatesNothing) {
  RaceWall wall;
  wall.tyres(29.0);
  wall.run(seconds(5));  // with an alarm in the list
  const Instant next = wall.now + kGrid;
  const auto taken = testing::allocations_of([&] { wall.watch.advance(wall.told.picture, next); });
  EXPECT_EQ(taken, 0U);
}

}  // namespace
}  // namespace pitwall::picture
