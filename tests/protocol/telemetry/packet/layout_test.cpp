// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Instant kSampleTime{5'000'000'000};

Snapshot filled() {
  Snapshot snapshot;
  for (std::size_t i = 0; i < kFieldCount; ++i) {
    const FieldRow& row = kFields[i];
    snapshot.values[i] = row.min + row.resolution * static_cast<double>(i % 2);
  }
  snapshot.sampled_at.fill(kSampleTime);
  return snapshot;
}

Layout of(const std::vector<GroupPlace>& places) {
  Layout layout;
  for (const GroupPlace& place : places) EXPECT_TRUE(layout.push(place));
  return layout;
}
std::vector<GroupPlace> own(Direction direction) {
  const Layout& layout = own_layout(direction);
  return {layout.begin(), layout.end()};
}

// All that this layout can carry, written by a sender that has it.
std::vector<std::uint8_t> packet_of(const Layout& sender) {
  std::vector<Group> wanted;
  for (const GroupPlace& place : sender)
    if (place.own) wanted.push_back(*place.own);
  std::vector<std::uint8_t> buffer(kMaxBody);
  BodyWriter writer(buffer, kMaxBody, sender);
  writer.begin(kSampleTime, 1);
  CodecCounters counters;
  writer.add_groups(filled(), wanted, kSampleTime, counters);
  EXPECT_TRUE(writer.add_record(RecordType::kEvent, std::array<std::uint8_t, 3>{1, 2, 3}));
  return {writer.bytes().begin(), writer.bytes().end()};
}

void expect_values(const Body& body, GroupSet groups) {
  EXPECT_EQ(body.groups, groups);
  const Snapshot snapshot = filled();
  for (std::size_t i = 0; i < kFieldCount; ++i) {
    if (groups.has(kFields[i].group)) {
      EXPECT_NEAR(body.values[i], snapshot.values[i], kFields[i].resolution / 2);
    } else {
      EXPECT_NE(body.values[i], body.values[i]) << "must be unset";
    }
  }
  ASSERT_EQ(body.records.size(), 1U);
  EXPECT_EQ(body.records[0].payload.size(), 3U);
}

TEST(Layout, IsTheGroupsOfTheDirectionInTheOrderOfTheRegistry) {
  for (const Direction direction : {Direction::kDown, Direction::kUp}) {
    std::size_t at = 0;
    for (const GroupRow& row : kGroupTable) {
      if (row.direction != direction) continue;
      const GroupPlace& place = own_layout(direction)[at++];
      EXPECT_EQ(place.own, row.group);
      EXPECT_EQ(place.bits, group_bits(row.group));
    }
    EXPECT_EQ(own_layout(direction).size(), at);
    EXPECT_EQ(set_size(own_layout(direction)), (at + 7) / 8);
  }
}

// The sender has groups that we lack, or ours in another order; what both have is read right.
TEST(Layout, APacketOfAnotherRegistryIsReadByItsOwnLayout) {
  std::mt19937 random(1);
  for (const Direction direction : {Direction::kDown, Direction::kUp}) {
    for (int round = 0; round < 50; ++round) {
      std::vector<GroupPlace> senders = own(direction);
      for (std::size_t i = senders.size(); i > 1; --i) {
        std::swap(senders[i - 1], senders[random() % i]);
      }
      const Layout sender = of(senders);
      const auto packet = packet_of(sender);
      // WHEN the receiver does not know some of them
      std::vector<GroupPlace> known = senders;
      GroupSet common;
      for (GroupPlace& place : known) {
        if (random() % 3 == 0) {
          place.own.reset();
        } else {
          common.add(*place.own);
        }
      }
      const auto body = parse_body(packet, of(known));
      ASSERT_TRUE(body);
      expect_values(*body, common);
    }
  }
}

TEST(Layout, ASenderWithoutAGroupDoesNotWriteIt) {
  std::vector<GroupPlace> senders = own(Direction::kUp);
  const Group lacking = *senders.front().own;
  senders.erase(senders.begin());
  const Layout sender = of(senders);
  std::vector<std::uint8_t> buffer(kMaxBody);
  BodyWriter writer(buffer, kMaxBody, sender);
  writer.begin(kSampleTime, 1);
  CodecCounters counters;
  EXPECT_TRUE(writer.add_groups(filled(), {&lacking, 1}, kSampleTime, counters).empty());
}

TEST(Layout, AGroupOfAnySizeThatIsUnknownIsSkippedOrTooShort) {
  for (const std::uint16_t bits : std::array<std::uint16_t, 7>{0, 1, 63, 64, 65, 500, 2'000}) {
    const Layout sender = of({{std::nullopt, bits}});
    const std::size_t size = (kAgeCodeBits + bits + 7U) / 8U;
    std::vector<std::uint8_t> packet(kBodyFixed + 1 + size, 0);
    packet[kBodyFixed - 1] = 2;
    packet[kBodyFixed] = 1;
    const auto body = parse_body(packet, sender);
    ASSERT_TRUE(body);
    EXPECT_TRUE(body->groups.empty());
    packet.pop_back();
    EXPECT_EQ(parse_body(packet, sender).error(), BodyError::kTooShort);
  }
}

}  // namespace
}  // namespace pitwall::telemetry
