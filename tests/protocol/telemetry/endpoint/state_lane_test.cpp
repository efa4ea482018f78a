// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/state_lane.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/packet/body.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kRoundTrip = milliseconds(50);

Snapshot all_sampled(Instant at) {
  Snapshot snapshot;
  snapshot.sampled_at.fill(at);
  return snapshot;
}

// A car's lane that makes packets one after the other, each acknowledged a round trip later.
class CarLane {
 public:
  struct Packet {
    GroupSet groups;
    std::size_t bytes = 0, asked_of_share = 0, safety_bytes = 0;
  };

  Packet packet(std::int64_t ms, std::size_t room, StateLane::Writing how,
                GroupSet known = groups_of(Direction::kDown), double bytes_per_s = 0.0) {
    const Instant now = at_ms(ms);
    const Snapshot snapshot = all_sampled(now);
    BodyWriter body(buffer_, room, Direction::kDown);
    body.begin(now, 1);
    Packet packet;
    packet.asked_of_share = lane.choose(snapshot, known, {kRoundTrip, bytes_per_s}, now);
    packet.safety_bytes = lane.write(body, snapshot, how, now);
    lane.sent(++sequence_, snapshot, now);
    if (sequence_ > 3) lane.acked(sequence_ - 3);
    const auto parsed = parse_body(body.bytes(), Direction::kDown);
    EXPECT_TRUE(parsed);
    packet.groups = parsed->groups;
    packet.bytes = body.bytes().size();
    return packet;
  }

  explicit CarLane(double early_share = StateLane::kEarlyShare)
      : lane(Direction::kDown, early_share) {}
  StateLane lane;

 private:
  std::array<std::uint8_t, kMaxBody> buffer_{};
  std::uint64_t sequence_ = 0;
};

bool all_of_class(GroupSet groups, Class priority) {
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != Direction::kDown || row.priority != priority) continue;
    if (!groups.has(row.group)) return false;
  }
  return true;
}

bool none_above(GroupSet groups, Class priority) {
  for (const GroupRow& row : kGroupTable) {
    if (row.priority > priority && groups.has(row.group)) return false;
  }
  return true;
}

TEST(StateLane, ASlotWithoutOthersHasSafetyAndMotion) {
  CarLane car;
  for (std::int64_t i = 0; i < 100; ++i) {
    const auto packet = car.packet(20 * i, 550, {});
    ASSERT_TRUE(all_of_class(packet.groups, Class::kSafety)) << i;
    ASSERT_TRUE(all_of_class(packet.groups, Class::kMotion)) << i;
    ASSERT_EQ(packet.safety_bytes, packet.asked_of_share);
  }
  // What is slow had its turn long before it was due, but not each time.
  const std::uint64_t engine = car.lane.figures(Group::kEngine).chosen;
  EXPECT_GE(engine, 15U);
  EXPECT_LE(engine, 60U);
}

// Room to spare is not all used: a packet grows by a tenth of its room at most.
TEST(StateLane, WhatIsNotDueTakesATenthOfAPacket) {
  constexpr std::size_t kRoom = 550;
  const GroupSet down = groups_of(Direction::kDown);
  CarLane idle, waiting;
  std::size_t grown = 0;
  for (std::int64_t i = 0; i < 200; ++i) {
    const std::size_t early = idle.packet(20 * i, kRoom, {}).bytes;
    const std::size_t due = waiting.packet(20 * i, kRoom, {.something_waits = true}).bytes;
    if (i > 5 && early > due) grown = std::max(grown, early - due);
  }
  EXPECT_GT(grown, kRoom / 20);
  EXPECT_LE(grown, kRoom / 10 + 1);
  for (const GroupRow& row : kGroupTable) {
    if (row.priority < Class::kHealth || !down.has(row.group)) continue;
    EXPECT_GT(idle.lane.figures(row.group).chosen, waiting.lane.figures(row.group).chosen);
  }
}

TEST(StateLane, AWholeShareTellsAllInEachSlot) {
  CarLane car{1.0};
  for (std::int64_t i = 0; i < 20; ++i) {
    EXPECT_EQ(car.packet(20 * i, kMaxBody, {}).groups, groups_of(Direction::kDown)) << i;
  }
}

// A link with hardly more room than safety and motion need has none to spare.
TEST(StateLane, ANarrowPacketHasOnlyWhatIsDue) {
  CarLane car;
  for (std::int64_t i = 0; i < 100; ++i) (void)car.packet(20 * i, 150, {});
  EXPECT_LE(car.lane.figures(Group::kEngine).chosen, 12U);
}

constexpr double kNarrow = 16'000.0, kWide = 32'000.0;  // 128 and 256 kbit/s

TEST(StateLane, TheRefreshPeriodLeavesHalfOfTheRateToBulk) {
  const StateLane lane(Direction::kDown);
  const GroupSet all = groups_of(Direction::kDown);
  for (const double rate : {0.0, 8'000.0, kNarrow}) {
    EXPECT_EQ(lane.refresh_period(all, rate), Scheduler::kNoPeriod) << rate;
  }
  const Duration wide = lane.refresh_period(all, kWide);
  EXPECT_GT(wide, milliseconds(20));
  EXPECT_LT(wide, milliseconds(60));
  EXPECT_GT(lane.refresh_period(all, 0.8 * kWide), wide);
  EXPECT_LT(lane.refresh_period(all, 4 * kWide), milliseconds(10));
  // Whoever has less to tell tells it more often.
  GroupSet few = groups_of(Direction::kDown, Class::kSafety);
  few.add(Group::kTyres);
  EXPECT_LT(lane.refresh_period(few, kWide), milliseconds(1));
  EXPECT_EQ(StateLane(Direction::kUp).refresh_period(groups_of(Direction::kUp), kWide), Duration{});
}

// Slow groups go once in a period, before bulk; in a second they are half of the rate with all
// else that the packets have.
TEST(StateLane, SlowGroupsGoBeforeBulkOnAWideLink) {
  const GroupSet down = groups_of(Direction::kDown);
  CarLane car;
  std::size_t bytes = 0;
  constexpr std::int64_t kSlots = 500;
  for (std::int64_t i = 0; i < kSlots; ++i) {
    bytes += car.packet(20 * i, 300, {.something_waits = true}, down, kWide).bytes;
  }
  for (const GroupRow& row : kGroupTable) {
    if (!down.has(row.group) || row.priority <= Class::kMotion) continue;
    EXPECT_GE(car.lane.figures(row.group).chosen, kSlots / 4U) << row.name;
  }
  constexpr std::size_t kAround = kIpUdpOverhead + kHeaderSize + kTagSize + kAckSize;
  const double used = static_cast<double>(bytes + kSlots * kAround) / (kSlots * 0.02);
  EXPECT_LT(used, kWide / 2);
}

TEST(StateLane, ANarrowLinkHasTheTargetAgesAlone) {
  const GroupSet down = groups_of(Direction::kDown);
  CarLane narrow, without;
  for (std::int64_t i = 0; i < 500; ++i) {
    const StateLane::Writing how{.between = i % 2 == 1, .something_waits = i % 5 != 0};
    ASSERT_EQ(narrow.packet(10 * i, 150, how, down, kNarrow).groups,
              without.packet(10 * i, 150, how, down).groups)
        << i;
  }
}

TEST(StateLane, OnlySafetyIsOnlySafety) {
  CarLane car;
  for (std::int64_t i = 0; i < 20; ++i) {
    const auto packet = car.packet(20 * i, 550, {.only_safety = true});
    ASSERT_TRUE(none_above(packet.groups, Class::kSafety));
    ASSERT_TRUE(all_of_class(packet.groups, Class::kSafety));
  }
}

TEST(StateLane, BetweenSlotsNothingSlow) {
  CarLane car;
  for (std::int64_t i = 0; i < 50; ++i) {
    const auto packet = car.packet(2'000 + 20 * i, 250, {.between = true});
    ASSERT_TRUE(none_above(packet.groups, Class::kMotion));
    ASSERT_TRUE(all_of_class(packet.groups, Class::kSafety));
  }
}

// Bulk waits: motion still rides on the slot, and two thirds of the packet is the most it takes.
TEST(StateLane, LeavesAThirdToWhatWaits) {
  GroupSet fast;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction == Direction::kDown && row.priority <= Class::kMotion) fast.add(row.group);
  }
  const std::size_t size = state_bytes(fast, Direction::kDown);
  CarLane roomy, narrow;
  for (std::int64_t i = 0; i < 50; ++i) {
    const auto wide = roomy.packet(20 * i, 3 * size, {.something_waits = true});
    ASSERT_TRUE(all_of_class(wide.groups, Class::kMotion));
    (void)narrow.packet(20 * i, size + 30, {.something_waits = true});
  }
  // Where it would not, motion goes when it is due: less often than each slot.
  EXPECT_LT(narrow.lane.figures(Group::kEgo).chosen, 45U);
  EXPECT_GT(narrow.lane.figures(Group::kEgo).chosen, 5U);
}

TEST(StateLane, WhatTheOtherEndDoesNotKnowIsNotSent) {
  CarLane car;
  GroupSet known = groups_of(Direction::kDown);
  known.remove(Group::kEgo);
  known.remove(Group::kFlags);
  for (std::int64_t i = 0; i < 50; ++i) {
    const auto packet = car.packet(20 * i, 550, {}, known);
    ASSERT_FALSE(packet.groups.has(Group::kEgo));
    ASSERT_FALSE(packet.groups.has(Group::kFlags));
    ASSERT_EQ(packet.safety_bytes, packet.asked_of_share);
  }
}

TEST(StateLane, ANewSessionBeginsWithAll) {
  CarLane car;
  for (std::int64_t i = 0; i < 50; ++i) (void)car.packet(20 * i, 800, {});
  car.lane.forget();
  const auto packet = car.packet(1'001, 800, {});
  for (const GroupRow& row : kGroupTable) {
    EXPECT_EQ(packet.groups.has(row.group), row.direction == Direction::kDown) << row.name;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
