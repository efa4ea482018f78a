// Link-loss policy: the reactions to a silent base station, in steps. Ages decide: of the newest
// authentic packet (watchdog row "radio") and of the joystick's newest sample.
//
//   age of the link    0 s .. joystick_dropped .. override_gone .. no_comm ....... stop (watchdog)
//   rung               full | joystick dropped | override gone   | no-comm        | controlled stop
//   joystick           its word | hands back, evenly | none      | none           | none
//   speed                                                          capped, or stop
//
//   in     the link's watchdog row, the joystick's newest sample if there is one, now
//   out    the rung, what is left of the joystick, a speed limit, whether the car must stop
//   invariants
//          nothing here makes the car faster than without a radio; a sample that comes back after
//          it was dropped acts at once, one that stays away is handed back evenly, never in a step
//   units  SI; throttle cap and brake 0 .. 1
//   source limits: false trips by hour and fade are in the research page on the radio, table 4.3
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/world/operator_inputs.hpp"

namespace pitwall::safety {

struct LinkLossParams {
  Duration joystick_dropped = milliseconds(200);  // [0.05 s, override_gone)
  Duration override_gone = milliseconds(500);     // (joystick_dropped, no_comm)
  Duration no_comm = seconds(1);    // (override_gone, the watchdog's limit of "radio")
  bool no_comm_drives = true;       // else the car stops at no_comm already
  double no_comm_speed_mps = 60.0;  // [1, 120]
};

enum class RadioRung : std::uint8_t { kFull, kJoystickDropped, kOverrideGone, kNoComm, kStop };

struct LinkLossState {
  std::optional<world::Joystick> joystick;  // the newest that was heeded
  double speed_limit_mps = kUnset;          // of the last tick
};
static_assert(std::is_trivially_copyable_v<LinkLossState>);

struct LinkLossOutput {
  RadioRung rung = RadioRung::kFull;
  bool stop = false;
  double throttle_cap = 1.0, brake = 0.0;
  double speed_limit_mps = kUnset;  // unset: none
};

LinkLossOutput descend(const LinkLossParams& params, LinkLossState& state, const StreamRow& link,
                       const std::optional<world::Joystick>& joystick, Instant now);

}  // namespace pitwall::safety
