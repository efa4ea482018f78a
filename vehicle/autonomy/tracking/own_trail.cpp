// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/own_trail.hpp"

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::tracking {
namespace {

bool is_usable(const world::EgoState& e) {
  if (e.validity != world::Validity::kGood && e.validity != world::Validity::kDeadReckoning)
    return false;
  for (const double v : {e.x_m, e.y_m, e.yaw_rad, e.vx_mps, e.vy_mps})
    if (!std::isfinite(v)) return false;
  return true;
}

OwnMotion moved_on(const OwnMotion& own, double dt_s) {
  OwnMotion m = own;
  m.x_m += dt_s * own.vx_mps;
  m.y_m += dt_s * own.vy_mps;
  return m;
}

// The station stays that of the older tick: it is only where a search begins.
OwnMotion between(const OwnMotion& a, const OwnMotion& b, double share) {
  const auto mixed = [share](double from, double to) { return from + share * (to - from); };
  return {.x_m = mixed(a.x_m, b.x_m),
          .y_m = mixed(a.y_m, b.y_m),
          .yaw_rad = wrap_pi(a.yaw_rad + share * wrap_pi(b.yaw_rad - a.yaw_rad)),
          .vx_mps = mixed(a.vx_mps, b.vx_mps),
          .vy_mps = mixed(a.vy_mps, b.vy_mps),
          .s_m = a.s_m};
}

}  // namespace

void OwnTrail::note(const world::EgoState& ego, const world::TrackMap* map) {
  const Tick* last = newest();
  if (!is_usable(ego) || (last != nullptr && ego.at <= last->at)) return;
  const double c = std::cos(ego.yaw_rad), s = std::sin(ego.yaw_rad);
  Tick tick{.at = ego.at,
            .own = {.x_m = ego.x_m,
                    .y_m = ego.y_m,
                    .yaw_rad = ego.yaw_rad,
                    .vx_mps = c * ego.vx_mps - s * ego.vy_mps,
                    .vy_mps = s * ego.vx_mps + c * ego.vy_mps}};
  if (map != nullptr) {
    const bool near = last != nullptr && ego.at - last->at <= kGapMax;
    tick.own.s_m = near ? map->project(ego.x_m, ego.y_m, last->own.s_m).s_m
                        : map->project(ego.x_m, ego.y_m).s_m;
  }
  ticks[next] = tick;
  next = (next + 1) % kOwnTicks;
  size = size < kOwnTicks ? size + 1 : size;
}

const OwnTrail::Tick* OwnTrail::newest() const {
  return size == 0 ? nullptr : &ticks[(next + kOwnTicks - 1) % kOwnTicks];
}

std::optional<OwnMotion> OwnTrail::at(Instant instant) const {
  for (std::size_t back = 1; back <= size; ++back) {
    const Tick& older = ticks[(next + kOwnTicks - back) % kOwnTicks];
    if (older.at > instant) continue;
    if (back == 1) {
      if (instant - older.at > kGapMax) return std::nullopt;
      return moved_on(older.own, (instant - older.at).seconds());
    }
    const Tick& newer = ticks[(next + kOwnTicks - back + 1) % kOwnTicks];
    const Duration gap = newer.at - older.at;
    if (gap > kGapMax) return std::nullopt;
    return between(older.own, newer.own, (instant - older.at).seconds() / gap.seconds());
  }
  return std::nullopt;
}

}  // namespace pitwall::tracking
