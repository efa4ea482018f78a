// State machine of the computer's side of the start-up, drive and shut-down handshake with the
// drive-by-wire: the CT state to report, as a complete table of state x event. If several events
// hold at once, the first in the order of CtEvent that leads to another state decides.
//   in     the present state; flags, drive-by-wire state, mode of the supervisor
//   out    the next state. The car drives only in 7, 8 and 9; 12 is left by a restart only
//   errors none
//   invariants
//          a car that is disarmed at rest reports no state in which the drive-by-wire waits for
//          commands: without commands the drive-by-wire would detect a dead computer and bar the
//          next arming
//   source CT and SYS states as in the public stack for the AV-21 (UVA), from start to stop; the
//          return to 6 after a stop is ours, since that stack starts a new process
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::gateway {

// In order of priority.
enum class CtEvent : std::uint8_t {
  kEmergency,      // mode emergency stop, purple flag, operator's emergency stop, engine off
  kStop,           // mode controlled stop or halted; red, stop, engine-kill or unknown flag
  kShutdown,       // engine off by operator or engine-kill flag; at standstill only
  kRed,            // track flag red; at start-up it shows that race control is present
  kTestsDone,      // red, and the drive-by-wire has passed its actuator test
  kOrange,         // start-engine flag, and armed (the brake is held)
  kEngineRunning,  // drive-by-wire reports engine running or driving
  kArmed,          // mode standby, driving or coast
  kRoll,           // mode driving or coast, drive-by-wire driving, flags allow it
  kYellow,         // kRoll under yellow or chequered
  kGreen,          // kRoll under green or waving green
  kDisarmed,       // mode disarmed, at standstill
  kTime            // the minimum time in the state has passed
};
inline constexpr std::size_t kCtEvents = 13;
using CtEvents = std::array<bool, kCtEvents>;

struct HandshakeParams {
  Duration dwell = milliseconds(500);  // minimum time in a state, except for emergency and stop
  double standstill_mps = 1.0;         // shutdown at most at this speed
};

inline constexpr auto kHandshakeRanges = std::to_array<world::NamedRange<HandshakeParams>>({
    {"standstill_mps", &HandshakeParams::standstill_mps, 0.1, 2.0},
});

inline constexpr auto kHandshakeTimes = std::to_array<world::NamedTime<HandshakeParams>>({
    {"dwell_s", &HandshakeParams::dwell, 0.0, 5.0},
});

struct HandshakeState {
  world::CtState ct = world::CtState::kDefault;
  Instant since{};
};
static_assert(std::is_trivially_copyable_v<HandshakeState>);

struct HandshakeInputs {
  world::SysState sys = world::SysState::kUnknown;
  world::TrackFlag track = world::TrackFlag::kNone;
  world::VehicleFlag vehicle = world::VehicleFlag::kNone;
  world::Mode mode = world::Mode::kDisarmed;
  double speed_mps = kUnset;  // unset: counts as moving
  bool operator_shutdown = false, operator_emergency = false;
  bool engine_off = false;  // the throttle does not close in a stop, at any speed
};

CtEvents events_of(const HandshakeParams& params, const HandshakeInputs& inputs);

// Look-up in the table.
world::CtState next(world::CtState ct, const CtEvents& events);

// One tick: emergency and stop act at once, all other events after the dwell.
world::CtState handshake(const HandshakeParams& params, HandshakeState& state,
                         const HandshakeInputs& inputs, Instant now);

constexpr bool drives(world::CtState ct) {
  return ct == world::CtState::kInitDriving || ct == world::CtState::kCaution ||
         ct == world::CtState::kNominalRace;
}

}  // namespace pitwall::gateway
