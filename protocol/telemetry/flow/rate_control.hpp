// How much of the budget the path carries at present, by the gradient of its one-way delay: a queue
// that grows is congestion, loss alone is a fade and changes nothing.
//   in     deliveries: when a packet was sent (our clock) and received (theirs; any offset)
//   out    factor of the budget, (0, 1]
//   law    overuse: 0.85 of the rate that arrived; else + 5 % of the budget per second; never below
//          the floor that safety needs
//   source trendline filter of Google congestion control (draft-ietf-rmcat-gcc-02, 5.3 to 5.5), its
//          delay part only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class RateControl {
 public:
  RateControl(double budget_bytes_per_s, double floor_bytes_per_s);

  void delivered(Instant sent, Instant received_by_peer, std::size_t bytes, Instant now);
  double factor(Instant now);
  Duration queue_delay() const;  // above the least of the last 10 s
  bool congested() const;
  std::uint64_t backoffs() const;

 private:
  double budget_, floor_;
};

}  // namespace pitwall::telemetry
