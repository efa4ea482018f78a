// Assignment of the detections of a frame to tracks: greedy by cost and, where gates overlap, the
// best of the two ways to assign two tracks.
//   in     cost of every pair of a track and a detection; infinite outside of the gate
//   out    detection of every track, or kNone
//   invariants
//          a detection has at most one track. kBestTwo: no exchange between two tracks and no move
//          to a free detection lowers the cost or lets one more track be assigned
//   cost   O(pairs * assigned pairs); no allocation
//   source Chiu et al. (2020), arXiv 2001.05673 (greedy); Bar-Shalom and Li (1995), section 6.2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

inline constexpr std::uint8_t kNone = 255;

struct Costs {
  std::size_t tracks = 0, detections = 0;
  std::array<std::array<double, kMeasurementsMax>, kTracksMax> cost;

  static constexpr double kOutside = std::numeric_limits<double>::infinity();
};

struct Assignment {
  std::array<std::uint8_t, kTracksMax> of_track;            // kNone: without a detection
  std::array<std::uint8_t, kMeasurementsMax> of_detection;  // kNone: without a track
};

enum class Search : std::uint8_t { kGreedy, kBestTwo };
Assignment assign(const Costs& costs, Search search);

}  // namespace pitwall::tracking
