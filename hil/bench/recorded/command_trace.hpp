// Trace of a recorded run: its modes and actuator commands over the time of the run.
//   in     a RecordedRun, from its first tick; the CAN database of its bus
//   out    changes of the mode; each command of each actuator; inputs that came neither by the bus
//          nor by a receiver
//   units  time since the first tick; commands in the units of the database
//   invariants
//          in the order of the run; the mode is that of the recorded state, at every second tick
//   errors those of RecordedRun; Problem for a command that cannot be decoded
//   cost   the whole run is read; 16 bytes a command
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hil/bench/recorded/recorded_run.hpp"
#include "hil/scenario/radio_section.hpp"
#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

enum class Actuator : std::uint8_t { kAccelerator, kBrake, kSteering, kGear };
inline constexpr std::size_t kActuators = 4;

struct CommandSignal {
  std::string_view message, signal;
};
inline constexpr std::array<CommandSignal, kActuators> kCommandSignals{
    {{"accelerator_cmd", "acc_pedal_cmd"},
     {"brake_pressure_cmd", "brake_pressure_cmd"},
     {"steering_cmd", "steering_motor_ang_cmd"},
     {"gear_shift_cmd", "desired_gear"}}};

struct CommandSample {
  Duration at{};
  double value = 0.0;
};

// Numbers of ticks with an input that came neither by bus nor receiver nor as a command.
struct OtherInputs {
  std::uint64_t guardian = 0;  // it drives, or has stopped the car
  // controller not error-active, or new error frames, restarts, losses
  std::uint64_t controller = 0;
  std::uint64_t joystick = 0;  // new joystick samples
  std::uint64_t silence = 0;   // base silent for longer than kBaseSilence after its first packet
};
inline constexpr Duration kBaseSilence = milliseconds(200);

struct CommandTrace {
  std::vector<CommandSample> modes;  // the first mode and each change
  std::array<std::vector<CommandSample>, kActuators> commands;
  std::vector<scenario::OperatorText> operator_texts;  // commands and stops
  OtherInputs others;
  std::optional<Duration> first_frame;  // of the first frame that the car sent
  Duration length{};                    // from the first tick to the last
  std::uint64_t ticks = 0;
  bool armed_at_start = false;  // the first tick requests it: the car was started with --arm
};

Result<CommandTrace, Problem> trace_of(RecordedRun& run, const can::Database& database);

}  // namespace pitwall::bench
