// Detector of frozen values in messages whose counter still runs. A second source, the witness,
// shows that the value must have moved: the command for steering, brake and accelerator; for the
// speed of the wheels that of the powertrain, and the reverse.
//   in     the received values; the last commands; the time
//   out    the frozen values: bit-identical since their last change, while the witness moved by
//          more than its limit
//   invariants
//          a value that changed is not frozen. Nothing is judged below 5 m/s, for an actuator
//          without a command, or while the witness is constant: on a straight at constant speed no
//          value is frozen. The witness for the powertrain is the mean of the two middle wheels,
//          and not used while it jumps, because at constant speed the powertrain reports the same
//          value for seconds
//   limits command: 1.7 deg of the steering motor, 300 kPa, a tenth of the pedal, each compared
//          with the mean command of 0.05 to 0.15 s before (delay and lag of the actuators); speed:
//          0.3 m/s for the wheels, 1 m/s for the powertrain, whose witness is noisy
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::gateway {

enum class Watched : std::uint8_t { kSteering, kBrake, kThrottle, kWheels, kPowertrain };
inline constexpr std::size_t kWatched = 5;

struct FrozenTrack {
  double value = kUnset;
  double witness = kUnset;  // at the last change of the value
  bool frozen = false;
  Instant frozen_since{};
};

struct FrozenState {
  static constexpr std::size_t kCommands = 16;  // commands of the last ticks
  std::array<FrozenTrack, kWatched> tracks{};
  std::array<world::ActuatorCommand, kCommands> commands{};  // unset: no command
  std::array<Instant, kCommands> reported_at{};
  std::size_t next = 0;
  double wheels_mps = kUnset;  // in the last tick

  bool any() const {
    bool found = false;
    for (const FrozenTrack& track : tracks) found |= track.frozen;
    return found;
  }
};

void store(FrozenState& state, const world::ActuatorCommand& command, bool reported, Instant now);

// Once per tick, after its frames. A frozen speed gets the time at which it froze as its time
// stamp. The feedback of an actuator keeps its time stamp, so that the following monitor can still
// compare it with the command.
void judge_frozen(FrozenState& state, world::VehicleSignals& signals, Instant now);

}  // namespace pitwall::gateway
