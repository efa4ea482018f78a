// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/link_stats.hpp"

#include <algorithm>

namespace pitwall::intake {

void LinkStats::note(const telemetry::StatePacket& packet, Instant at) {
  if (ever()) {
    advance(at);
  } else {
    first_ = counted_to_ = at;
  }
  last_ = std::max(at, last_);
  age_at_last_ = std::max(packet.age_of(telemetry::Group::kEgo), Duration{});
  received_[packets_ % kRing] = at;
  ++packets_;
}

void LinkStats::advance(Instant now) {
  if (!ever() || now <= counted_to_) return;
  ages_.add(age_at_last_ + (counted_to_ - last_), now - counted_to_);
  counted_to_ = now;
}

double LinkStats::rate_hz(Instant now) const {
  const std::uint64_t kept = std::min<std::uint64_t>(packets_, kRing);
  std::uint64_t recent = 0;
  for (std::uint64_t i = 0; i < kept; ++i) {
    if (now - received_[i] < kRateWindow) ++recent;
  }
  return static_cast<double>(recent) / kRateWindow.seconds();
}

double LinkStats::mean_rate_hz() const {
  if (packets_ < 2 || last_ == first_) return 0.0;
  return static_cast<double>(packets_ - 1) / (last_ - first_).seconds();
}

}  // namespace pitwall::intake
