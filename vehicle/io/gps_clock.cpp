// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/gps_clock.hpp"

namespace pitwall::io {

std::optional<Instant> GpsClock::place(gnss::GpsTime sampled, Instant arrival) {
  const Duration difference{arrival.ns - sampled.ns};
  if (started_ && refuse(difference)) return std::nullopt;
  note(difference, arrival);
  return Instant{sampled.ns + offset().ns};
}

// True while a difference far below all others has not been confirmed.
bool GpsClock::refuse(Duration difference) {
  if (difference >= offset() - kStep) {
    confirmations_ = 0;
    return false;
  }
  const Duration apart = difference < suspect_ ? suspect_ - difference : difference - suspect_;
  confirmations_ = confirmations_ > 0 && apart < kStep ? confirmations_ + 1 : 1;
  suspect_ = difference;
  if (confirmations_ < kConfirmations) return true;
  confirmations_ = 0;
  ++steps_;
  return false;
}

void GpsClock::note(Duration difference, Instant arrival) {
  const bool stale = started_ && arrival - half_began_ >= kHalfWindow * 2;
  if (!started_ || stale) {  // the first, or after a silence of a whole window
    started_ = true;
    half_began_ = arrival;
    current_ = previous_ = difference;
    return;
  }
  if (arrival - half_began_ >= kHalfWindow) {
    previous_ = current_;
    current_ = difference;
    half_began_ = half_began_ + kHalfWindow;
  }
  if (difference < current_) current_ = difference;
}

}  // namespace pitwall::io
