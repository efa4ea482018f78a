// Inputs of the operator by radio: levels (stop, joystick, excluded sensors), commands to be
// executed once, and the car's answer to each command.
//   in     from the radio, a switch or a test. A withdrawn input is absent
//   invariants
//          a joystick can only slow the car and never steers it. A command is applied only before
//          its expiry, and answered in the tick of its arrival or in the next one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

// Sensors that the operator can exclude, and the absolute bit set of those that he has.
enum class Excludable : std::uint8_t {
  kGnss0,  // positions, velocities and headings of the unit
  kGnss1,
  kImu0,
  kImu1,
  kWheels,
  kLidar,  // their detections of other cars, of every unit
  kCamera0,
  kCamera1,
  kRadar
};
inline constexpr std::size_t kExcludables = 9;

struct SensorUse {
  std::uint16_t excluded = 0;  // bit k: Excludable k

  constexpr bool uses(Excludable sensor) const {
    return (excluded >> static_cast<unsigned>(sensor) & 1U) == 0;
  }
  constexpr bool operator==(const SensorUse&) const = default;
};

enum class StopRequest : std::uint8_t { kNone, kControlled, kEmergency };

struct Joystick {
  double throttle_cap = 1.0, brake = 0.0;  // 0 .. 1; 1 is the hardest controlled stop
  Instant at{};                            // time of the sample, never later than the true one
};

struct OperatorInputs {
  StopRequest stop = StopRequest::kNone;  // of the stop latch; set until the latch is released
  std::optional<Joystick> joystick;
};

enum class OperatorCommandKind : std::uint8_t {
  kArm,         // 0 disarm, 1 arm
  kReset,       // 1: acknowledges a stop that has ended
  kSpeedLimit,  // m/s
  kRaceLine,
  kRole,
  kTrackFlag,        // a TrackFlag; kNone: no flag from the base
  kSensorsExcluded,  // bits of world::Excludable
  kFuelEntered,      // litres in the tank
  kEndRun,
  kSendParameters
};

struct OperatorCommand {
  std::uint32_t id = 0;  // for the answer
  OperatorCommandKind kind = OperatorCommandKind::kArm;
  double argument = kUnset;
  Instant expires{};  // not applied later
};

enum class CommandAnswer : std::uint8_t {
  kApplied,
  kRefused,  // not possible in the present state
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
