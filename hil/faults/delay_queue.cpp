// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/delay_queue.hpp"

#include <algorithm>

namespace pitwall::faults {

DelayQueue::DelayQueue() { heap_.reserve(kMaxDelayed); }

bool DelayQueue::later(const Entry& a, const Entry& b) {
  return a.timed.at != b.timed.at ? a.timed.at > b.timed.at : a.sequence > b.sequence;
}

bool DelayQueue::push(const TimedFrame& frame) {
  if (heap_.size() == kMaxDelayed) return false;
  heap_.push_back({frame, sequence_++});
  std::push_heap(heap_.begin(), heap_.end(), later);
  return true;
}

std::optional<TimedFrame> DelayQueue::pop(Instant now) {
  if (heap_.empty() || heap_.front().timed.at > now) return std::nullopt;
  std::pop_heap(heap_.begin(), heap_.end(), later);
  const TimedFrame due = heap_.back().timed;
  heap_.pop_back();
  return due;
}

}  // namespace pitwall::faults
