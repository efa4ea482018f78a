// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/clock_watch.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

constexpr double kAgree_s = 0.02;
constexpr Duration kApart = milliseconds(20);

double base_s(const ClockUnit& unit) {
  double least = unit.current_s;
  if (unit.windows > 0) least = std::fmin(least, unit.smallest_s[unit.windows - 1U]);
  return least;
}

void begin_windows(ClockUnit& unit, double difference_s, Instant at) {
  unit.windows = 0;
  unit.current_s = difference_s;
  unit.window_began = at;
  unit.agreeing = 0;
}

void close_window(ClockUnit& unit, Instant at) {
  if (at - unit.window_began < kClockWindow) return;
  // A gap of more than a window leaves no slope.
  if (at - unit.window_began >= 2 * kClockWindow) unit.windows = 0;
  if (unit.windows == kClockWindows)
    std::shift_left(unit.smallest_s.begin(), unit.smallest_s.end(), 1);
  else
    ++unit.windows;
  unit.smallest_s[unit.windows - 1U] = unit.current_s;
  unit.current_s = kUnset;
  unit.window_began = at;
}

// Whether a difference is a step of a clock, not delay.
bool is_step(const ClockParams& params, ClockUnit& unit, double difference_s, Instant received) {
  const double change_s = difference_s - base_s(unit);
  if (change_s < -params.step_s) return true;
  if (!(change_s > params.step_s)) {
    unit.agreeing = 0;
    return false;
  }
  const bool again = unit.agreeing > 0;
  if (again && received - unit.suspect_at < kApart) return false;
  const bool agrees = again && std::abs(difference_s - unit.suspect_s) < kAgree_s;
  unit.agreeing = agrees ? static_cast<std::uint8_t>(unit.agreeing + 1) : std::uint8_t{1};
  unit.suspect_s = difference_s;
  unit.suspect_at = received;
  return unit.agreeing >= kClockAgreeing;
}

void believe(ClockState& state, double step_s, Instant now) {
  state.step_s = step_s;
  state.stepped_at = now;
  ++state.steps;
}

void take(const ClockParams& params, ClockState& state, const world::ReceiverTime& time,
          Instant now) {
  ClockUnit& unit = state.units[time.unit];
  const std::int64_t raw_ns = time.received.ns - time.gps_ns;
  if (!unit.started) {
    unit.started = true;
    unit.origin_ns = raw_ns;
    begin_windows(unit, 0.0, time.received);
  }
  const double difference_s = static_cast<double>(raw_ns - unit.origin_ns) * 1e-9;
  close_window(unit, time.received);
  if (is_step(params, unit, difference_s, time.received)) {
    believe(state, difference_s - base_s(unit), now);
    begin_windows(unit, difference_s, time.received);
  } else if (unit.agreeing == 0) {
    unit.current_s = std::fmin(unit.current_s, difference_s);
  }
  const double leap_s = time.utc_offset_s - unit.utc_offset_s;
  if (std::abs(leap_s) > 0.5) believe(state, leap_s, now);
  if (std::isfinite(time.utc_offset_s)) unit.utc_offset_s = time.utc_offset_s;
}

double skew_ppm(const ClockUnit& unit) {
  if (unit.windows < kClockWindows) return kUnset;
  constexpr double kSpan_s = kClockWindow.seconds() * (kClockWindows - 1);
  return (unit.smallest_s.back() - unit.smallest_s.front()) / kSpan_s * 1e6;
}

}  // namespace

ClockOutput watch_clock(const ClockParams& params, ClockState& state,
                        const world::SensorInput& sensors, Instant now) {
  for (const world::ReceiverTime& time : sensors.times)
    if (time.unit < world::kGnssUnits) take(params, state, time, now);
  ClockOutput out;
  out.step_s = state.step_s;
  out.stepped = state.steps > 0 && now - state.stepped_at < params.show;
  for (const ClockUnit& unit : state.units) {
    const double ppm = skew_ppm(unit);
    const bool worse = !(std::abs(ppm) <= std::abs(out.skew_ppm));  // than none, too
    if (std::isfinite(ppm) && worse) out.skew_ppm = ppm;
  }
  out.skewed = std::abs(out.skew_ppm) > params.skew_max_ppm;
  return out;
}

}  // namespace pitwall::safety
