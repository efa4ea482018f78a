// Rate of the accepted packets and age of the information they carry.
//   age    of the ego sample (or of the packet where that group was never sampled) when it was
//          sent, plus the time since reception. The time on the way is not in it: the clocks of car
//          and base are not compared in this version.
//   units  Hz over the last second, Duration
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "basestation/intake/age_histogram.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

class LinkStats {
 public:
  static constexpr Duration kLostAfter = seconds(1);  // 50 packets

  // Packets in order of acceptance.
  void note(const telemetry::StatePacket& packet, Instant at);
  // Counts the time since the last packet; before ages are read.
  void advance(Instant now);

  double rate_hz(Instant now) const;
  double mean_rate_hz() const;  // from the first packet to the last
  Duration since_last(Instant now) const { return now - last_; }
  bool ever() const { return packets_ > 0; }
  // A car that was heard and is no longer.
  bool lost(Instant now) const { return ever() && since_last(now) > kLostAfter; }
  const AgeHistogram& ages() const { return ages_; }

 private:
  static constexpr std::size_t kRing = 512;  // more packets a second than any sender makes
  static constexpr Duration kRateWindow = seconds(1);

  std::array<Instant, kRing> received_{};
  std::uint64_t packets_ = 0;
  Instant first_{}, last_{}, counted_to_{};
  Duration age_at_last_{};
  AgeHistogram ages_;
};

}  // namespace pitwall::intake
