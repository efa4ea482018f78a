// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/link_loss_policy.hpp"

#include <algorithm>

namespace pitwall::safety {
namespace {

LinkLossLevel level_of(const LinkLossParams& p, const StreamRow& link) {
  if (link.health == Health::kUnwatched) return LinkLossLevel::kFull;  // this car has no radio
  if (link.health == Health::kNever || link.health == Health::kBad) return LinkLossLevel::kStop;
  if (link.age > p.no_comm) return LinkLossLevel::kNoComm;
  if (link.age > p.override_gone) return LinkLossLevel::kOverrideGone;
  return link.age > p.joystick_dropped ? LinkLossLevel::kJoystickDropped : LinkLossLevel::kFull;
}

// How much of the joystick's word still counts: all of it while it is fresh, nothing when the
// override is gone. A sample from the future is none.
double weight(const LinkLossParams& p, Duration age) {
  if (age.ns < 0) return 0.0;
  const double left = (p.override_gone - age).seconds();
  return std::clamp(left / (p.override_gone - p.joystick_dropped).seconds(), 0.0, 1.0);
}

}  // namespace

LinkLossOutput apply_link_loss_policy(const LinkLossParams& params, LinkLossState& state,
                                      const StreamRow& link,
                                      const std::optional<world::Joystick>& joystick, Instant now) {
  LinkLossOutput out;
  out.level = level_of(params, link);
  if (joystick) state.joystick = joystick;
  if (state.joystick) {
    const double applied_weight = weight(params, now - state.joystick->at);
    out.throttle_cap =
        1.0 - applied_weight * (1.0 - std::clamp(state.joystick->throttle_cap, 0.0, 1.0));
    out.brake = applied_weight * std::clamp(state.joystick->brake, 0.0, 1.0);
    if (applied_weight == 0.0) state.joystick.reset();
  }
  const bool silent = out.level >= LinkLossLevel::kNoComm;
  const bool ever = link.health != Health::kNever;  // else there is nothing that was lost
  if (silent && ever && params.no_comm_drives) out.speed_limit_mps = params.no_comm_speed_mps;
  state.speed_limit_mps = out.speed_limit_mps;
  out.stop = out.level == LinkLossLevel::kStop || (silent && !params.no_comm_drives);
  return out;
}

}  // namespace pitwall::safety
