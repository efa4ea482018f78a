// Transmit buffer for the CAN bus: one slot per identifier, the latest value wins, and no old frame
// is sent after waiting in a queue. Pure: the fill of the kernel queue and the time are inputs.
//
//   tick k    observe: kernel empty   offer -> due: all of it -> kernel takes it
//   tick k+1  observe: not empty yet  offer -> due: nothing
//   tick k+2  observe: not empty yet  offer -> the new values replace those of k+1; due: nothing
//   tick k+3  observe: kernel empty   offer -> due: the newest values only
//
//   in     frames of a tick in order of urgency (brake first); the fill of the kernel queue
//   out    frames to give to the kernel now, in that order; then those left from earlier ticks
//   invariants
//          the kernel holds the frames of at most one tick, so a frame that waits there is never
//          older than the stall; a frame that was not given to it within `age_max` is dropped and
//          counted; never two frames of one identifier
//   errors none: every frame is counted as sent, replaced, stale or without room
//   source kernel queues of CAN interfaces are FIFOs of 10 frames and more; a drive-by-wire that
//          executes commands of a second ago after a stall is worse than one that receives none
//   cost   O(frames x slots), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {

struct TransmitParams {
  Duration age_max = milliseconds(20);  // two ticks: by then a newer command exists
};

struct TransmitCounters {
  std::uint64_t offered = 0, taken = 0;
  std::uint64_t replaced = 0;   // replaced by a newer value before they could be sent
  std::uint64_t stale = 0;      // older than age_max without a newer value
  std::uint64_t no_room = 0;    // more identifiers than slots
  std::uint64_t not_taken = 0;  // attempts that the kernel refused (ENOBUFS etc.)

  // Frames that could not be sent in time.
  std::uint64_t dropped() const { return replaced + stale + no_room; }
};

// Fill of the kernel queue with our frames.
struct KernelQueue {
  std::uint32_t bytes = 0;  // 0: all frames were sent
  // Frames may have been discarded since the last observation: less fill then shows no progress.
  bool flushed = false;
};

class TransmitSlots {
 public:
  static constexpr std::size_t kSlots = 64;

  explicit TransmitSlots(const TransmitParams& params = {}) : params_(params) {}

  // To be called once per tick, before the other functions.
  void observe_queue(const KernelQueue& queue, Instant now);
  // Frames of one tick, in order of urgency.
  void offer(std::span<const can::Frame> frames, Instant now);
  // Frames to give to the kernel; valid until the next call. Empty while it holds older ones.
  std::span<const can::Frame> due(Instant now);
  // The kernel accepted the first `count` frames of due(). To be called after each due().
  void taken(std::size_t count, Instant now);

  // Time for which frames have waited without any being sent; zero if none waits or frames are
  // being sent.
  Duration stalled(Instant now) const;
  // The frames in the kernel are stale and are not being sent: they must be discarded.
  bool should_flush(Instant now) const;
  const TransmitCounters& counters() const { return counters_; }

 private:
  void keep(std::size_t done, Instant oldest);

  TransmitParams params_;
  FixedVector<can::Frame, kSlots> frames_;
  FixedVector<Instant, kSlots> since_;  // offer time of each frame
  std::size_t tried_ = 0;               // number of frames returned by the last due()
  std::uint32_t bytes_ = 0;             // fill at the last observation
  bool given_ = false;                  // frames were given since then
  bool stuck_ = false;
  Instant given_at_{}, moved_at_{};
  TransmitCounters counters_;
};

}  // namespace pitwall::io
