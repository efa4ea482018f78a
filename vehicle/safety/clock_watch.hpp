// Clock monitor: compares the car's clock with the GPS time of the receivers, and detects steps and
// skew. While the car drives they are only reported, because no driving function uses the calendar
// time. At standstill they prevent arming: recordings and link would carry wrong time stamps.
//   in     receiver times (GPS time and time of arrival), the time
//   out    a step, for `show` after it was detected; the skew, while it is too large
//   method difference = arrival - GPS time; transport delay can only increase it. It is compared
//          with the smallest difference of the running and of the last window. A decrease of more
//          than step_s is accepted as a step at once, because delay cannot decrease so much. An
//          increase is accepted after kClockAgreeing messages in agreement that did not arrive
//          together (after a suspension the car receives old messages in one burst, each a little
//          less late). The skew is the slope of the smallest differences of the last nine windows
//   units  seconds; ppm, positive if the car's clock is fast; the skew of the worse unit is
//          reported
//   errors a unit that sends no time is ignored; a leap second appears as a step of the UTC offset
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::safety {

struct ClockParams {
  double step_s = 0.1;  // smaller changes count as delay
  double skew_max_ppm = 60.0;
  Duration show = seconds(1);  // [0.1, 60] s
};

inline constexpr auto kClockRanges = std::to_array<world::NamedRange<ClockParams>>({
    {"step_s", &ClockParams::step_s, 0.02, 1.0},
    {"skew_max_ppm", &ClockParams::skew_max_ppm, 20.0, 1000.0},
});

inline constexpr Duration kClockWindow = seconds(4);
inline constexpr std::size_t kClockWindows = 9;
inline constexpr std::uint8_t kClockAgreeing = 3;

// State of one receiver. Differences are relative to the first one, so that they stay small.
struct ClockUnit {
  bool started = false;
  std::int64_t origin_ns = 0;                      // the first difference
  std::array<double, kClockWindows> smallest_s{};  // of complete windows, oldest first
  std::uint8_t windows = 0;                        // number of complete windows
  double current_s = kUnset;                       // smallest in the running window
  Instant window_began{};
  double suspect_s = kUnset;
  Instant suspect_at{};
  std::uint8_t agreeing = 0;
  double utc_offset_s = kUnset;
};

struct ClockState {
  std::array<ClockUnit, world::kGnssUnits> units{};
  double step_s = kUnset;  // the last accepted step
  Instant stepped_at{};
  std::uint32_t steps = 0;
};
static_assert(std::is_trivially_copyable_v<ClockState>);

struct ClockOutput {
  bool stepped = false, skewed = false;
  double step_s = kUnset, skew_ppm = kUnset;
};

ClockOutput watch_clock(const ClockParams& params, ClockState& state,
                        const world::SensorInput& sensors, Instant now);

}  // namespace pitwall::safety
