// Rate of the car's packets, and time of the last one.
//   units  Hz over the last second; over the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class PacketRate {
 public:
  static constexpr Duration kLostAfter = seconds(1);  // 50 packets

  void note(Instant at);

  double rate_hz(Instant now) const;
  double mean_rate_hz() const;  // from the first packet to the last
  std::uint64_t packets() const { return packets_; }
  Instant first() const { return first_; }
  Duration since_last(Instant now) const { return now - last_; }
  bool ever() const { return packets_ > 0; }
  // A car that was heard and is no longer.
  bool lost(Instant now) const { return ever() && since_last(now) > kLostAfter; }

 private:
  static constexpr std::size_t kRing = 512;  // more packets a second than any sender makes
  static constexpr Duration kWindow = seconds(1);

  std::array<Instant, kRing> received_{};
  std::uint64_t packets_ = 0;
  Instant first_{}, last_{};
};

}  // namespace pitwall::link
