// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/lap_timer.hpp"

#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::race {
namespace {

double after_line(const LapTimerParams& p, double station_m) {
  const double d = std::fmod(station_m - p.start_line_m, p.track_length_m);
  return d < 0.0 ? d + p.track_length_m : d;
}

void begin(LapTimerState& s, double position_m, Instant now) {
  s.begun = true;
  s.position_m = position_m;
  // Within the lap that began at the line behind the car; only the next crossing starts the clock.
  s.driven_m = position_m;
  s.last = now;
}

}  // namespace

std::optional<Lap> step(const LapTimerParams& p, LapTimerState& s, const LapTick& tick,
                        Instant now) {
  CHECK(p.track_length_m > 0.0);
  if (!std::isfinite(tick.station_m)) {
    s.flying = false;
    return std::nullopt;
  }
  const double position_m = after_line(p, tick.station_m);
  if (!s.begun) {
    begin(s, position_m, now);
    return std::nullopt;
  }
  // The shorter way round: nobody drives half a track between two ticks.
  const double moved_m = std::remainder(position_m - s.position_m, p.track_length_m);
  const Instant before = s.last;
  s.position_m = position_m;
  s.driven_m += moved_m;
  s.last = now;
  if (!tick.green) s.flying = false;
  if (s.driven_m < p.track_length_m) return std::nullopt;

  s.driven_m -= p.track_length_m;
  const double share = moved_m > 0.0 ? 1.0 - s.driven_m / moved_m : 1.0;
  const Instant crossed = before + from_seconds((now - before).seconds() * share);
  const bool at_speed = tick.speed_mps >= p.flying_speed_mps;
  std::optional<Lap> lap;
  if (s.timing) {
    const double mean_mps = p.track_length_m / (crossed - s.lap_begin).seconds();
    lap = Lap{++s.laps, s.lap_begin, crossed, mean_mps, s.flying && at_speed};
  }
  s.timing = true;
  s.lap_begin = crossed;
  s.flying = tick.green && at_speed;
  return lap;
}

}  // namespace pitwall::race
