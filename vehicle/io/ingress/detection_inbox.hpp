// Inbox of one sensor that detects other cars: from its messages, as bytes, to dated frames.
//   in     receive(): CDR bytes and the time of their arrival, by the receiving thread
//   out    front(), pop(): the frames in order of arrival, by the 100 Hz loop; counts()
//   invariants
//          every message adds to exactly one of the counts of messages
//          a frame is dated by header.stamp, the time of the measurement, on the car's clock
//   errors counts()
//   cost   receive() allocates; front() and pop() do not and never wait
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/ingress/frame_queue.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"

namespace pitwall::io {

// Of messages, then of single detections.
struct DetectionCounts {
  std::uint64_t taken = 0;
  std::uint64_t refused = 0;  // truncated, or not CDR of this type
  std::uint64_t in_future = 0, too_old = 0;
  std::uint64_t foreign_frames = 0;  // another header.frame_id
  std::uint64_t too_many = 0;        // more than world::kDetectionsMax detections
  std::uint64_t no_room = 0;         // the loop did not take the frames before
  std::uint64_t bad_detections = 0;  // a number that is none or cannot be: left out of its frame

  // Messages that were not used, all of them or a part.
  std::uint64_t drops() const {
    return refused + in_future + too_old + foreign_frames + too_many + no_room;
  }
  bool operator==(const DetectionCounts&) const = default;
};

class DetectionInbox {
 public:
  static constexpr Duration kOldest = seconds(10);  // tracking.window_s is less
  // The clocks of two computers may differ so much; tracking.ahead_max_s may be less.
  static constexpr Duration kAheadMost = milliseconds(50);

  DetectionInbox(SensorType type, DetectionRow row) : type_(type), row_(std::move(row)) {}

  // Returns the age of the measurement; nullopt for a message that was not taken.
  std::optional<Duration> receive(std::span<const std::uint8_t> cdr, UtcTime utc, Instant now);

  const world::DetectionFrame* front() const { return queue_.front(); }
  void pop() { queue_.pop(); }
  DetectionCounts counts() const;

 private:
  using Count = std::atomic<std::uint64_t>;

  template <class M>
  std::optional<Duration> receive_as(std::span<const std::uint8_t> cdr, UtcTime utc, Instant now);

  SensorType type_;
  DetectionRow row_;
  FrameQueue queue_;
  Count taken_{0}, refused_{0}, in_future_{0}, too_old_{0}, foreign_frames_{0}, too_many_{0};
  Count no_room_{0}, bad_detections_{0};
};

}  // namespace pitwall::io
