// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/outbound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/vehicle/gateway/traffic.hpp"

namespace pitwall::gateway {
namespace {

using namespace testing;

struct CommandSender {
  OutboundParams params;
  OutboundState state;
  OutboundInputs inputs;
  Instant now{};

  CommandSender() {
    inputs.command = {
        .at = {}, .road_wheel_rad = 0.02, .throttle_fraction = 0.3, .brake_kpa = 0.0, .gear = 3};
    inputs.actuate = true;
    inputs.ct_state = world::CtState::kNominalRace;
    inputs.ego.ax_mps2 = 4.9;
    inputs.ego.ay_mps2 = -9.8;
  }
  OutboundOutput tick() {
    now += milliseconds(10);
    return encode(params, state, inputs, now);
  }
};

template <class M>
M message_in(const OutboundOutput& out) {
  M message;
  for (const can::Frame& frame : out.frames)
    if (av21::decode(frame, message)) return message;
  ADD_FAILURE() << "no " << M::kName;
  return message;
}

TEST(Outbound, WhatIsSentIsWhatWasCommandedWithinTheField) {
  Random random{5};
  CommandSender car;
  for (int i = 0; i < 2000; ++i) {
    auto& c = car.inputs.command;
    c.road_wheel_rad = random.between(-0.2, 0.2);
    c.throttle_fraction = random.between(0.0, 1.0);
    c.brake_kpa = random.between(0.0, 6000.0);
    c.gear = static_cast<std::uint8_t>(random.below(7));
    const OutboundOutput out = car.tick();
    const double motor_deg = c.road_wheel_rad * 180.0 / 3.14159265358979 * 19.5;
    EXPECT_NEAR(message_in<av21::SteeringCmd>(out).steering_motor_ang_cmd, motor_deg, 0.2501);
    EXPECT_NEAR(message_in<av21::AcceleratorCmd>(out).acc_pedal_cmd, 100.0 * c.throttle_fraction,
                0.00501);
    EXPECT_NEAR(message_in<av21::BrakePressureCmd>(out).brake_pressure_cmd, c.brake_kpa, 0.501);
    EXPECT_EQ(message_in<av21::GearShiftCmd>(out).desired_gear, c.gear);
    EXPECT_EQ(message_in<av21::CtReport>(out).ct_state, 9);
    EXPECT_EQ(message_in<av21::CtReport>(out).veh_num, 255);
    EXPECT_NEAR(message_in<av21::CtVehicleAccFeedback>(out).lat_ct_vehicle_acc_fbk, -1.0, 0.0051);
    EXPECT_EQ(out.counters.saturated + out.counters.not_finite, 0u);
    EXPECT_EQ(out.frames[0].id, av21::BrakePressureCmd::kId) << "the brake goes first";
  }
}

TEST(Outbound, EveryCounterChangesOnEveryFrame) {
  CommandSender car;
  std::map<std::uint32_t, double> last;
  const auto check = [&](std::uint32_t id, double counter) {
    const auto found = last.find(id);
    if (found != last.end()) {
      EXPECT_NE(found->second, counter) << id;
    }
    last[id] = counter;
  };
  for (int i = 0; i < 600; ++i) {
    const OutboundOutput out = car.tick();
    check(1400, message_in<av21::BrakePressureCmd>(out).brk_pressure_cmd_counter);
    check(1401, message_in<av21::AcceleratorCmd>(out).acc_pedal_cmd_counter);
    check(1402, message_in<av21::SteeringCmd>(out).steering_motor_cmd_counter);
    for (const can::Frame& frame : out.frames) {
      av21::CtReport report;
      if (!av21::decode(frame, report)) continue;
      check(1404, report.ct_state_rolling_counter);
      EXPECT_LE(report.ct_state_rolling_counter, 9);
    }
  }
}

TEST(Outbound, EachMessageKeepsItsPeriodUnderJitter) {
  Random random{9};
  CommandSender car;
  std::map<std::uint32_t, int> sent;
  const int ticks = 3000;
  for (int i = 0; i < ticks; ++i) {
    const Instant now =
        at_ms(1000 + 10 * i) + microseconds(static_cast<std::int64_t>(random.below(2001)) - 1000);
    for (const can::Frame& frame : encode(car.params, car.state, car.inputs, now).frames)
      ++sent[frame.id];
  }
  for (const can::MessageRow& row : av21::kMessages) {
    if (row.direction != can::Direction::kToCar) continue;
    const double expected = ticks * 0.01 / row.period.seconds();
    EXPECT_NEAR(sent[row.id], expected, 1.5) << row.name;
  }
}

TEST(Outbound, APauseIsNotCaughtUpWithABurst) {
  CommandSender car;
  for (int i = 0; i < 30; ++i) car.tick();
  car.now += seconds(5);
  std::size_t frames = 0;
  for (int i = 0; i < 10; ++i) frames += car.tick().frames.size();
  EXPECT_LE(frames, 80u);
  Instant later = car.now;
  const OutboundOutput again = encode(car.params, car.state, car.inputs, later);
  EXPECT_EQ(again.frames.size(), 0u) << "twice in one tick";
}

TEST(Outbound, DisarmedSendsNoActuatorFrame) {
  CommandSender car;
  car.inputs.actuate = false;
  car.inputs.command = {};
  for (int i = 0; i < 50; ++i) {
    const OutboundOutput out = car.tick();
    for (const can::Frame& frame : out.frames) EXPECT_GE(frame.id, av21::CtReport::kId);
    EXPECT_EQ(out.counters.not_finite, 0u) << "nothing was asked, so nothing was refused";
  }
}

TEST(Outbound, ANumberThatIsNotFiniteGivesNoFrameAndIsCounted) {
  for (const double bad : {kUnset, HUGE_VAL, -HUGE_VAL}) {
    CommandSender car;
    car.inputs.command.road_wheel_rad = bad;
    car.inputs.command.brake_kpa = bad;
    const OutboundOutput out = car.tick();
    EXPECT_EQ(out.counters.not_finite, 2u);
    for (const can::Frame& frame : out.frames) {
      EXPECT_NE(frame.id, av21::SteeringCmd::kId);
      EXPECT_NE(frame.id, av21::BrakePressureCmd::kId);
    }
  }
}

TEST(Outbound, FlagsAreEchoedInTheMessageOfTheirEncoding) {
  for (const auto lead : {world::FlagEncoding::kMyLaps, world::FlagEncoding::kMarelli}) {
    CommandSender car;
    auto& rc = car.inputs.acted_on;
    rc.encoding = lead;
    rc.raw_track = 4;
    rc.raw_vehicle = 7;
    rc.raw_sector = 2;
    rc.other_raw_track = 37;
    rc.other_raw_vehicle = 36;
    rc.other_raw_sector = 9;
    const OutboundOutput out = car.tick();
    const auto report = message_in<av21::CtReport>(out);
    const auto report_2 = message_in<av21::CtReport2>(out);
    const bool mylaps = lead == world::FlagEncoding::kMyLaps;
    EXPECT_EQ(report.track_cond_ack, mylaps ? 4 : 37);
    EXPECT_EQ(report.veh_sig_ack, mylaps ? 7 : 36);
    EXPECT_EQ(report_2.marelli_track_flag_ack, mylaps ? 37 : 4);
    EXPECT_EQ(report_2.marelli_vehicle_flag_ack, mylaps ? 36 : 7);
    EXPECT_EQ(report_2.marelli_sector_flag_ack, mylaps ? 9 : 2);
  }
}

}  // namespace
}  // namespace pitwall::gateway
