// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/watchdog.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace pitwall::safety {
namespace {

struct Kennel {
  WatchdogParams params;
  WatchdogState state;
  world::SensorInput sensors;
  world::VehicleSignals signals;
  world::RaceControl race_control;
  std::array<std::optional<Instant>, world::kGnssUnits> bytes{};
  std::optional<Instant> planner, radio;

  // A car that ran all the time.
  WatchdogOutput watch(Instant now) {
    state.watched_at = now - milliseconds(10);
    return wake(now);
  }

  // One that was paused since its last tick, where that is long ago.
  WatchdogOutput wake(Instant now) {
    const WatchdogInputs inputs{sensors, signals, race_control, bytes, planner, radio};
    const WatchdogOutput out = safety::watch(params, state, inputs, now);
    sensors = {};
    return out;
  }
};

template <class List, class Sample>
void push(List& list, const Sample& sample) {
  EXPECT_TRUE(list.push(sample));
}

world::GnssPosition position(std::uint8_t unit, Instant at) {
  return {.unit = unit,
          .at = at,
          .solution_status = world::kSolutionComputed,
          .position_type = world::kPositionSingle};
}

// How a sample of each stream arrives.
void feed(Kennel& k, Stream stream, Instant at) {
  const auto unit = static_cast<std::uint8_t>(static_cast<std::size_t>(stream) % 2);
  switch (stream) {
    case Stream::kGnss0Link:
    case Stream::kGnss1Link:
      k.bytes[unit] = at;
      return;
    case Stream::kGnss0Position:
    case Stream::kGnss1Position:
      push(k.sensors.positions, world::GnssPosition{.unit = unit, .at = at});
      return;
    case Stream::kGnss0Solution:
    case Stream::kGnss1Solution:
      push(k.sensors.positions, position(unit, at));
      return;
    case Stream::kGnss0Velocity:
    case Stream::kGnss1Velocity:
      push(k.sensors.velocities, world::GnssVelocity{.unit = unit, .at = at});
      return;
    case Stream::kGnss0Heading:
    case Stream::kGnss1Heading:
      push(k.sensors.headings, world::GnssHeading{.unit = unit, .at = at});
      return;
    case Stream::kImu0:
    case Stream::kImu1:
      push(k.sensors.imu, world::ImuSample{.unit = unit, .at = at});
      return;
    case Stream::kWheelSpeed:
      k.signals.wheel_speed_mps = {{}, at, true};
      return;
    case Stream::kBrake:
      k.signals.brake = {{}, at, true};
      return;
    case Stream::kThrottle:
      k.signals.throttle_fraction = {0.0, at, true};
      return;
    case Stream::kSteering:
      k.signals.steering_motor_rad = {0.0, at, true};
      return;
    case Stream::kMisc:
      k.signals.misc = {{}, at, true};
      return;
    case Stream::kPowertrain:
      k.signals.powertrain = {{}, at, true};
      return;
    case Stream::kDiagnostics:
      k.signals.diagnostics = {{}, at, true};
      return;
    case Stream::kRaceControl:
      k.race_control.ever_received = true;
      k.race_control.last_heartbeat_change = at;
      return;
    case Stream::kPlanner:
      k.planner = at;
      return;
    case Stream::kRadio:
      k.radio = at;
      return;
  }
}

TEST(Watchdog, EachStreamIsJudgedByItsAgeToTheNanosecond) {
  for (std::size_t i = 0; i < kStreams; ++i) {
    const auto stream = static_cast<Stream>(i);
    Kennel k;
    const StreamLimit& limit = k.params.limits[i];
    EXPECT_LT(limit.warning, limit.bad) << limit.name;
    EXPECT_EQ(k.watch(Instant{} + seconds(9))[stream].health, Health::kNever) << limit.name;
    const Instant received = Instant{} + seconds(10);
    feed(k, stream, received);
    const auto at = [&](Duration age) { return k.watch(received + age)[stream]; };
    EXPECT_EQ(at({}).health, Health::kGood) << limit.name;
    EXPECT_EQ(at(limit.warning).health, Health::kGood) << limit.name;
    EXPECT_EQ(at(limit.warning + nanoseconds(1)).health, Health::kWarning) << limit.name;
    EXPECT_EQ(at(limit.bad).health, Health::kWarning) << limit.name;
    EXPECT_EQ(at(limit.bad + nanoseconds(1)).health, Health::kBad) << limit.name;
    EXPECT_EQ(at(limit.bad + seconds(1)).age, limit.bad + seconds(1)) << limit.name;
    k.params.limits[i].watched = false;
    EXPECT_EQ(at({}).health, Health::kUnwatched) << limit.name;
  }
}

TEST(Watchdog, HearingOneStreamSaysNothingOfTheOthers) {
  for (std::size_t i = 0; i < kStreams; ++i) {
    Kennel k;
    k.bytes = {Instant{}, Instant{}};  // the ports speak for the links
    feed(k, static_cast<Stream>(i), Instant{});
    const WatchdogOutput out = k.watch(Instant{});
    for (std::size_t other = 2; other < kStreams; ++other) {
      const auto solved = static_cast<Stream>(i);
      const bool implied = (solved == Stream::kGnss0Solution && other == 2) ||
                           (solved == Stream::kGnss1Solution && other == 3);
      EXPECT_EQ(out.rows[other].health != Health::kNever, other == i || implied) << i << other;
    }
  }
}

TEST(Watchdog, WithoutPortTimesAnySampleKeepsTheLinkUp) {
  for (const Stream stream :
       {Stream::kGnss1Position, Stream::kGnss1Velocity, Stream::kGnss1Heading, Stream::kImu1}) {
    Kennel k;
    feed(k, stream, Instant{});
    const WatchdogOutput out = k.watch(Instant{});
    EXPECT_EQ(out[Stream::kGnss1Link].health, Health::kGood);
    EXPECT_EQ(out[Stream::kGnss0Link].health, Health::kNever);
  }
}

TEST(Watchdog, APositionWithoutASolutionIsNoSolution) {
  Kennel k;
  world::GnssPosition p = position(0, Instant{});
  p.solution_status = 1;
  push(k.sensors.positions, p);
  p = position(1, Instant{});
  p.position_type = world::kPositionNone;
  push(k.sensors.positions, p);
  const WatchdogOutput out = k.watch(Instant{});
  EXPECT_EQ(out[Stream::kGnss0Position].health, Health::kGood);
  EXPECT_EQ(out[Stream::kGnss0Solution].health, Health::kNever);
  EXPECT_EQ(out[Stream::kGnss1Solution].health, Health::kNever);
}

TEST(Watchdog, AnOldSampleDoesNotTurnTheClockBackAndAStrangerIsIgnored) {
  Kennel k;
  push(k.sensors.positions, position(0, Instant{} + seconds(5)));
  push(k.sensors.positions, position(0, Instant{} + seconds(4)));
  push(k.sensors.positions, position(7, Instant{} + seconds(5)));
  push(k.sensors.velocities, world::GnssVelocity{.unit = 2, .at = Instant{}});
  push(k.sensors.headings, world::GnssHeading{.unit = 2, .at = Instant{}});
  push(k.sensors.imu, world::ImuSample{.unit = 2, .at = Instant{}});
  const WatchdogOutput out = k.watch(Instant{} + seconds(5));
  EXPECT_EQ(out[Stream::kGnss0Position].age, Duration{});
  for (std::size_t i = 0; i < kStreams; ++i) {
    const bool of_unit_0 = i == 0 || i == 2 || i == 4;  // link, position, solution
    EXPECT_EQ(out.rows[i].health == Health::kNever, !of_unit_0) << i;
  }
  push(k.sensors.positions, position(0, Instant{} + seconds(6)));
  EXPECT_EQ(k.watch(Instant{} + seconds(7))[Stream::kGnss0Position].age, seconds(1));
}

TEST(Watchdog, AStampFromTheFutureKeepsNothingAlive) {
  Kennel k;
  const Instant now = Instant{} + seconds(100);
  feed(k, Stream::kGnss0Position, now + seconds(3600));
  EXPECT_EQ(k.watch(now)[Stream::kGnss0Position].health, Health::kGood);
  const Instant later = now + k.params.limits[2].bad + nanoseconds(1);
  EXPECT_EQ(k.watch(later)[Stream::kGnss0Position].health, Health::kBad);
}

TEST(Watchdog, TimeInWhichTheCarSleptIsNoAge) {
  for (const std::int64_t slept_ms : {26, 100, 200, 260}) {
    Kennel k;
    Instant now = Instant{} + seconds(10);
    feed(k, Stream::kWheelSpeed, now);
    k.watch(now);
    now += milliseconds(slept_ms);
    EXPECT_EQ(k.wake(now)[Stream::kWheelSpeed].age, milliseconds(10)) << slept_ms;
    for (int tick = 1; tick <= 3; ++tick) {
      now += milliseconds(10);
      EXPECT_EQ(k.wake(now)[Stream::kWheelSpeed].age, milliseconds(10 * (tick + 1))) << slept_ms;
    }
    feed(k, Stream::kWheelSpeed, now);
    EXPECT_EQ(k.wake(now)[Stream::kWheelSpeed].age, Duration{});
    now += milliseconds(20);
    EXPECT_EQ(k.wake(now)[Stream::kWheelSpeed].age, milliseconds(20))
        << "nothing is discounted any more";
  }
}

TEST(Watchdog, OnlyTheSleepThatLiesAfterTheNewestIsPardonedAndNoMoreThanALimit) {
  Kennel k;
  Instant now = Instant{} + seconds(10);
  feed(k, Stream::kBrake, now);
  k.watch(now);
  now += milliseconds(100);
  feed(k, Stream::kBrake, now - milliseconds(40));
  EXPECT_EQ(k.wake(now)[Stream::kBrake].age, milliseconds(10));
  for (int nap = 1; nap <= 20; ++nap) {
    now += milliseconds(100);
    const Duration real = milliseconds(40 + 100 * nap);
    const Duration discounted = std::min(kDiscountMax, milliseconds(30 + 90 * nap));
    EXPECT_EQ(k.wake(now)[Stream::kBrake].age, real - discounted) << nap;
  }
}

}  // namespace
}  // namespace pitwall::safety
