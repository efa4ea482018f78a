// Detector of frozen values in messages whose counter still runs. A second source, the witness,
// shows that the value must have moved: the command, for steering, brake and accelerator; the other
// speed, for the speed of the wheels and that of the powertrain.
//   in     the values as received; the last commands; now
//   out    which values are frozen: the same to the bit since they changed last, while their
//          witness moved by more than its limit
//   invariants
//          a value that changed is not frozen. Nothing is judged at a standstill (below 5 m/s), of
//          an actuator that is told nothing, or while the witness rests: a straight line at one
//          speed freezes nothing. One wheel that differs is no witness, nor are wheels that jump:
//          at one speed the powertrain reports the same value for seconds
//   limits command: 1.7 deg of the steering motor, 300 kPa, a tenth of the pedal, each as told
//          0.1 s ago (delay and lag of the actuators); speed: 0.3 m/s for the
//          wheels, 1 m/s for the powertrain, whose witness scatters
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
  double witness = kUnset;  // when the value changed last
  bool frozen = false;
  Instant frozen_since{};
};

struct FrozenState {
  static constexpr std::size_t kCommands = 16;  // of the last ticks
  std::array<FrozenTrack, kWatched> tracks{};
  std::array<world::ActuatorCommand, kCommands> commands{};  // unset: told nothing
  std::array<Instant, kCommands> reported_at{};
  std::size_t next = 0;
  double wheels_mps = kUnset;  // of the last tick

  bool any() const {
    bool found = false;
    for (const FrozenTrack& track : tracks) found |= track.frozen;
    return found;
  }
};

void store(FrozenState& state, const world::ActuatorCommand& command, bool reported, Instant now);

// Once per tick, after its frames. A speed that is frozen is as old as its freezing; an actuator's
// feedback stays as it is, so that what compares it with the command has something to compare.
void judge_frozen(FrozenState& state, world::VehicleSignals& signals, Instant now);

}  // namespace pitwall::gateway
