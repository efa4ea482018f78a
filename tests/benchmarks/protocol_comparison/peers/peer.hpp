// Common parts of the peer programs of `pitwall-benchmarks radio`: command line, clock, the state
// that they send, and what the base prints. See
// tests/benchmarks/protocol_comparison/comparison.hpp.
//   in     car|base END_NS BULK [MODE]
//   out    the base prints "MADE_NS ARRIVED_NS [STREAM]" for each state, "bulk ARRIVED_NS BYTES"
//          for bulk
//   units  ns of CLOCK_MONOTONIC
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::peers {

inline constexpr std::size_t kFloats = 84, kIntegers = 10, kFlags = 6;
inline constexpr std::size_t kBulkBytes = 4'000;
inline constexpr Duration kStatePeriod = milliseconds(20), kBulkPeriod = milliseconds(50);
// Link rate for which a tuned peer is configured, and the share of it that the peer uses.
inline constexpr double kLinkBytes_per_s = 32'000.0, kTunedShare = 0.95;

struct Call {
  bool car = false;
  Instant end{};
  bool bulk = false;
  std::string_view mode;
};

inline Call call_of(int argc, char** argv) {
  if (argc < 4 || (std::string_view(argv[1]) != "car" && std::string_view(argv[1]) != "base")) {
    std::fprintf(stderr, "usage: %s car|base END_NS BULK [MODE]\n", argv[0]);
    std::exit(2);
  }
  return {.car = std::string_view(argv[1]) == "car",
          .end = {std::strtoll(argv[2], nullptr, 10)},
          .bulk = std::string_view(argv[3]) == "1",
          .mode = argc > 4 ? argv[4] : ""};
}

// Vehicle state that changes as while driving: no field stays zero for long.
struct VehicleState {
  std::int64_t made_ns = 0;
  std::array<float, kFloats> floats{};
  std::array<std::int32_t, kIntegers> integers{};
  std::array<bool, kFlags> flags{};
};

inline VehicleState state_at(Instant now) {
  const double t = Duration{now.ns}.seconds();
  VehicleState state;
  state.made_ns = now.ns;
  for (std::size_t i = 0; i < kFloats; ++i) {
    const auto k = static_cast<double>(i);
    state.floats[i] = static_cast<float>((5.0 + k) * std::sin(t * (0.2 + 0.03 * k) + k));
  }
  for (std::size_t i = 0; i < kIntegers; ++i)
    state.integers[i] = static_cast<std::int32_t>(i * 3 + static_cast<std::uint64_t>(t) % 100 + 1);
  for (std::size_t i = 0; i < kFlags; ++i)
    state.flags[i] = (static_cast<std::uint64_t>(t) + i) % 2 == 1;
  return state;
}

// Size and times of the bulk; the defaults send each object at once.
struct BulkPlan {
  std::size_t bytes = kBulkBytes;  // per send
  Duration period = kBulkPeriod, offset = milliseconds(7);
};

// MODE "paced": one piece of bulk half a period after each state, as large as the state leaves room
// for in the tuned share of the link.
//   in   bytes of the state of a period and of the headers of a piece, with IP and UDP
inline BulkPlan paced(Duration state_period, std::size_t state, std::size_t headers) {
  const double all = kLinkBytes_per_s * kTunedShare * state_period.seconds();
  const double left = all - static_cast<double>(state + headers);
  return {.bytes = left > 1.0 ? static_cast<std::size_t>(left) : 1,
          .period = state_period,
          .offset = state_period / 2};
}

// Sends state and bulk at their periods until the end. A late send happens at once; missed ones are
// not repeated.
template <class SendState, class SendBulk>
void send_until_end(const Call& call, Duration state_period, const BulkPlan& bulk,
                    SendState&& send_state, SendBulk&& send_bulk) {
  const Instant begin = transport::monotonic_now();
  Instant state_due = begin, bulk_due = begin + bulk.offset;
  while (true) {
    const Instant due = call.bulk && bulk_due < state_due ? bulk_due : state_due;
    if (due >= call.end) break;
    transport::sleep_until(due);
    const Instant now = transport::monotonic_now();
    if (due == state_due) {
      send_state(now);
      state_due = transport::next_tick(state_due, state_period, now).deadline;
    } else {
      send_bulk(now);
      bulk_due = transport::next_tick(bulk_due, bulk.period, now).deadline;
    }
  }
}

// `stream`: name of the part of the state, after a blank; empty if the state arrives as a whole.
inline void note_arrival(std::int64_t made_ns, const char* stream = "") {
  std::printf("%lld %lld%s\n", static_cast<long long>(made_ns),
              static_cast<long long>(transport::monotonic_now().ns), stream);
}

inline void note_bulk(std::size_t bytes) {
  std::printf("bulk %lld %zu\n", static_cast<long long>(transport::monotonic_now().ns), bytes);
}

}  // namespace pitwall::peers
