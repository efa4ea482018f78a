// How the other end's clock stands to ours, from the times of packets and their acknowledgements.
//   in     exchanges: we sent t1, they received t2, they sent t3, we received t4 (t1, t4 our clock,
//          t2, t3 theirs); tx_time of packets
//   out    offset with a bound that always holds while both clocks run at their rate +- 100 ppm:
//          half of the least round trip seen, plus drift since; one-way delays
//   units  Instant; the other end's 24-bit tx_time (100 us, wraps after 1677 s) is unwrapped here
//   law    only monotonic clocks; a peer that stamps from the future harms nobody but its own
//          figure
//   source RFC 5905 (offset, delay); least-delay samples of a 10 s window; drift by Theil-Sen
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct Exchange {
  Instant t1{}, t2{}, t3{}, t4{};
};

// 24 bits of 100 us to the Instant nearest to `near`.
Instant unwrap_tx_time(std::uint32_t tx_time_100us, Instant near);
std::uint32_t wrap_tx_time(Instant now);

class ClockSync {
 public:
  // Time of sending of a packet that was just received, on the other end's clock as we count it.
  Instant peer_time(std::uint32_t tx_time_100us, Instant received);

  void note(const Exchange& exchange);
  bool known() const;
  Duration offset() const;            // theirs minus ours; known() only
  Duration bound(Instant now) const;  // |error of offset| <= bound
  Duration round_trip() const;        // of the newest exchange
  Duration least_round_trip() const;
  Instant to_own(Instant peer) const;
  Duration one_way(Instant peer_sent, Instant received) const;
  void forget() { *this = {}; }

 private:
  Duration offset_{};
};

}  // namespace pitwall::telemetry
