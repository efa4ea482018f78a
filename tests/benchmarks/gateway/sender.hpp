// Sender of the traffic on an interface in real time: one batch per millisecond by absolute
// deadlines, so that delays do not add up. After a stall it catches up with a pause between
// batches.
//   in     the traffic, its start (monotonic clock)
//   out    number of frames that the kernel accepted, and the lateness of the batches
//   errors frames that the kernel does not accept are sent again until it accepts them; the
//          repetitions are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::load {

// Delay of wake-ups after their deadlines.
struct Lateness {
  double p50_us = kUnset, p99_us = kUnset, max_us = kUnset;
};
Lateness lateness_of(std::vector<double>& late_us);  // sorts the argument

struct SenderFigures {
  std::uint64_t sent = 0, offered_again = 0;
  Lateness late;
  std::vector<Instant> omitted_at;  // time at which each omitted frame would have been sent
};

SenderFigures send(transport::CanSocket& bus, Traffic& traffic, Instant start);

}  // namespace pitwall::load
