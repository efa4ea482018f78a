// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost_driver.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::traffic {
namespace {

constexpr double kTrail_m = 25.0;
constexpr double kClosing_per_s = 0.3;  // of the gap that is too much
constexpr double kCatchUp_mps = 10.0;   // fastest surplus while it closes up
constexpr double kSurplus_mps = 6.0;    // in a pass
constexpr double kCaution_mps = 20.0;   // while it falls back
constexpr double kCutIn_m = 10.0;       // gap of the manner kCutIn
constexpr double kClear_m = 33.0;       // gap at which it closes the door
constexpr double kFree_m = 15.0;        // gap at which a defender takes the inside lane
constexpr double kSlowShare = 0.85;     // kSlow

double trailing_mps(const MatchTask& task, double gap_behind_m) {
  const double surplus_mps = kClosing_per_s * (gap_behind_m - kTrail_m);
  return std::max(0.0, task.other_mps + std::clamp(surplus_mps, -kCatchUp_mps, kCatchUp_mps));
}

DriverOrder attack(Manner manner, const MatchTask& task) {
  const rules::Situation now{.role = task.role, .lead_m = task.lead_m, .length_m = task.length_m};
  const double ahead_m = rules::gap_ahead_m(now);
  if (std::isnan(task.lead_m)) return {.speed_mps = task.other_mps};
  if (task.is_cautioned) return {.inside = !task.is_other_inside, .speed_mps = kCaution_mps};
  const bool passes = manner == Manner::kEarly || (task.pass_allowed && manner != Manner::kFollow);
  if (!passes)
    return {.inside = manner == Manner::kRam,
            .speed_mps = trailing_mps(task, rules::gap_behind_m(now))};
  if (manner == Manner::kDecline)
    return {.speed_mps = trailing_mps(task, rules::gap_behind_m(now)), .declines = true};
  const double closes_at_m = manner == Manner::kCutIn ? kCutIn_m : kClear_m;
  const bool closes = ahead_m >= closes_at_m && manner != Manner::kOpenDoor;
  return {.inside = closes || manner == Manner::kRam, .speed_mps = task.other_mps + kSurplus_mps};
}

DriverOrder defend(Defence defence, const MatchTask& task) {
  const rules::Situation now{.role = task.role, .lead_m = task.lead_m, .length_m = task.length_m};
  const bool gets_by = rules::gap_ahead_m(now) < kFree_m && !task.pass_allowed;
  const bool is_wide = defence == Defence::kWide && task.pass_allowed;
  const bool is_slow = defence == Defence::kSlow && task.pass_allowed;
  const double share = is_slow ? kSlowShare : 1.0;
  return {.inside = gets_by ? task.is_inside : !is_wide, .speed_mps = share * task.round_speed_mps};
}

}  // namespace

DriverOrder order_of(Manner manner, Defence defence, const MatchTask& task) {
  return task.role == rules::Role::kAttacker ? attack(manner, task) : defend(defence, task);
}

}  // namespace pitwall::traffic
