// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/command_frames.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/can/manifest.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall::guardian {
namespace {

namespace av21 = can::av21;

template <class M>
can::ReceivedFrame frame_of(const M& message, Instant at = Instant{}) {
  can::EncodeCounters none;
  can::ReceivedFrame received;
  EXPECT_TRUE(av21::encode(message, received.frame, none));
  received.at = at;
  return received;
}

av21::BrakePressureCmd brake(double kpa, double counter) {
  av21::BrakePressureCmd m;
  m.brake_pressure_cmd = kpa;
  m.brk_pressure_cmd_counter = counter;
  return m;
}

ReceivedCommands a_car() {
  ReceivedCommands car;
  receive(car, frame_of(brake(120.0, 41)));
  av21::AcceleratorCmd throttle;
  throttle.acc_pedal_cmd = 50.0;
  throttle.acc_pedal_cmd_counter = 42;
  receive(car, frame_of(throttle));
  av21::SteeringCmd steering;
  steering.steering_motor_ang_cmd = 19.5;
  steering.steering_motor_cmd_counter = 43;
  receive(car, frame_of(steering));
  av21::GearShiftCmd gear;
  gear.desired_gear = 4;
  receive(car, frame_of(gear));
  av21::CtReport report;
  report.veh_sig_ack = 1;
  report.track_cond_ack = 2;
  report.ct_state = 9;
  report.ct_state_rolling_counter = 9;
  report.veh_num = 21;
  receive(car, frame_of(report));
  return car;
}

TEST(CommandFrames, ReceiveTheCommandsAndTheirTimes) {
  ReceivedCommands car;
  EXPECT_FALSE(car.complete());
  EXPECT_TRUE(receive(car, frame_of(brake(100.0, 1), Instant{5})));
  EXPECT_TRUE(receive(car, frame_of(brake(100.0, 2), Instant{3}))) << "late, but a command";
  EXPECT_EQ(car.commanded_at, Instant{5}) << "time does not run backwards";
  av21::GearShiftCmd gear;
  gear.desired_gear = 3;
  EXPECT_FALSE(receive(car, frame_of(gear, Instant{9}))) << "the gear alone steers nothing";
  EXPECT_EQ(car.commanded_at, Instant{5});
  EXPECT_TRUE(a_car().complete());
}

TEST(CommandFrames, IgnoreWhatIsNoCommand) {
  ReceivedCommands car;
  can::ReceivedFrame received = frame_of(brake(100.0, 1));
  for (const int what : {0, 1, 2, 3}) {
    can::ReceivedFrame wrong = received;
    if (what == 0) wrong.frame.extended = true;
    if (what == 1) wrong.frame.remote = true;
    if (what == 2) wrong.frame.fd = true;
    if (what == 3) wrong.frame.length = 1;
    EXPECT_FALSE(receive(car, wrong)) << what;
  }
  EXPECT_FALSE(car.commanded);
}

TEST(CommandFrames, HoldTheLastCommand) {
  const ReceivedCommands car = a_car();
  const world::ActuatorCommand command = command_of(car, 19.5);
  EXPECT_NEAR(command.road_wheel_rad, from_deg(1.0), 1e-3);
  EXPECT_DOUBLE_EQ(command.throttle_fraction, 0.5);
  EXPECT_DOUBLE_EQ(command.brake_kpa, 120.0);
  EXPECT_EQ(command.gear, 4);
  const CommandCounters counters = counters_of(car);
  EXPECT_EQ(counters.brake, 41);
  EXPECT_EQ(counters.throttle, 42);
  EXPECT_EQ(counters.steering, 43);
  EXPECT_EQ(counters.report, 9);
}

TEST(CommandFrames, RepeatItBitForBit) {
  const CommandFrames frames = repeat(a_car());
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[0], frame_of(brake(120.0, 41)).frame);
}

TEST(CommandFrames, SendOnlyWhatTheDatabaseGivesToTheComputer) {
  ReceivedCommands car = a_car();
  receive(car, frame_of(av21::CtReport2{.marelli_track_flag_ack = 1,
                                        .marelli_vehicle_flag_ack = 2,
                                        .marelli_sector_flag_ack = 3}));
  receive(car, frame_of(av21::DashSwitchesCmd{.driver_traction_aim_switch = 1,
                                              .driver_traction_range_switch = 2}));
  CommandCounters counters = counters_of(car);
  const CommandFrames frames = encode_frames(
      car, counters,
      {.command = {.road_wheel_rad = 0.01, .throttle_fraction = 0.0, .brake_kpa = 900.0, .gear = 4},
       .steering_ratio = 19.5,
       .ax_mps2 = -5.0,
       .ay_mps2 = 1.0});
  ASSERT_EQ(frames.size(), kCommandFrames);
  EXPECT_EQ(frames[0].id, av21::BrakePressureCmd::kId) << "the brake first";
  for (const can::Frame& frame : frames) {
    bool ours = false;
    for (const can::MessageRow& row : av21::kMessages)
      ours |= row.id == frame.id && row.direction == can::Direction::kToCar;
    EXPECT_TRUE(ours) << frame.id;
  }
  EXPECT_EQ(counters.report, 0) << "runs 0..9";
}

TEST(CommandFrames, AreNotSentWithANumberThatIsNone) {
  const ReceivedCommands car = a_car();
  CommandCounters counters;
  const CommandFrames frames =
      encode_frames(car, counters, {.command = {.gear = 4}, .steering_ratio = 19.5});
  for (const can::Frame& frame : frames)
    EXPECT_TRUE(frame.id == av21::GearShiftCmd::kId || frame.id == av21::CtReport::kId) << frame.id;
}

}  // namespace
}  // namespace pitwall::guardian
