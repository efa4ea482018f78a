// Common parts of the frame gate's tests: frames as a car sends them, and a gate with a clock.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/can/encode.hpp"
#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety::testing {

inline constexpr std::array kAllModes{world::Mode::kDisarmed,      world::Mode::kStandby,
                                      world::Mode::kDriving,       world::Mode::kControlledStop,
                                      world::Mode::kEmergencyStop, world::Mode::kHalted,
                                      world::Mode::kCoast};

template <class M>
can::Frame frame_of(const M& message) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(can::av21::encode(message, frame, counters)) << M::kName;
  return frame;
}
inline can::Frame steer(double deg, int counter = 0) {
  can::av21::SteeringCmd m;
  m.steering_motor_ang_cmd = deg;
  m.steering_motor_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
inline can::Frame brake(double kpa, int counter = 0) {
  can::av21::BrakePressureCmd m;
  m.brake_pressure_cmd = kpa;
  m.brk_pressure_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
inline can::Frame throttle(double percent, int counter = 0) {
  can::av21::AcceleratorCmd m;
  m.acc_pedal_cmd = percent;
  m.acc_pedal_cmd_counter = counter & 0xFF;
  return frame_of(m);
}
inline can::Frame gear(int number) {
  can::av21::GearShiftCmd m;
  m.desired_gear = number;
  return frame_of(m);
}
inline can::Frame report(int ct_state, int counter = 0) {
  can::av21::CtReport m;
  m.veh_sig_ack = m.track_cond_ack = 0;
  m.ct_state = ct_state;
  m.ct_state_rolling_counter = counter % 10;
  m.veh_num = 1;
  return frame_of(m);
}
inline can::Frame switches(int aim, int range) {
  can::av21::DashSwitchesCmd m;
  m.driver_traction_aim_switch = aim;
  m.driver_traction_range_switch = range;
  return frame_of(m);
}
inline can::Frame blank(std::uint32_t id, std::uint8_t length) {
  can::Frame frame;
  frame.id = id;
  frame.length = length;
  return frame;
}
// A frame of this id that passes every rule, with this counter if the message has one.
inline can::Frame harmless(std::uint32_t id, int counter) {
  if (id == 1400) return brake(0, counter);
  if (id == 1401) return throttle(0, counter);
  if (id == 1402) return steer(0, counter);
  if (id == 1403) return gear(3);
  if (id == 1404) return report(9, counter);
  return blank(id, 8);
}
inline constexpr std::array kOurIds{1400u, 1401u, 1402u, 1403u, 1404u, 1405u, 1406u, 1450u};

inline const can::MessageRow* row_of(std::uint32_t id) {
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.id == id) return &row;
  return nullptr;
}

// A gate that has run for 100 s, armed and driving; the command is fresh after every wait.
struct Gate {
  GateParams params;
  GateState state;
  GateContext context{.mode = world::Mode::kDriving,
                      .armed = true,
                      .speed_mps = 30.0,
                      .command_at = Instant{} + seconds(100),
                      .now = Instant{} + seconds(100)};

  void wait(Duration span) { context.command_at = context.now = context.now + span; }
  GateOutput all(const std::vector<can::Frame>& frames) {
    return gate(params, state, context, frames);
  }
  Verdict one(const can::Frame& frame) {
    const GateOutput out = all({frame});
    EXPECT_EQ(out.verdicts.size(), 1u);
    EXPECT_EQ(out.verdicts[0].id, frame.id);
    const Verdict verdict = out.verdicts[0].verdict;
    EXPECT_EQ(out.refused_now, verdict != Verdict::kPass);
    EXPECT_EQ(out.first_refusal, verdict);
    EXPECT_EQ(out.frames.size(), verdict == Verdict::kPass ? 1u : 0u);
    if (verdict == Verdict::kPass) {
      EXPECT_EQ(out.frames[0], frame) << "never repaired";
    }
    return verdict;
  }
  std::uint64_t count(Verdict verdict) const {
    return state.verdicts[static_cast<std::size_t>(verdict)];
  }
};

}  // namespace pitwall::safety::testing
