// SPDX-License-Identifier: Apache-2.0
// Steering, brake and throttle that do not do as they are told, as causes of the car.
#include <gtest/gtest.h>

#include <functional>

#include "tests/vehicle/safety/situation.hpp"
#include "vehicle/safety/fault_detection.hpp"

namespace pitwall::safety {
namespace {

using testing::Situation;
using world::Monitor;
using world::SysState;

// A car at 50 m/s whose actuators are where they were told to be.
struct Axle {
  FaultParams params;
  FaultState state;
  Situation car;
  Instant now = Instant{} + seconds(10);
  world::ActuatorCommand reported{
      .at = {}, .road_wheel_rad = 0.02, .throttle_fraction = 0.4, .brake_kpa = 1000.0, .gear = 4};
  double steering_off_rad = 0.0, front_kept = 1.0, rear_kept = 1.0, throttle_off = 0.0;
  bool moves = true;
  double speed_mps = 50.0;

  FaultOutput tick() {
    now += milliseconds(10);
    car.at(now, speed_mps);
    car.ego.yaw_rate_rad_per_s = kUnset;
    car.signals.steering_motor_rad = {19.5 * reported.road_wheel_rad + steering_off_rad, now, true};
    car.signals.brake = {
        {front_kept * reported.brake_kpa, rear_kept * reported.brake_kpa}, now, true};
    car.signals.throttle_fraction = {reported.throttle_fraction + throttle_off, now, true};
    return detect(params, state,
                  {.signals = car.signals,
                   .bus = car.bus,
                   .race_control = car.race_control,
                   .ego = car.ego,
                   .watchdog = car.watchdog,
                   .operator_requests = {.arm = true},
                   .control_ok = true,
                   .driving = moves,
                   .moves = moves,
                   .reported = reported,
                   .speed_mps = speed_mps},
                  now);
  }
  FaultOutput run(Duration span) {
    FaultOutput out;
    for (const Instant end = now + span; now < end;) out = tick();
    return out;
  }
};

struct ActuatorCase {
  Cause cause;
  Monitor monitor;
  std::function<void(Axle&)> spoil;
};
const std::array<ActuatorCase, 5> kActuatorCases{{
    {Cause::kSteeringStrays, Monitor::kSteeringFollows,
     [](Axle& a) { a.steering_off_rad = -0.06; }},
    {Cause::kBrakeStrays, Monitor::kBrakeFollows, [](Axle& a) { a.front_kept = 0.7; }},
    {Cause::kBrakeStrays, Monitor::kBrakeFollows, [](Axle& a) { a.rear_kept = 0.7; }},
    {Cause::kThrottleStrays, Monitor::kThrottleFollows, [](Axle& a) { a.throttle_off = 0.07; }},
    {Cause::kThrottleStrays, Monitor::kThrottleFollows, [](Axle& a) { a.throttle_off = -0.07; }},
}};

TEST(ActuatorFaults, EachIsItsOwnCauseWithinItsDeadlineAndItsMonitorSeesIt) {
  for (const ActuatorCase& c : kActuatorCases) {
    for (const bool off : {false, true}) {
      Axle a;
      if (off) a.params.off.add(c.monitor);
      ASSERT_TRUE(a.run(seconds(1)).causes.empty());
      c.spoil(a);
      const FaultOutput out = a.run(row_of(c.cause).deadline);
      CauseSet expected;
      if (!off) expected.add(c.cause);
      EXPECT_EQ(out.causes, expected) << text_of(c.cause);
      EXPECT_EQ(out.seen.has(c.monitor), !off) << text_of(c.cause);
    }
  }
}

TEST(ActuatorFaults, WhatTheDriveByWireDoesByItselfIsNoFaultOfTheActuators) {
  const std::array<std::function<void(Axle&)>, 5> excuses{
      [](Axle& a) { a.moves = false; }, [](Axle& a) { a.speed_mps = 2.9; },
      [](Axle& a) { a.car.signals.misc.value.sys_state = SysState::kEngineRunning; },
      [](Axle& a) { a.car.signals.diagnostics.value.emergency_brake = true; },
      [](Axle& a) { a.car.signals.diagnostics.value.computer_heartbeat_lost = true; }};
  for (const auto& excuse : excuses)
    for (const ActuatorCase& c : kActuatorCases) {
      Axle a;
      excuse(a);
      c.spoil(a);
      EXPECT_FALSE(a.run(seconds(2)).causes.has(c.cause)) << text_of(c.cause);
    }
}

TEST(ActuatorFaults, WithinTheToleranceIsNone) {
  Axle a;
  a.steering_off_rad = 0.045;
  a.front_kept = a.rear_kept = 0.8;
  a.throttle_off = -0.055;
  EXPECT_TRUE(a.run(seconds(5)).causes.empty());
}

}  // namespace
}  // namespace pitwall::safety
