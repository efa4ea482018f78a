// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/tick_log.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::pipeline {
void LapClock::advance(double station_m, double length_m, Instant now) {
  const double before_m = station_m_;
  const Instant before_at = at_;
  station_m_ = station_m;
  at_ = now;
  if (!(length_m > 0.0) || !std::isfinite(station_m) || !std::isfinite(before_m)) {
    crossed_.reset();
    return;
  }
  double moved_m = station_m - before_m;
  if (moved_m < -length_m / 2) moved_m += length_m;
  if (moved_m > length_m / 2) moved_m -= length_m;
  constexpr double kJump_m = 50.0;
  if (std::abs(moved_m) > kJump_m) crossed_.reset();
  if (before_m + moved_m < 0.0) crossed_.reset();  // backward across the line
  if (before_m + moved_m < length_m || std::abs(moved_m) > kJump_m) return;
  const double share = (length_m - before_m) / moved_m;
  const auto since = static_cast<double>((now - before_at).ns) * share;
  const Instant crossing = before_at + Duration{static_cast<std::int64_t>(since)};
  if (crossed_) last_lap_s_ = (crossing - *crossed_).seconds();
  crossed_ = crossing;
}

void TickLog::note(const Inputs& in, const Outputs& out, double track_length_m) {
  at_ = in.now;
  for (const world::GnssPosition& p : in.sensors.positions)
    if (p.unit < world::kGnssUnits) positions_[p.unit] = p;
  for (const world::GnssVelocity& v : in.sensors.velocities)
    if (v.unit < world::kGnssUnits) velocities_[v.unit] = v;
  for (const world::GnssHeading& h : in.sensors.headings)
    if (h.unit < world::kGnssUnits) headings_[h.unit] = h;
  for (const world::ImuSample& i : in.sensors.imu)
    if (i.unit < world::kGnssUnits) imu_ = i;
  lap_.advance(out.place.s_m, track_length_m, in.now);
}

}  // namespace pitwall::pipeline
