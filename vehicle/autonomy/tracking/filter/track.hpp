// Tracks: what a filter knows of every other car at one instant. A plain value, so that a late
// frame is handled by going back to an older one.
//   frames with a map x[0] is the station, x[1] the offset and x[2] the heading relative to the
//          reference line; without a map they are x, y and yaw in Map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"

namespace pitwall::tracking {

// A detection: its frame and its place in it. It names the track that it began.
struct DetectionKey {
  FrameKey frame;
  std::uint8_t index = 0;

  constexpr auto operator<=>(const DetectionKey&) const = default;
};

inline constexpr std::size_t kStates = 7;
using StateVector = std::array<double, kStates>;
using StateMatrix = std::array<std::array<double, kStates>, kStates>;

inline constexpr std::size_t kRoadStates = 6;  // of the method "road"
using RoadVector = std::array<double, kRoadStates>;
using RoadMatrix = std::array<RoadVector, kRoadStates>;

// Ways in which a car may move at the moment, see modes.hpp.
inline constexpr std::size_t kSteady = 0, kSpeedChange = 1, kLaneChange = 2, kModes = 3;
struct Modes {
  std::array<double, kModes> share{};      // probability
  std::array<RoadVector, kModes> apart{};  // states minus those of the track
  std::array<RoadMatrix, kModes> p{};      // covariances
};

// States of the method "road" (the seventh is not used): position along and across, heading,
// speed, acceleration, turn rate (beyond that of the road). States of the method "paper": x, y,
// yaw, length, width, vx, vy.
struct Track {
  StateVector x{};
  StateMatrix p{};  // covariance; of "road" that of all modes when they were joined last
  Modes modes;      // of "road"
  double length_m = kUnset, width_m = kUnset;
  double confidence = kUnset;    // of its newest detection
  std::uint32_t sizes = 0;       // detections in length_m and width_m
  std::uint32_t detections = 0;  // that belong to it
  bool confirmed = false;
  DetectionKey first, previous, newest;
  bool undecided = false;  // may be one of the cars that were lost
  Instant born_at{};       // confirmed
};

inline constexpr std::size_t kTracksMax = 24;  // confirmed and on trial

struct Tracks {
  bool started = false;
  Instant at{};  // of all states
  FixedVector<Track, kTracksMax> list;
  std::uint64_t crowded = 0;  // detections that found no room for a track
};
static_assert(std::is_trivially_copyable_v<Tracks>);

}  // namespace pitwall::tracking
