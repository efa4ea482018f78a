// The car's commands on the bus, as the guardian hears them and goes on with them: every counter
// continues, the flags stay acknowledged as the autonomy did last, the dash switches stay.
//   in     frames off the bus; a command to speak
//   out    up to 8 frames: brake 1400 first, throttle, steering, gear, ct_report, ct_report_2, dash
//          switches, accelerations; a message that the car never sent is left out
//   units  as in the CAN database: degrees at the motor, %, kPa
//   errors a frame that does not decode is not heard; a number that is not finite gives no frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "protocol/can/av21.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/guardian/record.hpp"
#include "vehicle/world/actuator_command.hpp"

namespace pitwall::guardian {

inline constexpr std::size_t kCommandFrames = 8;
using CommandFrames = FixedVector<can::Frame, kCommandFrames>;

// What the car said last.
struct ReceivedCommands {
  std::optional<can::av21::BrakePressureCmd> brake;
  std::optional<can::av21::AcceleratorCmd> throttle;
  std::optional<can::av21::SteeringCmd> steering;
  std::optional<can::av21::GearShiftCmd> gear;
  std::optional<can::av21::CtReport> report;
  std::optional<can::av21::CtReport2> report_2;
  std::optional<can::av21::DashSwitchesCmd> dash;
  Instant commanded_at{};  // newest of 1400..1402
  bool commanded = false;

  bool complete() const { return brake && throttle && steering && gear && report; }
};
static_assert(std::is_trivially_copyable_v<ReceivedCommands>);

// True if it was one of the car's commands (1400..1402).
bool receive(ReceivedCommands& car, const can::ReceivedFrame& received);

CommandCounters counters_of(const ReceivedCommands& car);
world::ActuatorCommand command_of(const ReceivedCommands& car, double steering_ratio);

// The last frames as they were: what a frame gate has to have seen to judge the next ones.
CommandFrames repeat(const ReceivedCommands& car);

struct CommandValues {
  world::ActuatorCommand command;
  double steering_ratio = kUnset;
  double ax_mps2 = kUnset, ay_mps2 = kUnset;  // unset: no accelerations are sent
};
// Goes on: `counters` are those of the frames before, and afterwards those of these.
CommandFrames encode_frames(const ReceivedCommands& car, CommandCounters& counters,
                            const CommandValues& values);

}  // namespace pitwall::guardian
