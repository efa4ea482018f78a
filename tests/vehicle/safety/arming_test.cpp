// What disarms a car, and what it takes to arm it again.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/vehicle/safety/drive.hpp"
#include "vehicle/safety/supervisor.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

TEST(Arming, ADeadBusStopsTheCarThenDisarmsItAndTheBusThatComesBackDoesNotMoveIt) {
  for (const bool located : {true, false}) {
    Drive d;
    d.race();
    d.kill_bus();
    if (!located) d.car.ego.validity = world::Validity::kLost;
    const Instant died = d.now;
    d.tick();
    EXPECT_EQ(d.out.mode, Mode::kEmergencyStop);
    EXPECT_EQ(d.out.cause, Cause::kBusDead);
    d.car.control.throttle_fraction = 0.0;
    while (d.out.mode != Mode::kDisarmed && d.now - died < seconds(60)) {
      ASSERT_TRUE(d.out.actuate) << "it commands as long as somebody may obey";
      d.tick();
    }
    EXPECT_EQ(d.speed_mps, 0.0);
    EXPECT_NEAR((d.now - died).seconds(), d.params.faults.bus_dead_disarm.seconds(), 0.03);
    EXPECT_FALSE(d.out.actuate);
    EXPECT_EQ(d.out.cause, Cause::kBusDead) << "it still says why";
    d.revive_bus();
    d.car.ego.validity = world::Validity::kGood;
    d.run(seconds(5));
    EXPECT_EQ(d.out.mode, Mode::kDisarmed);
    EXPECT_EQ(d.out.arming, Arming::kUsed);
    d.car.requests.arm = false;
    d.tick();
    d.car.requests.arm = true;
    d.run(milliseconds(100));
    EXPECT_EQ(d.out.mode, Mode::kDriving);
    EXPECT_EQ(d.out.cause, Cause::kNone);
  }
}

TEST(Arming, ABusThatComesBackDuringTheStopChangesNothing) {
  Drive d;
  d.race();
  d.kill_bus();
  d.run(milliseconds(200));
  d.revive_bus();
  d.car.control.throttle_fraction = 0.0;
  d.run(seconds(60));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  EXPECT_EQ(d.out.cause, Cause::kBusDead);
}

TEST(Arming, WithoutItsBaseACarDoesNotArmAndTheRequestWaits) {
  for (const Health lost : {Health::kNever, Health::kBad}) {
    Drive d;
    d.car.stream(Stream::kRadio).health = lost;
    d.car.requests.arm = true;
    d.run(seconds(2));
    EXPECT_EQ(d.out.mode, Mode::kDisarmed);
    EXPECT_EQ(d.out.arming, Arming::kBarred);
    d.car.stream(Stream::kRadio).health = Health::kGood;
    d.run(milliseconds(50));
    EXPECT_EQ(d.out.mode, Mode::kDriving);
  }
  Drive alone;
  alone.car.stream(Stream::kRadio).health = Health::kUnwatched;
  alone.race();
}

// Armed, and waiting for green: the base goes and comes back, and so does the flag.
TEST(Arming, ABaseThatComesBackDoesNotSetACarInMotion) {
  Drive d;
  d.car.race_control.track = world::TrackFlag::kRed;
  d.car.requests.arm = true;
  d.run(seconds(1));
  ASSERT_EQ(d.out.mode, Mode::kStandby);
  d.car.stream(Stream::kRadio).health = Health::kBad;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kDisarmed);
  d.car.stream(Stream::kRadio).health = Health::kGood;
  d.car.race_control.track = world::TrackFlag::kGreen;
  d.run(seconds(5));
  EXPECT_EQ(d.out.mode, Mode::kDisarmed);
  EXPECT_EQ(d.out.arming, Arming::kUsed);
}

TEST(Arming, AStopForALostBaseStaysAfterItsReturn) {
  Drive d;
  d.race();
  d.car.stream(Stream::kRadio).health = Health::kBad;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  d.car.stream(Stream::kRadio).health = Health::kGood;
  d.car.control.throttle_fraction = 0.0;
  d.car.control.brake_kpa = 800.0;
  d.run(seconds(60));
  EXPECT_EQ(d.out.mode, Mode::kHalted);
  EXPECT_EQ(d.out.cause, Cause::kRadioLost);
}

TEST(Arming, AProcessThatBeginsWhileTheCarMovesDoesNotTakeItOver) {
  Drive d;
  d.speed_mps = 20.0;
  d.car.requests.arm = true;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kDisarmed);
  EXPECT_EQ(d.out.arming, Arming::kCarMoves);
  d.speed_mps = 0.0;
  d.run(seconds(5));
  EXPECT_EQ(d.out.mode, Mode::kDisarmed) << "the refused request is spent";
  EXPECT_EQ(d.out.arming, Arming::kCarMoves) << "and says why";
  d.car.requests.arm = false;
  d.tick();
  EXPECT_EQ(d.out.arming, Arming::kNotRequested);
  d.car.requests.arm = true;
  d.run(milliseconds(100));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
}

// The wheels are heard only after the request: what bars arming until then must not hide them.
TEST(Arming, MotionThatIsSeenLateRefusesAsWell) {
  Drive d;
  d.speed_mps = 20.0;
  d.wheels_known = false;
  d.car.bus.identity.verdict = world::IdentityVerdict::kListening;
  d.car.requests.arm = true;
  d.run(seconds(1));
  EXPECT_EQ(d.out.arming, Arming::kBarred);
  d.wheels_known = true;
  d.run(milliseconds(30));
  d.speed_mps = 0.0;
  d.car.bus.identity.verdict = world::IdentityVerdict::kRight;
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kDisarmed);
  EXPECT_EQ(d.out.arming, Arming::kCarMoves);
}

TEST(Arming, AfterARunThatEndedArmedOnlyANewRequestArms) {
  Drive d;
  d.car.last_run_armed = true;
  d.car.requests.arm = true;
  d.run(seconds(2));
  EXPECT_EQ(d.out.mode, Mode::kDisarmed);
  EXPECT_EQ(d.out.arming, Arming::kLastRunArmed);
  d.car.requests.arm = false;
  d.tick();
  d.car.requests.arm = true;
  d.run(milliseconds(100));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  EXPECT_EQ(d.out.arming, Arming::kArmed);
}

}  // namespace
}  // namespace pitwall::safety
