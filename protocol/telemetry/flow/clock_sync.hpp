// Estimator of the offset between both ends' clocks, from the times of packets and their
// acknowledgements.
//   in     exchanges: we sent t1, they received t2, they sent t3, we received t4 (t1, t4 our clock,
//          t2, t3 theirs); tx_time of packets
//   out    offset with a bound that always holds while both clocks run at their rate +- 100 ppm;
//          one-way delays
//   units  Instant; the other end's 24-bit tx_time (100 us, wraps after 1677 s) is unwrapped here
//   invariants
//          no packet arrives before it was sent: t3 - t4 <= offset <= t2 - t1. The highest such
//          floor and the lowest such ceiling hold together, each loosened by the drift since; the
//          offset is taken in their middle, the bound is half their distance. So drift is followed
//          without being estimated, and each direction is compared by its own quickest packet
//          only monotonic clocks; a peer that stamps from the future harms nobody but its own
//          figure: what contradicts is put aside, and replaces the figure once it persists
//   source RFC 5905 (exchange); K. Marzullo, S. Owicki, "Maintaining the Time in a Distributed
//          System", 1983 (intersection of intervals)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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
  bool known() const { return known_; }
  Duration offset() const;                             // theirs minus ours; known() only
  Duration bound(Instant now) const;                   // |error of offset| <= bound
  Duration round_trip() const { return round_trip_; }  // of the newest exchange
  Duration least_round_trip() const;                   // of 5 to 10 s
  Instant to_own(Instant peer) const;
  Duration one_way(Instant peer_sent, Instant received) const;
  std::uint64_t contradictions() const { return contradictions_; }
  void forget();  // the counter stays

 private:
  // What the offset is between, as of one moment of our clock.
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
  std::array<Duration, 2> least_{};  // of the interval under way and the one before
  Instant interval_start_{};
};

}  // namespace pitwall::telemetry
