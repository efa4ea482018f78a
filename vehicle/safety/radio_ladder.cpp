// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/radio_ladder.hpp"

#include <algorithm>

namespace pitwall::safety {
namespace {

RadioRung rung_at(const RadioLadderParams& p, const StreamRow& link) {
  if (link.health == Health::kUnwatched) return RadioRung::kFull;  // this car has no radio
  if (link.health == Health::kNever || link.health == Health::kBad) return RadioRung::kStop;
  if (link.age > p.no_comm) return RadioRung::kNoComm;
  if (link.age > p.override_gone) return RadioRung::kOverrideGone;
  return link.age > p.joystick_dropped ? RadioRung::kJoystickDropped : RadioRung::kFull;
}

// How much of the joystick's word still counts: all of it while it is fresh, nothing when the
// override is gone. A sample from the future is none.
double weight(const RadioLadderParams& p, Duration age) {
  if (age.ns < 0) return 0.0;
  const double left = (p.override_gone - age).seconds();
  return std::clamp(left / (p.override_gone - p.joystick_dropped).seconds(), 0.0, 1.0);
}

}  // namespace

RadioLadderOutput descend(const RadioLadderParams& params, RadioLadderState& state,
                          const StreamRow& link, const std::optional<world::Joystick>& joystick,
                          Instant now) {
  RadioLadderOutput out;
  out.rung = rung_at(params, link);
  if (joystick) state.joystick = joystick;
  if (state.joystick) {
    const double heeded = weight(params, now - state.joystick->at);
    out.throttle_cap = 1.0 - heeded * (1.0 - std::clamp(state.joystick->throttle_cap, 0.0, 1.0));
    out.brake = heeded * std::clamp(state.joystick->brake, 0.0, 1.0);
    if (heeded == 0.0) state.joystick.reset();
  }
  const bool silent = out.rung >= RadioRung::kNoComm;
  const bool ever = link.health != Health::kNever;  // else there is nothing that was lost
  if (silent && ever && params.no_comm_drives) out.speed_limit_mps = params.no_comm_speed_mps;
  state.speed_limit_mps = out.speed_limit_mps;
  out.stop = out.rung == RadioRung::kStop || (silent && !params.no_comm_drives);
  return out;
}

}  // namespace pitwall::safety
