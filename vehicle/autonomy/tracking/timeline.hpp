// Frames of the last second in the order of their measurement, with checkpoints of the tracks: a
// late frame is put in its place and all later ones are filtered again.
//
//     checkpoint   frame frame   checkpoint   frame [late frame] frame ... tracks
//                                go back here ^      filter again from here
//
//   in     frames in any order
//   out    tracks after all frames
//   invariants
//          the tracks depend on the set of frames, not on the order of their arrival
//   errors a frame older than the oldest checkpoint, one of the same sensor and time as another,
//          and one that finds no room are refused
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
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

inline constexpr std::size_t kFramesMax = 256;      // of 1 s: ten sensors at 25 Hz
inline constexpr std::size_t kStoredMax = 1024;     // their detections
inline constexpr std::size_t kCheckpointsMax = 12;  // one each 0.1 s, and the one before the window

struct StoredFrame {
  FrameKey key;
  OwnMotion own;
  std::uint16_t first = 0;  // of its measurements in the pool
  std::uint8_t size = 0;
};

struct StoredMeasurement {
  Measurement measurement;
  std::uint16_t next = 0;  // of the same frame, or of the free ones
};

struct Checkpoint {
  FrameKey key;  // newest frame in it
  Tracks tracks;
};

enum class Insertion : std::uint8_t { kDone, kTooOld, kRepeated, kNoRoom };

class Timeline {
 public:
  Timeline();

  // Gives up what no frame measured at `from` or later needs.
  void forget_before(Instant from);
  Insertion insert(const FrameKey& key, const OwnMotion& own,
                   std::span<const Measurement> measurements);
  // Filters the new frames and all after them; `tracks` are those after the frames before.
  void settle(const Params& params, const world::TrackMap* map, Tracks& tracks);

  std::size_t size() const { return size_; }

 private:
  Checkpoint& checkpoint(std::size_t i) { return checkpoints_[(oldest_ + i) % kCheckpointsMax]; }
  std::size_t go_back(Tracks& tracks);
  void filter(const Params& params, const world::TrackMap* map, const StoredFrame& frame,
              Tracks& tracks) const;
  void mark(const FrameKey& key, const Tracks& tracks);
  void drop_frames(std::size_t count);

  std::array<StoredFrame, kFramesMax> frames_{};  // in order
  std::size_t size_ = 0;
  std::size_t first_new_ = 0;  // first that `tracks` does not have
  bool late_ = false;          // `tracks` has later ones than that
  std::array<StoredMeasurement, kStoredMax> pool_{};
  std::uint16_t free_ = 0;  // first free place of the pool
  std::size_t room_ = kStoredMax;
  std::array<Checkpoint, kCheckpointsMax> checkpoints_{};  // ring, in order
  std::size_t oldest_ = 0, marks_ = 0;
  bool dropped_ = false;  // frames up to the oldest checkpoint are gone
};
static_assert(std::is_trivially_copyable_v<Timeline>);

}  // namespace pitwall::tracking
