// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/flags.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "basestation/state/derived/attempt.hpp"

namespace pitwall::state {
namespace {

bool differ(double a, double b) { return !std::isnan(a) && !std::isnan(b) && a != b; }

double binding(double a, double b) {
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  return restriction_of_track_flag(a) >= restriction_of_track_flag(b) ? a : b;
}

}  // namespace

int restriction_of_track_flag(double flag) {
  // none, RED, ORANGE, YELLOW, GREEN, WAVING GREEN, CHEQUERED, UNKNOWN
  constexpr std::array kRestriction{2, 6, 5, 3, 1, 0, 4, 7};
  if (!(flag >= 0.0 && flag < static_cast<double>(kRestriction.size()))) return kRestriction.back();
  return kRestriction.at(static_cast<std::size_t>(flag));
}

bool flag_conflict(const FlagEntries& flags) {
  if (flags.encodings_differ > 0.0) return true;
  const double should_hold = binding(flags.race_control_track, flags.pit_wall_track);
  return differ(flags.car_track, should_hold) ||
         differ(flags.race_control_track, flags.pit_wall_track) ||
         differ(flags.race_control_vehicle, flags.car_vehicle);
}

bool round_speed_conflict(const RoundSpeeds& speeds) {
  const double round_mps = speeds.race_control_mps;
  if (!(round_mps > 0.0)) return false;  // none was said
  const bool may_be_faster = role_of_flag(speeds.car_vehicle) == Role::kAttacker ||
                             speeds.car_forward_mps2 < kBrakesDown_mps2;
  return std::abs(round_mps - speeds.pit_wall_mps) > kRoundSpeedTolerance_mps ||
         (!may_be_faster && speeds.car_target_mps > round_mps + kRoundSpeedTolerance_mps);
}

}  // namespace pitwall::state
