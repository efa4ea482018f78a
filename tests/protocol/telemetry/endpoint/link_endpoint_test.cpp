// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/link_endpoint.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "tests/support/endpoint_pair.hpp"

namespace pitwall::telemetry {
namespace {

using pitwall::testing::EndpointPair;
using pitwall::testing::WireDatagram;

TEST(LinkEndpoint, OneSequenceNumberIsOnePlaintext) {
  EndpointPair pair(2);
  std::map<std::pair<bool, std::uint32_t>, std::vector<std::uint8_t>> sent;
  std::size_t copies = 0;
  pair.gate = [&](const WireDatagram& datagram) {
    const auto header = parse_header(datagram.span());
    EXPECT_TRUE(header.has_value());
    if (header->kind != Kind::kSealed) return true;
    const std::vector<std::uint8_t> bytes(datagram.span().begin(), datagram.span().end());
    const auto [it, fresh] = sent.try_emplace({datagram.down, header->sequence_low}, bytes);
    EXPECT_EQ(it->second, bytes) << "the same number, other bytes";
    copies += fresh ? 0 : 1;
    return true;
  };
  pair.run(seconds(3));
  EXPECT_GT(sent.size(), 200u);
  EXPECT_GT(copies, 200u);
}

TEST(LinkEndpoint, APacketEachSlot) {
  EndpointPair pair;
  std::vector<Instant> left;
  pair.gate = [&](const WireDatagram& datagram) {
    if (!datagram.down && parse_header(datagram.span())->kind == Kind::kSealed) {
      left.push_back(pair.now);
    }
    return true;
  };
  pair.run(seconds(3));
  ASSERT_GT(left.size(), 140u);
  for (std::size_t i = 20; i < left.size(); ++i) {
    EXPECT_LE(left[i] - left[i - 1], kSlot + milliseconds(1));
  }
  EXPECT_LE(left.size(), 155u);
}

TEST(LinkEndpoint, WhatIsRefusedIsCountedAndNothingIsAnswered) {
  EndpointPair pair;
  std::vector<WireDatagram> received;
  pair.gate = [&](const WireDatagram& datagram) {
    if (received.size() < 64) received.push_back(datagram);
    return true;
  };
  pair.run(seconds(1));
  const LinkReport before = pair.base->report(pair.now);
  for (WireDatagram forged : received) {
    forged.down = true;
    forged.bytes[forged.size - 1] ^= 1;
    pair.feed(forged);
  }
  const LinkReport after = pair.base->report(pair.now);
  EXPECT_EQ(after.association.opened, before.association.opened);
  EXPECT_EQ(after.sessions, before.sessions);
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < kRefusals; ++i) {
    refused += after.association.refused[i] - before.association.refused[i];
  }
  EXPECT_EQ(refused, received.size());
}

TEST(LinkEndpoint, ReportSaysWhatTheWireDoes) {
  EndpointPair pair;
  pair.run(seconds(5));
  const LinkReport report = pair.base->report(pair.now);
  EXPECT_TRUE(report.established);
  ASSERT_TRUE(report.round_trip && report.clock_offset && report.clock_bound);
  // There and back, and the car's loop of 10 ms.
  EXPECT_GE(*report.round_trip, 2 * EndpointPair::kWay - milliseconds(1));
  EXPECT_LE(*report.round_trip, 2 * EndpointPair::kWay + milliseconds(2));
  const Duration off = *report.clock_offset;
  EXPECT_LE(std::max(off, -off), *report.clock_bound);
  EXPECT_EQ(report.paths[0].peer, EndpointPair::kCar);
  EXPECT_TRUE(report.paths[0].validated);
  EXPECT_EQ(report.paths[0].received.lost, 0u);
  EXPECT_GT(report.paths[0].spent.packets, 200u);
  EXPECT_GT(report.paths[0].budget_use, 0.01);
}

}  // namespace
}  // namespace pitwall::telemetry
