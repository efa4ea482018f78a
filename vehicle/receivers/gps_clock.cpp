// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/gps_clock.hpp"

#include <algorithm>

namespace pitwall::receivers {
namespace {

Duration apart(Duration a, Duration b) { return a < b ? b - a : a - b; }

}  // namespace

Placed GpsClock::place(Stream stream, gnss::GpsTime sampled, Instant arrival) {
  Heard& heard = streams_[static_cast<std::size_t>(stream)];
  const bool follows = !heard.ever || sampled > heard.last;
  const StampFlaw standing = sampled == heard.last ? StampFlaw::kFrozen : StampFlaw::kBack;
  heard.last = sampled;
  heard.ever = true;
  const auto placed = [&](StampFlaw flaw) {
    return Placed{Instant{sampled.ns + offset().ns - least_delay_.ns}, flaw};
  };
  if (!follows && started_) return placed(standing);

  const Duration difference{arrival.ns - sampled.ns};
  const Duration level = difference - heard.slower;
  const bool stale = started_ && arrival - heard_at_ >= kHalfWindow * 2;
  heard_at_ = arrival;
  if (!started_ || stale) {
    begin(level, arrival);
  } else if (is_suspect(level)) {
    return placed(StampFlaw::kFuture);
  }
  turn_half_window(arrival);
  heard.smallest = std::min(heard.smallest, difference);
  current_ = std::min(current_, level);
  return placed(StampFlaw::kNone);
}

// The first sample, or the first after a silence of a whole window.
void GpsClock::begin(Duration level, Instant arrival) {
  started_ = true;
  settled_ = false;
  half_began_ = arrival;
  current_ = previous_ = level;
  confirmations_ = 0;
  for (Heard& heard : streams_) heard.smallest = kNever;
}

void GpsClock::turn_half_window(Instant arrival) {
  const Duration length = settled_ ? kHalfWindow : kSettling;
  if (arrival - half_began_ < length) return;
  learn_delays();
  settled_ = true;
  half_began_ = arrival;
  previous_ = current_;
  current_ = kNever;
  for (Heard& heard : streams_) heard.smallest = kNever;
}

// Only where the stream that was the quickest was heard: else the others would all seem quicker.
void GpsClock::learn_delays() {
  Duration quickest = kNever;
  bool comparable = false;
  for (const Heard& heard : streams_) {
    quickest = std::min(quickest, heard.smallest);
    comparable = comparable || (heard.smallest != kNever && heard.slower == Duration{});
  }
  if (!comparable) return;
  for (Heard& heard : streams_)
    if (heard.smallest != kNever) heard.slower = heard.smallest - quickest;
}

// True while a difference far below all others has not been confirmed.
bool GpsClock::is_suspect(Duration level) {
  if (level >= offset() - (settled_ ? kJitter : kFirstStep)) {
    confirmations_ = 0;
    return false;
  }
  const bool agrees = confirmations_ > 0 && apart(level, suspect_) < kAgreement;
  confirmations_ = agrees ? confirmations_ + 1 : 1;
  suspect_ = level;
  if (confirmations_ < kConfirmations) return true;
  confirmations_ = 0;
  ++steps_;
  return false;
}

}  // namespace pitwall::receivers
