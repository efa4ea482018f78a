// Puts a traffic onto an interface in real time: one batch per millisecond by absolute deadlines,
// so that no lateness adds up. After a stall it catches up with a pause between batches.
//   in     the traffic, when it starts (monotonic clock)
//   out    how many frames the kernel took, and how late the batches were
//   errors frames that the kernel did not take are offered again until they go out; how often that
//          was needed is counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::load {

// Of wake-ups, against their deadlines.
struct Lateness {
  double p50_us = kUnset, p99_us = kUnset, max_us = kUnset;
};
Lateness lateness_of(std::vector<double>& late_us);  // sorts them

struct SenderFigures {
  std::uint64_t sent = 0, offered_again = 0;
  Lateness late;
  std::vector<Instant> omitted_at;  // when each omission would have gone out
};

SenderFigures send(transport::CanSocket& bus, Traffic& traffic, Instant start);

}  // namespace pitwall::load
