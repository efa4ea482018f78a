// The car's own clock beside the time that the receivers say: has one of them stepped, does one run
// too fast or too slow? While it drives that is reported, and nothing else: nothing that
// drives looks at a calendar. While it stands it does not arm: its recordings and its link would
// carry stamps that nobody can put in order.
//   in     when a receiver said what (GPS time), now
//   out    a step, until it has been shown for `show`; the skew, while it is too large
//   method difference = arrival - GPS time, to which transport can only add. A step against the
//          smallest of the last windows is believed at once where it is below it (delay cannot
//          shrink so far), and where it is above after three messages that agree and did not come
//          at once (a car that slept hears old messages all together, each a little less late). The
//          skew is the slope of the smallest differences of whole windows, over the last nine
//   units  seconds; ppm, positive where the car's clock is fast; for skew of the unit that is worse
//   errors a unit that says nothing has no say; a leap second shows as a step of the UTC offset
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
  double step_s = 0.1;  // less is delay
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

// Of one receiver. Differences are kept against the first one: they stay small.
struct ClockUnit {
  bool started = false;
  std::int64_t origin_ns = 0;                      // of the first difference
  std::array<double, kClockWindows> smallest_s{};  // of whole windows, oldest first
  std::uint8_t windows = 0;                        // of them
  double current_s = kUnset;                       // smallest of the running window
  Instant window_began{};
  double suspect_s = kUnset;
  Instant suspect_at{};
  std::uint8_t agreeing = 0;
  double utc_offset_s = kUnset;
};

struct ClockState {
  std::array<ClockUnit, world::kGnssUnits> units{};
  double step_s = kUnset;  // the newest that was believed
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
