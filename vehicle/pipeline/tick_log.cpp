// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/tick_log.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::pipeline {
namespace {

constexpr Duration kWindow = seconds(1);

}  // namespace

void SensorClock::heard(Instant true_at, Instant now) {
  if (last_) gap_ = std::max(gap_, now - *last_);
  last_ = now;
  latency_ = std::max(latency_, now - true_at);
  samples_ += begun_ ? 1U : 0U;  // intervals are counted, so the first begins none
  if (!begun_) begun_ = now;
}

void SensorClock::advance(Instant now) {
  if (!begun_ || now - *begun_ < kWindow) return;
  shown_ = {};
  if (samples_ > 0) {
    shown_ = {.rate_hz = samples_ / (now - *begun_).seconds(),
              .gap_ms = std::max(gap_, now - *last_).milliseconds(),
              .latency_ms = latency_.milliseconds()};
  }
  begun_ = now;
  samples_ = 0;
  gap_ = latency_ = {};
}

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

SensorClock* TickLog::clock_of(Sensor first, std::uint8_t unit) {
  if (unit >= world::kGnssUnits) return nullptr;
  return &sensors_[static_cast<std::size_t>(first) + unit];
}

void TickLog::note(const Inputs& in, const Outputs& out, double track_length_m) {
  at_ = in.now;
  for (const world::GnssPosition& p : in.sensors.positions) {
    SensorClock* const clock = clock_of(Sensor::kGnss0, p.unit);
    if (clock == nullptr) continue;
    clock->heard(p.at, in.now);
    positions_[p.unit] = p;
  }
  for (const world::GnssVelocity& v : in.sensors.velocities)
    if (v.unit < world::kGnssUnits) velocities_[v.unit] = v;
  for (const world::GnssHeading& h : in.sensors.headings)
    if (h.unit < world::kGnssUnits) headings_[h.unit] = h;
  for (const world::ImuSample& i : in.sensors.imu) {
    SensorClock* const clock = clock_of(Sensor::kImu0, i.unit);
    if (clock == nullptr) continue;
    clock->heard(i.at, in.now);
    imu_ = i;
  }
  for (SensorClock& clock : sensors_) clock.advance(in.now);
  lap_.advance(out.place.s_m, track_length_m, in.now);
}

}  // namespace pitwall::pipeline
