// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/signal_change.hpp"

#include <gtest/gtest.h>

#include "tests/hil/faults/av21_frames.hpp"

namespace pitwall::faults {
namespace {

namespace av21 = can::av21;

av21::WheelSpeedReport wheels() {
  av21::WheelSpeedReport m;
  m.wheel_speed_FL = 100.0;
  m.wheel_speed_FR = 101.0;
  m.wheel_speed_RL = 102.0;
  m.wheel_speed_RR = 103.0;
  return m;
}

// The generated codec is the judge of where a signal lies.
TEST(SignalChange, MovesOneSignalAndNoOther) {
  for (std::uint8_t unit = 0; unit < 4; ++unit) {
    can::Frame frame = frame_of(wheels());
    add_to_signal(frame, unit, -20.5);
    const auto m = decoded<av21::WheelSpeedReport>(frame);
    const std::array<double, 4> stated{m.wheel_speed_FL, m.wheel_speed_FR, m.wheel_speed_RL,
                                       m.wheel_speed_RR};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(stated[i], 100.0 + static_cast<double>(i) - (i == unit ? 20.5 : 0.0), 1e-9);
  }
}

TEST(SignalChange, ANegativeAngleIsOne) {
  av21::SteeringReport m;
  m.steering_motor_ang_avg_fdbk = -10.0;
  m.steering_motor_fdbk_counter = 77;
  can::Frame frame = frame_of(m);
  add_to_signal(frame, 0, -5.5);
  EXPECT_EQ(decoded<av21::SteeringReport>(frame).steering_motor_ang_avg_fdbk, -15.5);
  set_signal(frame, 0, 10'000.0);
  EXPECT_EQ(decoded<av21::SteeringReport>(frame).steering_motor_ang_avg_fdbk, 511.5);
  set_signal(frame, 0, -10'000.0);
  EXPECT_EQ(decoded<av21::SteeringReport>(frame).steering_motor_ang_avg_fdbk, -512.0);
  EXPECT_EQ(decoded<av21::SteeringReport>(frame).steering_motor_fdbk_counter, 77.0);
}

TEST(SignalChange, TheOtherFieldsAreWhereTheDatabaseHasThem) {
  av21::BrakePressureReport brake;
  brake.brake_pressure_fdbk_front = brake.brake_pressure_fdbk_rear = 1000.0;
  brake.brk_pressure_fdbk_counter = 3;
  can::Frame frame = frame_of(brake);
  set_signal(frame, 1, 2000.0);
  EXPECT_EQ(decoded<av21::BrakePressureReport>(frame).brake_pressure_fdbk_front, 1000.0);
  EXPECT_EQ(decoded<av21::BrakePressureReport>(frame).brake_pressure_fdbk_rear, 2000.0);

  av21::MiscReport misc;
  misc.battery_voltage = 13.0;
  misc.sys_state = 9;
  misc.mode_switch_state = misc.raptor_rolling_counter = misc.safety_switch_state = 1;
  frame = frame_of(misc);
  set_signal(frame, 0, 77.0);
  EXPECT_EQ(decoded<av21::MiscReport>(frame).sys_state, 77.0);
  EXPECT_EQ(decoded<av21::MiscReport>(frame).battery_voltage, 13.0);

  av21::BaseToCarSummary summary;
  summary.base_to_car_heartbeat = 5;
  summary.track_flag = 4;
  summary.veh_flag = summary.veh_rank = summary.round_target_speed = summary.lap_count = 1;
  summary.lap_distance = 1;
  frame = frame_of(summary);
  set_signal(frame, 0, 13.0);
  EXPECT_EQ(decoded<av21::BaseToCarSummary>(frame).track_flag, 13.0);
  EXPECT_EQ(decoded<av21::BaseToCarSummary>(frame).base_to_car_heartbeat, 5.0);
}

TEST(SignalChange, AnotherMessageIsLeftAlone) {
  can::Frame frame;
  frame.id = 1340;
  frame.length = 8;
  const can::Frame before = frame;
  add_to_signal(frame, 0, 5.0);
  set_signal(frame, 3, 5.0);
  EXPECT_EQ(frame, before);
  EXPECT_FALSE(has_signal(1340, 0));
  EXPECT_TRUE(has_signal(1300, 3));
  EXPECT_FALSE(has_signal(1300, 4));
}

}  // namespace
}  // namespace pitwall::faults
