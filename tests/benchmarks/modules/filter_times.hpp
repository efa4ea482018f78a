// Timing of the localization filter on the measurements of a real run, from snapshots of its state:
// every prediction and every update in its window, and a position that arrives late.
//   in     snapshots of a running filter, its params
//   out    microseconds of processor time, one value per timed call, including half a microsecond
//          for reading the clock. All gates of the filter are open, so every measurement is used
//   invariants
//          the filter is copied: the run is not changed by the timing
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
  std::size_t refused = 0;  // late positions that arrived too late for the window
};

inline constexpr Duration kShortRewind = milliseconds(100), kLongRewind = seconds(1);

void take_times(const localization::FilterState& filter, const localization::FilterParams& params,
                FilterTimes& times);

}  // namespace pitwall::benchmarks
