// How long the filter of localization takes for what a run really asks of it, taken from snapshots
// of its state: every prediction and every update that its window holds, and a position that comes
// late.
//   in     snapshots of a filter that runs, its params
//   out    microseconds of processor time, one value for each call that was timed, the reading of
//          the clock (half a microsecond) in it; every gate is open, so that each measurement is
//          taken in
//   invariants
//          a snapshot is copied: the run goes on as if nobody had looked
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/car.hpp"

namespace pitwall::benchmarks {

inline constexpr std::size_t kFilterKinds =
    static_cast<std::size_t>(localization::Kind::kAttitude) + 1;

struct FilterTimes {
  std::vector<double> predict_us;  // from one IMU sample to the next
  std::array<std::vector<double>, kFilterKinds> update_us;
  std::vector<double> short_rewind_us, long_rewind_us;
  std::size_t refused = 0;  // late positions that came too late for the window
};

inline constexpr Duration kShortRewind = milliseconds(100), kLongRewind = seconds(1);

void take_times(const localization::FilterState& filter, const localization::FilterParams& params,
                FilterTimes& times);

}  // namespace pitwall::benchmarks
