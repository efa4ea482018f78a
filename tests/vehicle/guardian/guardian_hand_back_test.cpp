// The instants at which the guardian believes, yields, gives back and halts: each at its limit and
// beyond it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/vehicle/guardian/straight.hpp"

namespace pitwall::guardian {
namespace {

// It has driven the car for 20 ms; would send in the next tick.
struct Driven {
  Straight car = silent_for(milliseconds(50));
  Driven() {
    EXPECT_EQ(car.mode(), Mode::kDriving);
    EXPECT_EQ(car.now, car.state.status.drove_from + milliseconds(20));
  }
  Instant next() const { return car.now + milliseconds(1); }
  void publish_at(Instant at) {
    ++car.record.sequence;
    car.record.at = at;
    car.record.sends = false;
  }
  void tick() {
    car.state.next_send = car.now;
    car.tick();
  }
  void expect_given(bool given, Cause cause) const {
    EXPECT_EQ(car.mode() == Mode::kHandedBack, given);
    EXPECT_EQ(car.out.mode_changed, given);
    EXPECT_EQ(car.sent.empty(), given);
    if (!given) return;
    EXPECT_EQ(car.cause(), cause);
    EXPECT_EQ(car.state.status.guidance, Guidance::kNone);
    EXPECT_EQ(car.state.status.since, car.now);
    EXPECT_LT(car.state.status.drove_until, car.now);
  }
};

TEST(GuardianHandBack, TheThirdFreshRecordIsBelieved) {
  for (const int before : {0, 1, 2}) {
    for (const int beyond_ns : {0, 1}) {
      Driven driven;
      driven.car.state.fresh_records = before;
      driven.publish_at(driven.next() - milliseconds(25) - nanoseconds(beyond_ns));
      driven.tick();
      driven.expect_given(before == 2 && beyond_ns == 0, Cause::kCarBack);
      EXPECT_EQ(driven.car.state.fresh_records, beyond_ns == 0 ? before + 1 : 0);
    }
  }
}

TEST(GuardianHandBack, ARecordThatSendsAfterTheOverlapTakesTheCar) {
  for (const int beyond_ns : {0, 1}) {
    Driven driven;
    driven.publish_at(driven.car.state.status.drove_from + milliseconds(20) +
                      nanoseconds(beyond_ns));
    driven.car.record.sends = true;
    driven.tick();
    driven.expect_given(beyond_ns == 1, Cause::kCarSends);
  }
}

TEST(GuardianHandBack, AnOldRecordThatSpokeDoesNotTakeTheCar) {
  Driven driven;
  driven.car.run(milliseconds(100));
  driven.car.state.fresh_records = 1;
  driven.publish_at(driven.next() - milliseconds(25) - nanoseconds(1));
  driven.car.record.sends = true;
  driven.tick();
  driven.expect_given(false, Cause::kNone);
}

TEST(GuardianHandBack, AResetEndsTheHoldAtOnce) {
  Driven driven;
  driven.car.state.status.mode = Mode::kHalted;
  driven.car.state.status.latched = true;
  driven.car.state.fresh_records = 2;
  driven.publish_at(driven.next());
  driven.car.record.reset = true;
  driven.tick();
  driven.expect_given(true, Cause::kReset);
}

TEST(GuardianHandBack, TheGuardianKeepsTheCarAfterItsLimitAndNotAtIt) {
  for (const int beyond_ns : {0, 1}) {
    Driven driven;
    driven.car.state.status.drove_from = driven.next() - kHandBackLimit - nanoseconds(beyond_ns);
    driven.tick();
    EXPECT_EQ(driven.car.state.status.latched, beyond_ns == 1);
  }
}

TEST(GuardianHandBack, OnlyACommandAfterItIsHeard) {
  Driven driven;
  driven.car.state.fresh_records = 2;
  driven.publish_at(driven.next());
  driven.tick();
  ASSERT_EQ(driven.car.mode(), Mode::kHandedBack);
  driven.car.run(milliseconds(5));
  EXPECT_EQ(driven.car.mode(), Mode::kHandedBack);
  driven.car.car_sends = driven.car.car_publishes = true;
  driven.car.run(milliseconds(10));
  EXPECT_EQ(driven.car.mode(), Mode::kWatching);
  EXPECT_EQ(driven.car.cause(), Cause::kNone);
}

TEST(GuardianHandBack, FromIdleAndFromNothingToDriveACarThatIsNotSilentIsWatched) {
  for (const Mode mode : {Mode::kIdle, Mode::kNothingToDrive, Mode::kWatching}) {
    Straight car;
    car.drive_for_a_second();
    const Instant since = car.state.status.since;
    car.state.status.mode = mode;
    car.tick();
    EXPECT_EQ(car.mode(), Mode::kWatching);
    EXPECT_EQ(car.cause(), Cause::kNone);
    EXPECT_EQ(car.state.status.since, mode == Mode::kWatching ? since : car.now);
    EXPECT_EQ(car.state.status.at, car.now);
  }
}

TEST(GuardianTakeOver, ACarThatNeverSpokeIsNotSilent) {
  Straight car;
  car.car_sends = false;
  car.run(milliseconds(200));
  EXPECT_EQ(car.mode(), Mode::kIdle);
}

TEST(GuardianTakeOver, BeginsAnew) {
  Straight car = silent_for(milliseconds(29));
  car.state.fresh_records = 2;
  car.state.open_loop.active = true;
  car.state.next_send = car.now + seconds(1);
  car.record.at = car.state.record.at = car.now;
  car.tick();
  ASSERT_EQ(car.mode(), Mode::kDriving);
  EXPECT_EQ(car.state.fresh_records, 0);
  EXPECT_FALSE(car.state.open_loop.active);
  EXPECT_FALSE(car.sent.empty());
  EXPECT_EQ(car.state.status.since, car.now);
}

TEST(GuardianTakeOver, NeverWithoutAPlaceOfTheCar) {
  Straight car = silent_for(milliseconds(29));
  car.state.reckoning.begun = false;
  car.tick();
  EXPECT_EQ(car.mode(), Mode::kNothingToDrive);
  EXPECT_EQ(car.cause(), Cause::kOffPath);
}

TEST(GuardianTakeOver, TheStopThatIsDrivenStays) {
  Driven driven;
  const CarRecord before = driven.car.state.record;
  driven.publish_at(driven.next());
  driven.car.record.stop.points.clear();
  driven.car.record.datum = {1.0, 2.0, 3.0};
  driven.tick();
  const CarRecord& after = driven.car.state.record;
  EXPECT_EQ(after.sequence, driven.car.record.sequence);
  EXPECT_EQ(after.stop.points.size(), before.stop.points.size());
  EXPECT_EQ(after.datum.latitude_deg, before.datum.latitude_deg);
}

TEST(GuardianStandstill, HaltsAndLatchesAfterItsDwellAndNotBefore) {
  Driven driven;
  Straight& car = driven.car;
  car.params.standstill_dwell = milliseconds(100);
  car.speed_mps = 0.0;
  while (!car.state.standing) car.tick();
  const Instant since = car.now;
  while (car.now - since < milliseconds(99)) {
    car.tick();
    ASSERT_EQ(car.mode(), Mode::kDriving);
    ASSERT_FALSE(car.state.status.latched);
  }
  car.tick();
  EXPECT_EQ(car.mode(), Mode::kHalted);
  EXPECT_TRUE(car.state.status.latched);
}

TEST(GuardianSilence, TimeInWhichItDidNotRunIsNoSilenceOfTheCar) {
  const world::SensorInput none;
  const Instant now{seconds(10).ns};
  for (const Duration slept :
       {milliseconds(10), milliseconds(10) + nanoseconds(1), milliseconds(20), milliseconds(500)}) {
    for (const Duration silent : {milliseconds(2), milliseconds(12), milliseconds(600)}) {
      State state;
      state.stepped_at = now - slept;
      state.silent_from = now - silent;
      (void)step({}, state, {.can = {}, .sensors = none, .now = now});
      const Instant later = std::min(now - milliseconds(5), now - silent + slept - milliseconds(5));
      EXPECT_EQ(state.silent_from, slept > milliseconds(10) ? later : now - silent);
    }
  }
}

TEST(GuardianInputs, TheForcesAreThoseAlongAndAcrossTheCar) {
  State state;
  world::SensorInput sensors;
  (void)sensors.imu.push({.unit = 0,
                          .at = Instant{seconds(10).ns},
                          .rate_rad_per_s = {0, 0, 0},
                          .specific_force_mps2 = {1, 2, 9}});
  (void)step({}, state, {.can = {}, .sensors = sensors, .now = Instant{seconds(10).ns}});
  EXPECT_EQ(state.ax_mps2, 1.0);
  EXPECT_EQ(state.ay_mps2, 2.0);
}

}  // namespace
}  // namespace pitwall::guardian
