// Rate of the car's packets, and time of the last one.
//   units  Hz, over the last second and over the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class PacketRate {
 public:
  static constexpr Duration kLostAfter = seconds(1);  // 50 packet periods

  void note(Instant at);

  double rate_hz(Instant now) const;
  double mean_rate_hz() const;  // from the first packet to the last
  std::uint64_t packets() const { return packets_; }
  Instant first() const { return first_; }
  Duration since_last(Instant now) const { return now - last_; }
  bool ever() const { return packets_ > 0; }
  // True if packets came before but none within kLostAfter.
  bool lost(Instant now) const { return ever() && since_last(now) > kLostAfter; }

 private:
  static constexpr std::size_t kRing = 512;  // more packets a second than any car sends
  static constexpr Duration kWindow = seconds(1);

  std::array<Instant, kRing> received_{};
  std::uint64_t packets_ = 0;
  Instant first_{}, last_{};
};

}  // namespace pitwall::link
