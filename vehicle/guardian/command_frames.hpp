// Decoder of the car's commands on the bus, and encoder of the guardian's frames that continue
// them: every counter continues, the acknowledged flags and the dash switches stay as they were
// last sent, ct_report reports the coordinated stop.
//   in     frames from the bus; a command to send
//   out    up to 8 frames: brake 1400 first, throttle, steering, gear, ct_report, ct_report_2, dash
//          switches, accelerations; ct_report_2 and dash switches only if the car sent them before
//   units  as in the CAN database: degrees at the motor, %, kPa
//   errors a frame that cannot be decoded is ignored; a number that is not finite gives no frame
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

// Last command frames of the car.
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

// Returns true for a command of the car (1400..1402).
bool receive(ReceivedCommands& car, const can::ReceivedFrame& received);

CommandCounters counters_of(const ReceivedCommands& car);
world::ActuatorCommand command_of(const ReceivedCommands& car, double steering_ratio);

// The last frames unchanged, to initialise a frame gate for the next ones.
CommandFrames repeat(const ReceivedCommands& car);

struct CommandValues {
  world::ActuatorCommand command;
  double steering_ratio = kUnset;
  double ax_mps2 = kUnset, ay_mps2 = kUnset;  // unset: no accelerations are sent
};
// Next frames. `counters` holds the counters of the previous frames, and afterwards those of the
// new ones.
CommandFrames encode_frames(const ReceivedCommands& car, CommandCounters& counters,
                            const CommandValues& values);

}  // namespace pitwall::guardian
