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
  double innovation_rad = 0.0, innovation_sigma_rad = 0.001;
  double front_turns = 1.0;  // share of the car's speed that both front wheels have
  double steering_off_rad = 0.0, front_kept = 1.0, rear_kept = 1.0, throttle_off = 0.0;
  std::array<double, world::kGnssUnits> yaw_rate_rad_per_s{kUnset, kUnset};  // of the IMUs
  world::SensorInput sensors;
  bool moves = true;
  double speed_mps = 50.0;

  FaultOutput tick() {
    now += milliseconds(10);
    car.at(now, speed_mps);
    car.ego.yaw_rate_rad_per_s = kUnset;
    for (auto* frame : {&car.signals.wheel_speed_mps, &car.signals.wheel_speed_before_mps})
      frame->value.at[0] = frame->value.at[1] = front_turns * speed_mps;
    car.signals.steering_motor_rad = {19.5 * reported.road_wheel_rad + steering_off_rad, now, true};
    car.signals.brake = {
        {front_kept * reported.brake_kpa, rear_kept * reported.brake_kpa}, now, true};
    car.signals.throttle_fraction = {reported.throttle_fraction + throttle_off, now, true};
    sensors.imu.clear();
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit)
      EXPECT_TRUE(sensors.imu.push(
          {.unit = unit, .at = now, .rate_rad_per_s = {0.0, 0.0, yaw_rate_rad_per_s[unit]}}));
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
                   .sensors = &sensors,
                   .reported = reported,
                   .wheelbase_m = 3.0,
                   .lock_slip = 0.1,
                   .innovation_rad = innovation_rad,
                   .innovation_sigma_rad = innovation_sigma_rad,
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
const std::array<ActuatorCase, 6> kActuatorCases{{
    {Cause::kSteeringDeviates, Monitor::kSteeringFollows,
     [](Axle& a) { a.steering_off_rad = -0.06; }},
    {Cause::kSteeringBiased, Monitor::kSteeringFollows,
     [](Axle& a) { a.innovation_rad = -0.0091; }},
    {Cause::kBrakeDeviates, Monitor::kBrakeFollows, [](Axle& a) { a.front_kept = 0.7; }},
    {Cause::kBrakeDeviates, Monitor::kBrakeFollows, [](Axle& a) { a.rear_kept = 0.7; }},
    {Cause::kThrottleDeviates, Monitor::kThrottleFollows, [](Axle& a) { a.throttle_off = 0.07; }},
    {Cause::kThrottleDeviates, Monitor::kThrottleFollows, [](Axle& a) { a.throttle_off = -0.07; }},
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

// A bent rod is told from a motor that does not follow: only the first leaves the sensor right.
TEST(ActuatorFaults, ACarThatTurnsElsewhereThanItsSteeringReportsIsBiased) {
  struct Case {
    double innovation_rad, sigma_rad, sensor_off_rad;
    bool strays, biased;
  };
  for (const Case& c :
       {Case{0.0091, 0.001, 0.0, false, true}, Case{0.0089, 0.001, 0.0, false, false},
        Case{-0.0191, 0.011, 0.0, false, true}, Case{0.0191, 0.012, 0.0, false, false},
        Case{0.02, 0.001, 0.1, true, false}, Case{kUnset, 0.001, 0.0, false, false},
        Case{0.02, kUnset, 0.0, false, false}}) {
    Axle a;
    a.run(seconds(1));
    a.innovation_rad = c.innovation_rad;
    a.innovation_sigma_rad = c.sigma_rad;
    a.steering_off_rad = c.sensor_off_rad;
    const FaultOutput out = a.run(milliseconds(150));
    EXPECT_EQ(out.causes.has(Cause::kSteeringDeviates), c.strays) << c.innovation_rad;
    EXPECT_EQ(out.causes.has(Cause::kSteeringBiased), c.biased) << c.innovation_rad;
    EXPECT_EQ(out.steering_biased, c.biased) << c.innovation_rad;
  }
}

TEST(ActuatorFaults, AnInnovationOfOneBumpIsNoBias) {
  Axle a;
  a.run(seconds(1));
  for (int bump = 0; bump < 20; ++bump) {
    a.innovation_rad = 0.03;
    EXPECT_FALSE(a.run(milliseconds(90)).steering_biased);
    a.innovation_rad = 0.0;
    EXPECT_FALSE(a.run(milliseconds(10)).steering_biased);
  }
  a.innovation_rad = 0.03;
  EXPECT_TRUE(a.run(milliseconds(100)).steering_biased);
}

// A wheel that is locked does not steer, and no rod is bent.
TEST(ActuatorFaults, FrontWheelsThatLockExplainACarThatDoesNotTurn) {
  for (const double turns : {0.5, 0.95}) {
    Axle a;
    a.run(seconds(1));
    a.innovation_rad = 0.03;
    a.front_turns = turns;
    const FaultOutput out = a.run(milliseconds(300));
    EXPECT_EQ(out.causes.has(Cause::kFrontLock), turns == 0.5);
    EXPECT_EQ(out.steering_biased, turns == 0.95);
  }
}

// While the IMUs differ by more than the steering would have to explain (0.008 rad at 50 m/s and a
// wheelbase of 3 m: 0.133 rad/s), the turning of the car says nothing of a rod.
TEST(ActuatorFaults, AnImuThatIsWrongExplainsACarThatSeemsToTurnElsewhere) {
  struct Case {
    std::array<double, world::kGnssUnits> yaw_rate_rad_per_s;
    bool biased;
  };
  for (const Case& c : {Case{{0.3, 0.3}, true}, Case{{0.3, 0.1}, false}, Case{{0.1, 0.3}, false},
                        Case{{0.3, 0.18}, true}, Case{{0.3, kUnset}, true}}) {
    Axle a;
    a.yaw_rate_rad_per_s = {0.1, 0.1};
    a.run(seconds(1));
    a.innovation_rad = 0.03;
    a.yaw_rate_rad_per_s = c.yaw_rate_rad_per_s;
    EXPECT_EQ(a.run(milliseconds(300)).steering_biased, c.biased) << c.yaw_rate_rad_per_s[1];
  }
}

// The IMU that is wrong is one thing, a rod that bends later another.
TEST(ActuatorFaults, ARodIsSeenAgainAsSoonAsTheImusAgree) {
  Axle a;
  a.yaw_rate_rad_per_s = {0.3, 0.1};
  a.innovation_rad = 0.03;
  EXPECT_FALSE(a.run(seconds(1)).steering_biased);
  a.yaw_rate_rad_per_s = {0.1, 0.1};
  EXPECT_TRUE(a.run(milliseconds(250)).steering_biased);
}

TEST(ActuatorFaults, WithinTheToleranceIsNone) {
  Axle a;
  a.innovation_rad = 0.0085;
  a.steering_off_rad = 0.045;
  a.front_kept = a.rear_kept = 0.8;
  a.throttle_off = -0.055;
  EXPECT_TRUE(a.run(seconds(5)).causes.empty());
}

}  // namespace
}  // namespace pitwall::safety
