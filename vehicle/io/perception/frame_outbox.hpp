// Frames of detections on their way from a thread that makes them to the 100 Hz loop, with their
// figures.
//   in     put(), by the making thread
//   out    front(), pop(), by the loop; figures and counts by any thread
//   law    the loop never waits for the making thread
//   errors a frame that finds no room is lost and counted
//   cost   front(), pop(): wait-free, no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "vehicle/io/ingress/arrivals.hpp"
#include "vehicle/io/ingress/frame_queue.hpp"

namespace pitwall::io {

class FrameOutbox {
 public:
  struct Counts {
    std::uint64_t frames = 0, no_room = 0;
    double largest_gap_ms = 0.0;  // between two frames
  };

  // `at`: now; `age`: of what the frame is made of. False: it found no room.
  bool put(const world::DetectionFrame& frame, Instant at, Duration age) {
    const bool has_room = queue_.push(frame);
    ++frames_;
    if (!has_room) ++no_room_;
    arrivals_.note(at, age);
    if (last_) largest_gap_ms_ = std::max(largest_gap_ms_.load(), (at - *last_).milliseconds());
    last_ = at;
    return has_room;
  }

  const world::DetectionFrame* front() const { return queue_.front(); }
  // Only after front() has returned one. `age`: of what it is made of, when the loop takes it.
  void pop(Duration age) {
    to_loop_.add(static_cast<double>(age / kAgeCell));
    queue_.pop();
  }

  const Arrivals& arrivals() const { return arrivals_; }
  Counts counts() const { return {frames_, no_room_, largest_gap_ms_}; }

  void add_to(json::Object& row, Instant now) const {
    add_figures(row, arrivals_.newest(now));
    add_figure(row, "largest_gap_ms", largest_gap_ms_);
    add_figure(row, "to_loop_p50_ms", to_loop_.quantile(0.5) * kAgeCell.milliseconds());
    add_figure(row, "to_loop_p99_ms", to_loop_.quantile(0.99) * kAgeCell.milliseconds());
    row.number("frames", frames_.load()).number("no_room", no_room_.load());
  }

 private:
  static constexpr Duration kAgeCell = microseconds(100);

  FrameQueue queue_;
  Arrivals arrivals_;
  std::atomic<std::uint64_t> frames_{0}, no_room_{0};
  std::atomic<double> largest_gap_ms_{0.0};
  std::optional<Instant> last_;  // of the making thread
  Histogram to_loop_{10'000};    // of the loop, in kAgeCell
};

}  // namespace pitwall::io
