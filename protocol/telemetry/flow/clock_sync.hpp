// Estimator of the offset between the clocks of both ends, from the times of packets and their
// acknowledgements.
//   in     exchanges: sent here at t1, received by the peer at t2, sent by the peer at t3, received
//          here at t4 (t1, t4 on our clock, t2, t3 on the peer's); tx_time of packets
//   out    offset with a bound that always holds while both clocks run within +- 100 ppm; one-way
//          delays
//   units  Instant; the other end's 24-bit tx_time (100 us, wraps after 1677 s) is unwrapped here
//   invariants
//          no packet arrives before it was sent: t3 - t4 <= offset <= t2 - t1. The highest such
//          floor and the lowest such ceiling hold together, each widened by the drift since then.
//          The offset is their middle, the bound half their distance. So drift is followed without
//          being estimated, and the fastest packet of each direction sets its limit
//          clocks are monotonic; a peer with stamps from the future spoils only its own estimate:
//          an exchange that contradicts the estimate is ignored, and replaces it if this persists
//   source RFC 5905 (exchange); K. Marzullo, S. Owicki, "Maintaining the Time in a Distributed
//          System", 1983 (intersection of intervals)
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
  // Time of sending of a packet that was just received, on the other end's clock, unwrapped.
  Instant peer_time(std::uint32_t tx_time_100us, Instant received);

  void note(const Exchange& exchange);
  bool known() const { return known_; }
  Duration offset() const;                             // theirs minus ours; known() only
  Duration bound(Instant now) const;                   // |error of offset| <= bound
  Duration round_trip() const { return round_trip_; }  // of the newest exchange
  Instant to_own(Instant peer) const;
  Duration one_way(Instant peer_sent, Instant received) const;
  std::uint64_t contradictions() const { return contradictions_; }
  void forget();  // the counter stays

 private:
  // Limits of the offset at one moment of our clock.
  struct Hull {
    Duration floor{}, ceiling{};
    Instant at{};
  };

  Hull loosened(Instant now) const;
  void start(const Hull& hull);

  bool known_ = false;
  Hull hull_;
  int strikes_ = 0;  // contradictions in a row
  std::uint64_t contradictions_ = 0;
  std::optional<Instant> last_peer_, last_received_;
  Duration round_trip_{};
};

}  // namespace pitwall::telemetry
