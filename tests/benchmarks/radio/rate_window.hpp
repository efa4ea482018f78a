// Largest amount sent in any window of a given length.
//   in     packets in order of time
//   out    bytes and packets of the worst window; totals
//   invariants
//          the window [t, t + length) includes its begin: the worst one begins with a packet
//   cost   O(1) for each packet, amortised
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class RateWindow {
 public:
  explicit RateWindow(Duration length) : length_(length) {}

  void sent(std::size_t bytes, Instant at);

  std::uint64_t worst_bytes() const { return worst_bytes_; }
  std::uint64_t worst_packets() const { return worst_packets_; }
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t packets() const { return packets_; }
  Duration length() const { return length_; }

 private:
  struct Packet {
    Instant at{};
    std::size_t bytes = 0;
  };
  Duration length_;
  std::deque<Packet> inside_;
  std::uint64_t inside_bytes_ = 0, worst_bytes_ = 0, worst_packets_ = 0, bytes_ = 0, packets_ = 0;
};

}  // namespace pitwall::link
