// Link-loss policy: stepwise reactions to a silent base station. They depend on the age of the
// newest authentic packet (watchdog row "radio") and on the age of the newest joystick sample.
//
//   age of the link    0 s .. joystick_dropped .. override_gone .. no_comm ....... stop (watchdog)
//   level              full | joystick dropped | override gone   | no-comm        | controlled stop
//   joystick           full | fades out        | none            | none           | none
//   speed                                                          capped, or stop
//
//   in     watchdog row of the link, the newest joystick sample if there is one, the time
//   out    the level, the remaining joystick inputs, a speed limit, whether the car must stop
//   invariants
//          the result is never faster than without a radio. A joystick sample that arrives after
//          the joystick was dropped acts at once; without new samples the joystick fades out
//          linearly, never in a step
//   units  SI; throttle cap and brake 0 .. 1
//   source limits: the rates of false trips per hour and by fade are in the research page on the
//          radio, table 4.3
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
  bool no_comm_drives = true;       // false: the car stops at no_comm
  double no_comm_speed_mps = 60.0;  // [1, 120]
};

enum class LinkLossLevel : std::uint8_t { kFull, kJoystickDropped, kOverrideGone, kNoComm, kStop };

struct LinkLossState {
  std::optional<world::Joystick> joystick;  // the newest that was applied
  double speed_limit_mps = kUnset;          // in the last tick
};
static_assert(std::is_trivially_copyable_v<LinkLossState>);

struct LinkLossOutput {
  LinkLossLevel level = LinkLossLevel::kFull;
  bool stop = false;
  double throttle_cap = 1.0, brake = 0.0;
  double speed_limit_mps = kUnset;  // unset: no limit
};

LinkLossOutput apply_link_loss_policy(const LinkLossParams& params, LinkLossState& state,
                                      const StreamRow& link,
                                      const std::optional<world::Joystick>& joystick, Instant now);

}  // namespace pitwall::safety
