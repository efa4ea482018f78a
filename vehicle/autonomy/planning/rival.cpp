// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/rival.hpp"

#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kBelieved_s = 0.25;  // five sweeps: two false ones do not make a car to brake for
constexpr double kSamePlace_m = 15.0, kSameLane_m = 4.0;  // of a car with a new number

bool is_near(const RivalParams& p, const Rival& car) {
  return car.gap_m > -p.watch_ahead_m && car.gap_m < p.watch_behind_m;
}

// Where the rival is now, if it goes on as it did.
Rival gone_on(const Rival& last, double own_mps, Instant now) {
  Rival out = last;
  const double dt_s = (now - last.at).seconds();
  out.gap_m += (own_mps - last.speed_mps) * dt_s;
  out.at = now;
  return out;
}

}  // namespace

double gap_m(const world::TrackMap& track, double own_s_m, double other_s_m) {
  return std::remainder(own_s_m - other_s_m, track.length_m());
}

Rival rival_of(const world::TrackMap& track, const OwnPlace& own, const world::Opponent& car,
               Instant at) {
  if ((car.measured_at - car.born_at).seconds() < kBelieved_s) return {};
  if (!std::isfinite(car.s_m + car.n_m + car.speed_mps + car.yaw_rad)) return {};
  const double turn_rad = wrap_pi(car.yaw_rad - track.at(car.s_m).yaw_rad);
  return {.known = true,
          .id = car.id,
          .gap_m = gap_m(track, own.track_s_m, car.s_m),
          .n_m = car.n_m,
          .speed_mps = car.speed_mps * std::cos(turn_rad),
          .drift_mps = car.speed_mps * std::sin(turn_rad),
          .at = at,
          .measured_at = car.measured_at};
}

Rival follow(const RivalParams& p, const Rival& last, const world::TrackMap& track,
             const OwnPlace& own, const world::Opponents& cars, Instant now) {
  const Rival expected = last.known ? gone_on(last, own.speed_mps, now) : Rival{};
  Rival nearest, same;
  bool has_left = false;
  for (const world::Opponent& car : cars.cars) {
    const Rival seen = rival_of(track, own, car, now);
    const bool is_last = seen.known && last.known && seen.id == last.id;
    if (!seen.known || !is_near(p, seen)) {
      has_left = has_left || is_last;
      continue;
    }
    if (is_last) return seen;
    const double moved_m = std::abs(seen.gap_m - expected.gap_m);
    if (last.known && moved_m < kSamePlace_m && std::abs(seen.n_m - last.n_m) < kSameLane_m &&
        (!same.known || moved_m < std::abs(same.gap_m - expected.gap_m)))
      same = seen;
    if (!nearest.known || std::abs(seen.gap_m) < std::abs(nearest.gap_m)) nearest = seen;
  }
  if (!last.known || has_left) return nearest;
  if (same.known) return same;
  const bool is_fresh = (now - last.measured_at).seconds() <= p.forget_s;
  return is_fresh && is_near(p, expected) ? expected : nearest;
}

}  // namespace pitwall::planning
