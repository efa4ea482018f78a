// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/transmit_slots.hpp"

#include <algorithm>

namespace pitwall::io {
namespace {

bool same_slot(const can::Frame& a, const can::Frame& b) {
  return a.id == b.id && a.extended == b.extended;
}

}  // namespace

void TransmitSlots::offer(std::span<const can::Frame> frames, Instant now) {
  const auto old_frames = frames_;
  const auto old_since = since_;
  frames_.clear();
  since_.clear();
  const auto put = [&](const can::Frame& frame, Instant since, bool newer) {
    const auto slot = std::find_if(frames_.begin(), frames_.end(),
                                   [&](const can::Frame& f) { return same_slot(f, frame); });
    if (slot != frames_.end()) {
      ++counters_.replaced;
      if (newer) *slot = frame;
    } else if (!frames_.push(frame) || !since_.push(since)) {
      ++counters_.no_room;
    }
  };
  for (const can::Frame& frame : frames) put(frame, now, true);
  for (std::size_t i = 0; i < old_frames.size(); ++i) put(old_frames[i], old_since[i], false);
  counters_.offered += frames.size();
}

// Drops the leading `done` and, of the rest, what is as old as `oldest`.
void TransmitSlots::keep(std::size_t done, Instant oldest) {
  const auto old_frames = frames_;
  const auto old_since = since_;
  frames_.clear();
  since_.clear();
  for (std::size_t i = done; i < old_frames.size(); ++i) {
    if (old_since[i] <= oldest || !frames_.push(old_frames[i]) || !since_.push(old_since[i]))
      ++counters_.stale;
  }
}

void TransmitSlots::observe_queue(const KernelQueue& queue, Instant now) {
  // Right after giving, only an empty queue is news: how full it was then nobody has looked.
  const bool less = given_ ? queue.bytes == 0 : queue.bytes < bytes_;
  const bool moved = less && !queue.flushed;
  if (queue.bytes == 0 && (moved || frames_.empty())) {
    stuck_ = false;
  } else if (moved) {
    stuck_ = true;
    moved_at_ = now;
  } else if (queue.bytes > 0 && !stuck_) {
    stuck_ = true;
    moved_at_ = given_at_;
  }
  bytes_ = queue.bytes;
  given_ = false;
}

std::span<const can::Frame> TransmitSlots::due(Instant now) {
  keep(0, now - params_.age_max);
  tried_ = bytes_ > 0 ? 0 : frames_.size();
  return frames_.span().first(tried_);
}

void TransmitSlots::taken(std::size_t count, Instant now) {
  if (count < tried_ && !stuck_) {
    stuck_ = true;
    moved_at_ = now;
  }
  counters_.not_taken += tried_ - count;
  counters_.taken += count;
  tried_ = 0;
  if (count == 0) return;
  given_ = true;
  given_at_ = now;
  keep(count, now - params_.age_max);
}

Duration TransmitSlots::stalled(Instant now) const { return stuck_ ? now - moved_at_ : Duration{}; }

bool TransmitSlots::should_flush(Instant now) const {
  return stuck_ && bytes_ > 0 && now - given_at_ >= params_.age_max;
}

}  // namespace pitwall::io
