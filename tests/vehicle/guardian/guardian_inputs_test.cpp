// What the guardian takes from the bus, and the limits at which it acts: each number at its limit
// and beyond it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "tests/vehicle/guardian/straight.hpp"

namespace pitwall::guardian {
namespace {

const world::SensorInput kNothingSensed;

template <class M>
can::ReceivedFrame received_at(const M& message, Instant at) {
  can::EncodeCounters none;
  can::ReceivedFrame received;
  EXPECT_TRUE(av21::encode(message, received.frame, none));
  received.at = at;
  return received;
}

void hear_one(State& state, const can::ReceivedFrame& received) {
  (void)step({}, state, {.can = {&received, 1}, .sensors = kNothingSensed, .now = received.at});
}

can::ReceivedFrame wheels_at(const std::array<double, 4>& kmph, Instant at) {
  av21::WheelSpeedReport m;
  m.wheel_speed_FL = kmph[0], m.wheel_speed_FR = kmph[1];
  m.wheel_speed_RL = kmph[2], m.wheel_speed_RR = kmph[3];
  return received_at(m, at);
}

constexpr Instant kAt{seconds(10).ns};

TEST(GuardianInputs, WheelSpeedsAreEachWheelsInMetresPerSecond) {
  State state;
  hear_one(state, wheels_at({36.0, 72.0, 108.0, 144.0}, kAt));
  const auto& wheels = state.signals.wheel_speed_mps;
  ASSERT_TRUE(wheels.received);
  EXPECT_EQ(wheels.at, kAt);
  const std::array expected{10.0, 20.0, 30.0, 40.0};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(wheels.value.at[i], expected[i], 1e-9) << i;
}

// 432 km/h are 120 m/s. A report of which one wheel is out of range is not taken at all.
TEST(GuardianInputs, AWheelBeyondEveryCarIsNotTaken) {
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    for (const auto& [kmph, is_taken] :
         {std::pair{0.0, true}, std::pair{432.0, true}, std::pair{434.0, false}}) {
      State state;
      can::ReceivedFrame received = wheels_at({100.0, 100.0, 100.0, 100.0}, kAt);
      const auto raw = static_cast<unsigned>(10.0 * kmph);  // beyond what our encoder would write
      received.frame.data[2 * wheel] = static_cast<std::uint8_t>(raw & 0xFFU);
      received.frame.data[2 * wheel + 1] = static_cast<std::uint8_t>(raw >> 8U);
      hear_one(state, received);
      EXPECT_EQ(state.signals.wheel_speed_mps.received, is_taken) << wheel << " at " << kmph;
    }
  }
}

TEST(GuardianInputs, TheSteeringIsTheMotorsAngle) {
  State state;
  av21::SteeringReport m;
  m.steering_motor_ang_avg_fdbk = -90.0;
  m.steering_motor_fdbk_counter = 1;
  hear_one(state, received_at(m, kAt));
  ASSERT_TRUE(state.signals.steering_motor_rad.received);
  EXPECT_NEAR(state.signals.steering_motor_rad.value, -std::acos(-1.0) / 2.0, 1e-12);
  EXPECT_EQ(state.signals.steering_motor_rad.at, kAt);
  EXPECT_FALSE(state.signals.wheel_speed_mps.received);
}

// Of two frames, and of one wheel alone only if it agreed with the others without brake.
TEST(GuardianInputs, ASlippingFrontWheelIsFoundAsInTheCar) {
  const auto brake = [](double kpa, std::uint8_t counter, Instant at) {
    av21::BrakePressureReport m;
    m.brake_pressure_fdbk_front = m.brake_pressure_fdbk_rear = kpa;
    m.brk_pressure_fdbk_counter = counter;
    return received_at(m, at);
  };
  for (const bool rolled : {false, true}) {
    State state;
    Instant at = kAt;
    const auto receive_next = [&](const can::ReceivedFrame& received) {
      hear_one(state, received);
      at += milliseconds(5);
    };
    receive_next(brake(rolled ? 0.0 : 2000.0, 1, at));
    for (int frame = 0; frame < 2; ++frame)
      receive_next(wheels_at({144.0, 144.0, 144.0, 144.0}, at));
    receive_next(brake(2000.0, 2, at));
    receive_next(wheels_at({108.0, 144.0, 144.0, 144.0}, at));
    EXPECT_NEAR(state.front_slip, 0.0, 1e-9) << "one frame";
    receive_next(wheels_at({108.0, 144.0, 144.0, 144.0}, at));
    EXPECT_NEAR(state.front_slip, rolled ? 0.25 : 0.0, 1e-9);
  }
}

TEST(GuardianInputs, AFrameOfAnotherLengthIsNotTaken) {
  State state;
  can::ReceivedFrame wheels = wheels_at({36.0, 36.0, 36.0, 36.0}, kAt);
  --wheels.frame.length;
  hear_one(state, wheels);
  can::ReceivedFrame steering = received_at(
      av21::SteeringReport{.steering_motor_ang_avg_fdbk = 5.0, .steering_motor_fdbk_counter = 1},
      kAt);
  --steering.frame.length;
  hear_one(state, steering);
  EXPECT_FALSE(state.signals.wheel_speed_mps.received);
  EXPECT_FALSE(state.signals.steering_motor_rad.received);
}

// The ids of the car's own commands are contiguous; everybody else keeps the bus alive.
TEST(GuardianInputs, OnlyWhatOthersSayKeepsTheBusAlive) {
  for (const can::MessageRow& row : av21::kMessages) {
    State state;
    can::ReceivedFrame received;
    received.frame.id = row.id;
    received.frame.length = row.length;
    received.at = kAt;
    hear_one(state, received);
    const bool of_car =
        row.id >= av21::BrakePressureCmd::kId && row.id <= av21::CtVehicleAccFeedback::kId;
    EXPECT_EQ(state.others_at, of_car ? Instant{} : kAt) << row.id;
    received.at = kAt - milliseconds(1);
    hear_one(state, received);
    EXPECT_EQ(state.others_at, of_car ? Instant{} : kAt) << "an older frame moves nothing back";
  }
}

// Of a car that drove for a second: what it takes at the thirtieth millisecond of silence.
struct Silent {
  Straight car = silent_for(milliseconds(29));
  Silent() { EXPECT_EQ(car.mode(), Mode::kWatching); }
  std::pair<Mode, Cause> act() {
    car.tick();
    return {car.mode(), car.cause()};
  }
};
const std::pair kActs{Mode::kDriving, Cause::kCarSilent};

TEST(GuardianLimits, ABusIsAliveForItsSilenceAndNotLonger) {
  for (const int beyond_ns : {0, 1}) {
    Silent silent;
    silent.car.bus_lives = false;
    silent.car.state.others_at = silent.car.now + milliseconds(1) -
                                 silent.car.params.bus_silence_max - nanoseconds(beyond_ns);
    EXPECT_EQ(silent.act(),
              beyond_ns == 0 ? kActs : std::pair(Mode::kNothingToDrive, Cause::kBusSilent));
  }
}

TEST(GuardianLimits, ARecordMayLagBehindTheLastCommand) {
  for (const int beyond_ns : {0, 1}) {
    Silent silent;
    State& state = silent.car.state;
    state.record.at = state.received.commanded_at - kRecordLag - nanoseconds(beyond_ns);
    EXPECT_EQ(silent.act(),
              beyond_ns == 0 ? kActs : std::pair(Mode::kNothingToDrive, Cause::kStale));
  }
}

TEST(GuardianLimits, APathHasTwoPoints) {
  for (const std::size_t points : {1U, 2U}) {
    Silent silent;
    auto& stop = silent.car.state.record.stop.points;
    const auto whole = stop;
    stop.clear();
    (void)stop.push(whole[0]);
    if (points == 2) (void)stop.push(whole[whole.size() - 1]);
    EXPECT_EQ(silent.act(), points == 2 ? kActs : std::pair(Mode::kNothingToDrive, Cause::kNoPath));
  }
}

TEST(GuardianLimits, ACarIsOnItsPathToFiveMetresBesideIt) {
  for (const double side : {-1.0, 1.0}) {
    for (const double beyond_m : {-0.01, 0.01}) {
      Silent silent;
      const double offset_m = side * (silent.car.params.off_path_max_m + beyond_m);
      for (auto& point : silent.car.state.record.stop.points) point.y_m = offset_m;
      EXPECT_EQ(silent.act(),
                beyond_m < 0 ? kActs : std::pair(Mode::kNothingToDrive, Cause::kOffPath))
          << offset_m;
    }
  }
}

// A car that moves by itself is guarded; one that nobody armed, or that is driven by hand, is not.
TEST(GuardianLimits, TheModesInWhichItIsGuarded) {
  using enum world::Mode;
  for (std::size_t i = 0; i < world::kModes; ++i) {
    const auto mode = static_cast<world::Mode>(i);
    const bool moves =
        mode == kDriving || mode == kCoast || mode == kControlledStop || mode == kEmergencyStop;
    for (const bool armed : {true, false}) {
      Silent silent;
      silent.car.state.record.mode = mode;
      silent.car.state.record.armed = armed;
      silent.act();
      EXPECT_EQ(silent.car.mode(), moves && armed ? Mode::kDriving : Mode::kIdle) << i << armed;
      EXPECT_TRUE(silent.car.out.mode_changed);
      EXPECT_EQ(silent.car.state.status.takeovers, moves && armed ? 1U : 0U);
    }
  }
}

TEST(GuardianLimits, SoonAfterAHandBackItKeepsTheCar) {
  for (const int beyond_ns : {0, 1}) {
    Silent silent;
    silent.car.state.handed_back = true;
    silent.car.state.handed_back_at = silent.car.now + milliseconds(1) -
                                      silent.car.params.hand_back_again + nanoseconds(beyond_ns);
    silent.act();
    EXPECT_EQ(silent.car.state.status.latched, beyond_ns == 1);
  }
  Silent first;
  first.car.state.handed_back_at = first.car.now;  // of nothing that was handed back
  first.act();
  EXPECT_FALSE(first.car.state.status.latched);
}

TEST(GuardianLimits, APositionGuidesForItsAge) {
  for (const int beyond_ns : {0, 1}) {
    Silent silent;
    silent.act();
    ReckoningState& reckoning = silent.car.state.reckoning;
    reckoning.positioned = true;
    reckoning.position_at = silent.car.now + milliseconds(10) - silent.car.params.position_age_max -
                            nanoseconds(beyond_ns);
    silent.car.run(milliseconds(10));
    EXPECT_EQ(silent.car.state.status.guidance,
              beyond_ns == 0 ? Guidance::kPosition : Guidance::kInertial);
  }
  Silent never;
  never.act();
  never.car.state.reckoning.positioned = false;
  never.car.state.reckoning.position_at = never.car.now;
  never.car.run(milliseconds(10));
  EXPECT_EQ(never.car.state.status.guidance, Guidance::kInertial);
}

TEST(GuardianLimits, TheSameReasonIsEnteredOnce) {
  Silent silent;
  silent.car.state.record.stop.points.clear();
  silent.act();
  EXPECT_TRUE(silent.car.out.mode_changed);
  EXPECT_EQ(silent.car.cause(), Cause::kNoPath);
  const Instant entered = silent.car.state.status.since;
  for (int i = 0; i < 10; ++i) {
    silent.act();
    EXPECT_FALSE(silent.car.out.mode_changed);
  }
  EXPECT_EQ(silent.car.state.status.since, entered);
  silent.car.state.record.at = {};
  silent.act();
  EXPECT_EQ(silent.car.cause(), Cause::kStale) << "another reason is";
}

}  // namespace
}  // namespace pitwall::guardian
