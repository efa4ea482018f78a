// Inputs of the operator by radio: what holds now (stop, joystick) and what is to be done once
// (commands), and the car's answer to each command.
//   in     the rim: by radio, by a switch, by a test. An input that was withdrawn is absent
//   invariants
//          a joystick makes the car slower and never steers it; whoever applies a command compares
//          its expiry first, and answers every command in the tick in which it came, or in the next
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

enum class StopRequest : std::uint8_t { kNone, kControlled, kEmergency };

struct Joystick {
  double throttle_cap = 1.0, brake = 0.0;  // 0 .. 1; 1 is the hardest controlled stop
  Instant at{};                            // of the sample, never later than the truth
};

struct OperatorInputs {
  StopRequest stop = StopRequest::kNone;  // of the latch: it holds until it is released there
  std::optional<Joystick> joystick;
};

enum class OperatorCommandKind : std::uint8_t {
  kArm,         // 0 disarm, 1 arm
  kReset,       // 1: a stop that has ended is acknowledged
  kSpeedLimit,  // m/s
  kRaceLine,
  kRole,
  kTrackFlag,        // a TrackFlag; kNone: the base has no opinion
  kSensorsExcluded,  // bits of world::Excludable
  kEndRun,
  kSendParameters
};

struct OperatorCommand {
  std::uint32_t id = 0;  // to be named in the answer
  OperatorCommandKind kind = OperatorCommandKind::kArm;
  double argument = kUnset;
  Instant expires{};  // not applied after
};

enum class CommandAnswer : std::uint8_t {
  kApplied,
  kRefused,  // not in the present state
  kUnsupported,
  kExpired
};

struct AnsweredCommand {
  std::uint32_t id = 0;
  CommandAnswer answer = CommandAnswer::kRefused;
  Instant at{};
};

inline constexpr std::size_t kOperatorCommandsMax = 16;  // in one tick

}  // namespace pitwall::world
