// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/rate_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hil/sensors/noise.hpp"

namespace pitwall::link {
namespace {

TEST(RateWindow, FindsTheWorstWindowWhereverItBegins) {
  sensors::Noise random(5, 0);
  struct Packet {
    Instant at{};
    std::size_t bytes = 0;
  };
  std::vector<Packet> packets;
  Instant at{};
  RateWindow window(milliseconds(100));
  for (int i = 0; i < 1'000; ++i) {
    at += milliseconds(static_cast<std::int64_t>(random.next() % 40));
    packets.push_back({at, 1 + random.next() % 1'500});
    window.sent(packets.back().bytes, at);
  }
  std::uint64_t worst_bytes = 0, worst_packets = 0, all = 0;
  for (Instant begin{}; begin <= at; begin += milliseconds(1)) {
    std::uint64_t bytes = 0, count = 0;
    for (const Packet& p : packets) {
      if (p.at < begin || p.at >= begin + milliseconds(100)) continue;
      bytes += p.bytes;
      ++count;
    }
    worst_bytes = std::max(worst_bytes, bytes);
    worst_packets = std::max(worst_packets, count);
  }
  for (const Packet& p : packets) all += p.bytes;
  EXPECT_EQ(window.worst_bytes(), worst_bytes);
  EXPECT_EQ(window.worst_packets(), worst_packets);
  EXPECT_EQ(window.bytes(), all);
  EXPECT_EQ(window.packets(), packets.size());
}

TEST(RateWindow, APacketLeavesWhenTheWindowIsOver) {
  RateWindow window(milliseconds(100));
  window.sent(10, Instant{});
  window.sent(20, Instant{} + milliseconds(100) - nanoseconds(1));
  EXPECT_EQ(window.worst_bytes(), 30U);
  RateWindow other(milliseconds(100));
  other.sent(10, Instant{});
  other.sent(20, Instant{} + milliseconds(100));
  EXPECT_EQ(other.worst_bytes(), 20U);
}

}  // namespace
}  // namespace pitwall::link
