// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/gps_clock.hpp"

#include <algorithm>

namespace pitwall::receivers {
namespace {

Duration apart(Duration a, Duration b) { return a < b ? b - a : a - b; }

}  // namespace

Placed GpsClock::place(Stream stream, gnss::GpsTime sampled, Instant arrival) {
  Received& received = streams_[static_cast<std::size_t>(stream)];
  const bool follows = !received.ever || sampled > received.last;
  const StampFlaw standing = sampled == received.last ? StampFlaw::kFrozen : StampFlaw::kBack;
  received.last = sampled;
  received.ever = true;
  const auto placed = [&](StampFlaw flaw) {
    return Placed{Instant{sampled.ns + offset_.ns - least_delay_.ns}, flaw};
  };
  if (!follows && started_) return placed(standing);

  const Duration difference{arrival.ns - sampled.ns};
  const Duration level = difference - received.slower;
  const Duration elapsed = arrival - received_at_;
  const bool stale = started_ && elapsed >= kHalfWindow * 2;
  received_at_ = arrival;
  if (!started_ || stale) {
    begin(level, arrival);
  } else if (is_suspect(level)) {
    return placed(StampFlaw::kFuture);
  }
  turn_half_window(arrival);
  received.smallest = std::min(received.smallest, difference);
  ++received.samples;
  if (is_evidence(received, arrival)) current_ = std::min(current_, level);
  received.at = arrival;
  follow(elapsed);
  return placed(StampFlaw::kNone);
}

// The first sample, or the first after a silence of a whole window.
void GpsClock::begin(Duration level, Instant arrival) {
  started_ = true;
  settled_ = false;
  half_began_ = arrival;
  offset_ = current_ = previous_ = level;
  confirmations_ = 0;
  for (Received& received : streams_) received.smallest = kNever, received.samples = 0;
}

void GpsClock::turn_half_window(Instant arrival) {
  const Duration length = settled_ ? kHalfWindow : kSettling;
  if (arrival - half_began_ < length) return;
  learn_delays();
  settled_ = true;
  half_began_ = arrival;
  if (current_ != kNever) previous_ = current_;
  current_ = kNever;
  for (Received& received : streams_) received.smallest = kNever, received.samples = 0;
}

// Only where the stream that was the quickest was heard: else the others would all seem quicker.
void GpsClock::learn_delays() {
  if (quickest_ < kStreams && streams_[quickest_].smallest == kNever) return;
  std::size_t quickest = 0;
  for (std::size_t i = 1; i < kStreams; ++i)
    if (streams_[i].smallest < streams_[quickest].smallest) quickest = i;
  const Duration least = streams_[quickest].smallest;
  for (Received& received : streams_) {
    if (quickest != quickest_) received.learned = false;
    if (received.samples < kEnough) continue;
    const Duration slower = received.smallest - least;
    // Chance adds delay and takes none away.
    constexpr int kShare = 4;
    received.slower = !received.learned || slower < received.slower
                          ? slower
                          : received.slower + (slower - received.slower) / kShare;
    received.learned = true;
  }
  streams_[quickest].slower = {};
  streams_[quickest].learned = true;
  quickest_ = quickest;
}

bool GpsClock::is_evidence(const Received& received, Instant arrival) const {
  if (quickest_ == kStreams) return true;
  const Received& quickest = streams_[quickest_];
  return &received == &quickest || (received.learned && arrival - quickest.at > kSilence);
}

// Down at once, so that nothing comes before it was true; up slowly, or by a whole step.
void GpsClock::follow(Duration elapsed) {
  const Duration wanted = std::min(current_, previous_);
  const Duration most = elapsed * kSlewPerMillion / 1'000'000;
  const bool steps = wanted <= offset_ || wanted - offset_ > kJitter;
  offset_ = steps ? wanted : std::min(wanted, offset_ + most);
}

// True while a difference far below all others has not been confirmed.
bool GpsClock::is_suspect(Duration level) {
  if (level >= offset_ - (settled_ ? kJitter : kFirstStep)) {
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
