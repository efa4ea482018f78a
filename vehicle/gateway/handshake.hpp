// The computer's side of the start-up, drive and shut-down handshake with the drive-by-wire: which
// CT state to report. A filled table, state x event; several events may hold at once and the first
// in the order of CtEvent that leads somewhere else wins.
//   in     the state now and what holds now (flags, drive-by-wire state, supervisor's mode)
//   out    the next state; the car drives only in 7, 8 and 9; 12 is left by a restart only
//   errors none
//   invariants  a car that is disarmed at rest reports no state in which the drive-by-wire waits
//          for commands: it would take their absence for a dead computer and bar the next arming
//   source CT and SYS states as in the public stack for the AV-21 (UVA), start to stop; the way
//          back to 6 after a stop is ours, since that stack begins anew with a new process
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

// In the order of priority.
enum class CtEvent : std::uint8_t {
  kEmergency,      // mode emergency stop, purple flag, operator's emergency stop, engine off
  kStop,           // mode controlled stop or halted; red, stop, engine-kill or unknown flag
  kShutdown,       // operator asks to shut the engine, or engine-kill flag; at standstill only
  kRed,            // track flag red: at start-up the sign that race control is there
  kTestsDone,      // red, and the drive-by-wire has passed its actuator test
  kOrange,         // start engine, and armed (the brake is held)
  kEngineRunning,  // drive-by-wire says engine running or later
  kArmed,          // armed, not stopping
  kRoll,           // mode driving, drive-by-wire driving, flag lets cars roll
  kYellow,         // rolling under yellow
  kGreen,          // rolling under green or waving green
  kDisarmed,       // mode disarmed, at standstill
  kTime            // nothing but the minimum time in the state has passed
};
inline constexpr std::size_t kCtEvents = 13;
using CtEvents = std::array<bool, kCtEvents>;

struct HandshakeParams {
  Duration dwell = milliseconds(500);  // least time in a state of the start-up
  double standstill_mps = 1.0;         // shutdown only below
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
  double speed_mps = kUnset;  // unset: not known to stand
  bool operator_shutdown = false, operator_emergency = false;
  bool engine_off = false;  // the throttle does not close in a stop: at any speed
};

CtEvents events_of(const HandshakeParams& params, const HandshakeInputs& inputs);

// The table alone.
world::CtState next(world::CtState ct, const CtEvents& events);

// One tick: emergency and stop act at once, everything else after the dwell.
world::CtState handshake(const HandshakeParams& params, HandshakeState& state,
                         const HandshakeInputs& inputs, Instant now);

constexpr bool drives(world::CtState ct) {
  return ct == world::CtState::kInitDriving || ct == world::CtState::kCaution ||
         ct == world::CtState::kNominalRace;
}

}  // namespace pitwall::gateway
