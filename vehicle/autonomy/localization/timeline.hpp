// The last fraction of a second of measurements in the order in which they were true, each with the
// belief after it. A late measurement is inserted where it belongs and everything after it is done
// again: the result does not depend on the order of arrival.
//
//     arrival   i1 i2 i3 P(i1.5)          P is a position that was true between i1 and i2
//     timeline  i1 P i2' i3'              ' done again
//
//   errors insert() refuses what is older than the first entry
//   cost   O(entries after the inserted one); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vehicle/autonomy/localization/ekf.hpp"

namespace pitwall::localization {

// 0.25 s of IMU at 125 Hz, wheels at 100 Hz with slip, two GNSS units at 20 Hz, with reserve.
inline constexpr std::size_t kTimelineEntries = 128;

struct Entry {
  Measurement measurement;
  Innovation innovation;
  Belief after;
};

struct Timeline {
  std::array<Entry, kTimelineEntries> entries{};
  std::size_t size = 0;

  const Belief& newest() const { return entries[size - 1].after; }  // size > 0
};

struct TimelineParams {
  MotionNoise noise;
  std::array<double, 2> gate_nis{kUnset, kUnset};  // 4..100: for 1 and 2 degrees of freedom
  double window_s = kUnset;                        // 0.05..0.5: how late a measurement may be
};

// Begins with a belief that is trusted as it is.
void start(Timeline& timeline, const Belief& belief);
// Puts it in place and replays; the innovation is the measurement's own. Nothing if it is too old.
std::optional<Innovation> insert(Timeline& timeline, const TimelineParams& params,
                                 const Measurement& measurement);

}  // namespace pitwall::localization
