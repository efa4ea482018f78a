// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/laps/lap_progress.hpp"

#include <cmath>

namespace pitwall::state {

LapMove LapProgress::take(Instant at, double station_m) {
  if (!std::isfinite(station_m) || (begun_ && at <= at_)) return {};
  const Duration passed = at - at_;
  const auto moved = begun_ ? way_from_last(passed, station_m) : std::nullopt;
  LapMove move{.from = at_, .to = at};
  if (moved) {
    move.kind = passed > kGap ? LapMove::Kind::kUnseen : LapMove::Kind::kSeen;
    move.from_m = way_m_;
    way_m_ += *moved;
  } else {
    move = {.kind = LapMove::Kind::kBegins, .from_m = station_m, .from = at, .to = at};
    way_m_ = station_m;
  }
  move.to_m = way_m_;
  begun_ = true;
  at_ = at;
  station_m_ = station_m;
  return move;
}

// nullopt: not known, or further than a car drives.
std::optional<double> LapProgress::way_from_last(Duration passed, double station_m) const {
  const double reach_m = kTopSpeed_mps * passed.seconds() + kJitter_m;
  if (reach_m >= length_m_) return std::nullopt;
  const double nearest_m = std::remainder(station_m - station_m_, length_m_);
  if (std::abs(nearest_m) <= (passed > kGap ? kJitter_m : reach_m)) {
    const bool half_a_lap_back = way_m_ + nearest_m < -length_m_ / 2.0;
    return half_a_lap_back ? std::nullopt : std::optional{nearest_m};
  }
  const double forward_m = nearest_m < 0.0 ? nearest_m + length_m_ : nearest_m;
  return forward_m <= reach_m ? std::optional{forward_m} : std::nullopt;
}

}  // namespace pitwall::state
