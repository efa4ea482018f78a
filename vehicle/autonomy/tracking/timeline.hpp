// Frames of the last second in the order of their measurement, with checkpoints of the tracks: a
// late frame is put in its place and all later ones are filtered again.
//   in     frames in any order
//   out    tracks after all frames
//   invariants
//          the tracks depend on the set of frames, not on the order of their arrival
//   errors a frame that is older than the oldest checkpoint, that repeats a key, or that finds no
//          room is refused
//   cost   insert: O(frames). settle: O(frames after the earliest new one). No allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

inline constexpr std::size_t kFramesMax = 256, kStoredMax = 1024, kCheckpointsMax = 14;

struct StoredFrame {
  FrameKey key;
  OwnMotion own;
  std::uint16_t first = 0;  // of its measurements
  std::uint8_t size = 0;
};

struct StoredMeasurement {
  Measurement measurement;
  std::uint16_t next = 0;  // of its frame, or of the free ones
};

struct Checkpoint {
  FrameKey key;  // newest frame in it
  Tracks tracks;
};

struct Timeline {
  bool started = false;
  std::array<StoredFrame, kFramesMax> frames{};  // in order
  std::size_t size = 0;
  std::array<StoredMeasurement, kStoredMax> pool{};
  std::uint16_t free = 0;  // first free place
  std::size_t stored = 0;
  std::array<Checkpoint, kCheckpointsMax> checkpoints{};  // in order
  std::size_t marks = 0;
};
static_assert(std::is_trivially_copyable_v<Timeline>);

}  // namespace pitwall::tracking
