// SPDX-License-Identifier: Apache-2.0
// Hold and coast: what it does to the commands, how it ends, and what it leaves in the log.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/drive.hpp"
#include "vehicle/safety/supervisor.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

void late_plan(Drive& d, bool late = true) {
  d.car.stream(Stream::kPlanner).health = late ? Health::kWarning : Health::kGood;
}

struct Coast : ::testing::Test {
  Drive d;
  void SetUp() override { d.race(); }
  Instant since_here() const { return d.now; }
};

TEST_F(Coast, TakesTheThrottleAwayInTheVeryTickAndHoldsTheLine) {
  d.car.control.throttle_fraction = 0.8;
  d.car.control.brake_kpa = 0.0;
  d.run(seconds(1));
  ASSERT_GT(d.out.command.throttle_fraction, 0.7);
  const double steered = d.out.command.road_wheel_rad;
  late_plan(d);
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kCoast);
  EXPECT_TRUE(d.out.mode_changed);
  EXPECT_EQ(d.out.command.throttle_fraction, 0.0);
  EXPECT_EQ(d.out.command.brake_kpa, 0.0);
  EXPECT_EQ(d.out.command.road_wheel_rad, steered);
  EXPECT_EQ(d.out.follow, Follow::kDrive);
  EXPECT_TRUE(d.out.actuate);
}

TEST_F(Coast, FreesTheBrakeAtSpeedAndLeavesItToControlWhenSlow) {
  d.car.control.throttle_fraction = 0.0;
  d.car.control.brake_kpa = 400.0;
  late_plan(d);
  d.speed_mps = 30.0;
  d.tick();
  EXPECT_EQ(d.out.command.brake_kpa, 0.0);
  d.speed_mps = d.params.coast_brakes_below_mps - 0.1;
  d.run(milliseconds(50));
  EXPECT_EQ(d.out.mode, Mode::kCoast);
  EXPECT_NEAR(d.out.command.brake_kpa, 400.0, 1e-9)
      << "a car that is nearly standing must not roll";
}

TEST_F(Coast, DrivesOnAfterTheDwellAndForgets) {
  late_plan(d);
  d.run(milliseconds(100));
  late_plan(d, false);
  const Instant passed = d.now;
  d.tick();
  while (d.out.mode == Mode::kCoast) d.tick();
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  EXPECT_EQ(d.now - passed, d.params.coast_dwell);
  EXPECT_EQ(d.out.cause, Cause::kNone);
  EXPECT_EQ(d.state.log.first.cause, Cause::kNone);
  EXPECT_EQ(d.state.coasts.cause, Cause::kNone);
  d.run(seconds(2));
  EXPECT_GT(d.out.command.throttle_fraction, 0.2) << "and pushes again";
}

TEST_F(Coast, StopsWhereItLastsAndNamesWhatBegan) {
  const Instant began = d.now;
  late_plan(d);
  d.tick();
  const Instant logged = d.now;
  while (d.out.mode == Mode::kCoast) d.tick();
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.now - began, d.params.coast_max + milliseconds(10));
  EXPECT_EQ(d.out.cause, Cause::kPlanLate);
  EXPECT_EQ(d.state.log.first.at, logged);
  late_plan(d, false);
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kControlledStop) << "what stopped the car stays stopped";
  d.run(seconds(9));
  EXPECT_EQ(d.out.mode, Mode::kHalted) << "until it stands";
}

// One beat in three, for ever: never gone for the dwell, so it lasts.
TEST_F(Coast, WhatFlickersLasts) {
  for (int tick = 0; tick < 200; ++tick) {
    late_plan(d, tick % 30 == 0);
    d.tick();
  }
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kPlanLate);
}

TEST_F(Coast, AFaultThatStopsIsTheFirstCause) {
  late_plan(d);
  d.run(milliseconds(50));
  d.car.requests.stop = true;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kOperatorStop);
  d.car.requests.emergency_stop = true;
  EXPECT_EQ(d.tick().mode, Mode::kEmergencyStop);
}

TEST_F(Coast, AnEmergencyNeedsNoDetour) {
  late_plan(d);
  d.tick();
  d.car.requests.emergency_stop = true;
  EXPECT_EQ(d.tick().mode, Mode::kEmergencyStop);
}

TEST_F(Coast, OneBadTickOfControlIsCoastedThreeStop) {
  d.car.control_ok = false;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kCoast);
  EXPECT_EQ(d.out.command.throttle_fraction, 0.0);
  EXPECT_TRUE(std::isfinite(d.out.command.road_wheel_rad)) << "the line of the last command";
  d.car.control_ok = true;
  d.run(milliseconds(600));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  d.car.control_ok = false;
  d.run(milliseconds(30));
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kControlFailed);
}

TEST_F(Coast, DeadReckoningCoastsBeforeItStops) {
  d.car.ego.validity = world::Validity::kDeadReckoning;
  const Instant lost = d.now;
  while (d.tick().mode == Mode::kDriving) ASSERT_LT(d.now - lost, seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kCoast);
  EXPECT_NEAR((d.now - lost).seconds(), 0.31, 0.011);
  while (d.tick().mode == Mode::kCoast) ASSERT_LT(d.now - lost, seconds(2));
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kDeadReckoningTooLong);
}

TEST(CoastNever, BeforeTheCarDrives) {
  Drive d;
  d.car.requests.arm = true;
  late_plan(d);
  d.run(seconds(1));
  EXPECT_EQ(d.out.mode, Mode::kStandby) << "it waits until the plan is on time";
  late_plan(d, false);
  d.run(milliseconds(20));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
}

TEST(CoastNever, WhatIsOnlyToldChangesNothing) {
  Drive d;
  d.race();
  d.car.race_control.conflict = true;
  d.run(seconds(3));
  EXPECT_EQ(d.out.mode, Mode::kDriving);
  EXPECT_TRUE(d.out.causes.has(Cause::kFlagsDisagree));
  EXPECT_TRUE(d.out.seen.has(world::Monitor::kFlagAgreement));
  EXPECT_EQ(d.state.log.total, 1u) << "a rising edge once";
  EXPECT_EQ(d.out.cause, Cause::kNone);
}

}  // namespace
}  // namespace pitwall::safety
