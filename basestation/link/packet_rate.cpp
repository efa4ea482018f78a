// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/packet_rate.hpp"

#include <algorithm>

namespace pitwall::link {

void PacketRate::note(Instant at) {
  if (!ever()) first_ = at;
  last_ = std::max(at, last_);
  received_[packets_ % kRing] = at;
  ++packets_;
}

double PacketRate::rate_hz(Instant now) const {
  const std::uint64_t kept = std::min<std::uint64_t>(packets_, kRing);
  std::uint64_t recent = 0;
  for (std::uint64_t i = 0; i < kept; ++i) {
    if (now - received_[i] < kWindow) ++recent;
  }
  return static_cast<double>(recent) / kWindow.seconds();
}

double PacketRate::mean_rate_hz() const {
  if (packets_ < 2 || last_ == first_) return 0.0;
  return static_cast<double>(packets_ - 1) / (last_ - first_).seconds();
}

}  // namespace pitwall::link
