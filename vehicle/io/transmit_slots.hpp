// The way out to the bus: one slot per identifier, the latest value wins, nothing old is ever sent
// because there was a queue. Pure: what the kernel still holds, and now, come in.
//
//   tick k    look: kernel empty   offer -> due: all of it -> kernel takes it
//   tick k+1  look: not empty yet  offer -> due: nothing
//   tick k+2  look: not empty yet  offer -> the new values replace those of k+1; due: nothing
//   tick k+3  look: kernel empty   offer -> due: the newest values only
//
//   in     frames of a tick in the order of their urgency (brake first); what the kernel holds
//   out    frames to give to the kernel now, in that order; then those that an earlier tick left
//   invariants
//          at most one tick's frames are in the kernel, so what waits there is never older than the
//          stall; a frame that was not given to it within `age_max` is dropped and counted; never
//          two frames of one identifier
//   errors none: every frame is sent, replaced, stale or without room, and counted as such
//   source kernel queues of CAN interfaces are FIFOs of 10 frames and more; a drive-by-wire that
//          obeys the commands of a second ago after a stall is worse than one that hears nothing
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
  Duration age_max = milliseconds(20);  // two ticks: a command that old has had its successor
};

struct TransmitCounters {
  std::uint64_t offered = 0, taken = 0;
  std::uint64_t replaced = 0;   // by a newer value, before they could be sent
  std::uint64_t stale = 0;      // older than age_max without a newer value
  std::uint64_t no_room = 0;    // more identifiers than slots
  std::uint64_t not_taken = 0;  // attempts: frames that the kernel refused (ENOBUFS and the like)

  // Frames that could not be sent in time.
  std::uint64_t dropped() const { return replaced + stale + no_room; }
};

// What the kernel has of ours.
struct KernelQueue {
  std::uint32_t bytes = 0;  // 0: everything has left
  bool flushed = false;  // frames may have been thrown away since the last look: less means nothing
};

class TransmitSlots {
 public:
  static constexpr std::size_t kSlots = 64;

  explicit TransmitSlots(const TransmitParams& params = {}) : params_(params) {}

  // Once a tick, before the others.
  void look(const KernelQueue& queue, Instant now);
  // Of one tick, in order of urgency.
  void offer(std::span<const can::Frame> frames, Instant now);
  // Frames to give to the kernel; valid until the next call. Nothing while it holds older ones.
  std::span<const can::Frame> due(Instant now);
  // The kernel took that many of due(), from the front. To be called after each due().
  void taken(std::size_t count, Instant now);

  // How long frames have waited without any of them leaving; zero: nothing waits, or it moves.
  Duration stalled(Instant now) const;
  // What the kernel holds has become stale and does not move: it must not go out any more.
  bool should_flush(Instant now) const;
  const TransmitCounters& counters() const { return counters_; }

 private:
  void keep(std::size_t done, Instant oldest);

  TransmitParams params_;
  FixedVector<can::Frame, kSlots> frames_;
  FixedVector<Instant, kSlots> since_;  // of each frame: when it was offered
  std::size_t tried_ = 0;               // of frames_, by the last due()
  std::uint32_t bytes_ = 0;             // in the kernel at the last look
  bool given_ = false;                  // something since the last look
  bool stuck_ = false;
  Instant given_at_{}, moved_at_{};
  TransmitCounters counters_;
};

}  // namespace pitwall::io
