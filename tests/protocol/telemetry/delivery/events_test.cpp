// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/events.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "protocol/vocabulary/bytes.hpp"
#include "tests/protocol/telemetry/delivery/delivery_rig.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::telemetry {
namespace {

Event numbered(std::uint32_t number, Instant at, std::size_t size = 4) {
  Event event{.kind = EventKind::kText, .at = at, .payload = {}};
  for (std::size_t i = 0; i < std::max<std::size_t>(size, 4); ++i) {
    EXPECT_TRUE(event.payload.push(i < 4 ? static_cast<std::uint8_t>(number >> (8 * i)) : 0));
  }
  return event;
}
std::uint32_t number_of(const Event& event) { return load<std::uint32_t>(event.payload.span(), 0); }

struct EventRig : DeliveryRig<EventSender, EventReceiver> {
  using DeliveryRig::DeliveryRig;
  void step() {
    slot([&](BodyWriter& body) { sender.fill(body, now); });
  }
};

Record event_ack(Bytes& bytes, std::uint16_t newest) {
  bytes = {static_cast<std::uint8_t>(newest), static_cast<std::uint8_t>(newest >> 8U)};
  return {RecordType::kEventAck, bytes};
}

TEST(Events, AreHandedOutExactlyOnceAndInOrderWhateverTheAirDoes) {
  for (const double loss : {0.0, 0.3, 0.7}) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      EventRig rig(rough(loss, seed));
      std::mt19937 random(seed);
      std::uint32_t offered = 0, seen = 0;
      for (int slot = 0; slot < 3'000; ++slot) {
        // Fewer than the queue holds even at the worst loss, so that none is dropped.
        if (slot < 2'000 && random() % 8 == 0) {
          EXPECT_TRUE(
              rig.sender.offer(numbered(offered++, rig.now, random() % (kEventPayload + 1))));
        }
        rig.step();
        while (const auto event = rig.receiver.next()) ASSERT_EQ(number_of(*event), seen++);
      }
      EXPECT_EQ(seen, offered);
      EXPECT_EQ(rig.sender.waiting(), 0U);
      EXPECT_EQ(rig.receiver.counters().events, offered);
    }
  }
}

TEST(Events, NumbersMayWrapAround) {
  EventRig rig(rough(0.1, 7));
  std::uint32_t offered = 0, seen = 0;
  while (seen < 70'000) {
    while (rig.sender.waiting() < kEventsKept) rig.sender.offer(numbered(offered++, rig.now));
    rig.room = kMaxBody;
    rig.step();
    while (const auto event = rig.receiver.next()) ASSERT_EQ(number_of(*event), seen++);
  }
  EXPECT_EQ(rig.sender.counters().malformed, 0U);
}

TEST(Events, WhatIsDroppedForWantOfRoomIsCountedAndToldInItsPlace) {
  EventRig rig(rough(0.5, 3));
  std::mt19937 random(3);
  std::uint32_t offered = 0, known = 0;
  for (int slot = 0; slot < 3'000; ++slot) {
    // GIVEN storms of more events than are kept
    if (slot < 1'500 && random() % 50 == 0) {
      for (int i = 0; i < 200; ++i) rig.sender.offer(numbered(offered++, rig.now));
    }
    rig.step();
    // THEN at every moment the number of the next is what was handed out and told as lost
    while (const auto event = rig.receiver.next()) {
      if (event->kind == EventKind::kLost) {
        known += number_of(*event);
        continue;
      }
      ASSERT_EQ(number_of(*event), known++);
    }
  }
  EXPECT_EQ(known, offered);
  EXPECT_GT(rig.sender.counters().dropped, 0U);
  EXPECT_EQ(rig.sender.waiting(), 0U);
}

TEST(Events, TheirTimeIsKnownToATenthOfAMillisecond) {
  EventRig rig(rough(0.3, 5));
  std::vector<Instant> at;
  for (int slot = 0; slot < 500; ++slot) {
    if (slot % 5 == 0 && slot < 400) {
      at.push_back(rig.now - microseconds(slot * 977));
      rig.sender.offer(numbered(static_cast<std::uint32_t>(at.size() - 1), at.back()));
    }
    rig.step();
    while (const auto event = rig.receiver.next()) {
      const Duration error = event->at - at[number_of(*event)];
      EXPECT_LT(std::abs(error.ns), microseconds(100).ns + 1);
    }
  }
}

TEST(Events, OlderThanTheClockOfPacketsTellsAreToldAsTheOldest) {
  EventRig rig(testing::LossyChannelParams{});
  rig.sender.offer(numbered(0, rig.now - seconds(5'000)));
  rig.sender.offer(numbered(1, rig.now + seconds(5)));
  const Instant sent = rig.now;
  rig.step();
  EXPECT_EQ(rig.receiver.next()->at, sent - microseconds(100) * 0xFF'FFFF);
  EXPECT_EQ(rig.receiver.next()->at, sent);
}

TEST(Events, GoOnWithWhatWasNotAcknowledgedWhenTheReceiverIsNew) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    EventRig rig(rough(0.4, seed));
    std::mt19937 random(seed);
    std::uint32_t offered = 0, seen = 0;
    for (int slot = 0; slot < 600; ++slot) {
      if (slot < 400 && random() % 4 == 0) rig.sender.offer(numbered(offered++, rig.now));
      rig.step();
      while (const auto event = rig.receiver.next()) {
        // The last receiver may have had some that it could not acknowledge any more.
        ASSERT_LE(number_of(*event), seen);
        seen = number_of(*event) + 1;
      }
      if (slot % 97 == 50) {
        const auto first = offered - static_cast<std::uint32_t>(rig.sender.waiting());
        rig.new_session();
        rig.receiver = {};
        rig.sender.peer_restarted();
        ASSERT_GE(seen, first);
        seen = first;
      }
    }
    EXPECT_EQ(seen, offered);
    EXPECT_EQ(rig.sender.waiting(), 0U);
  }
}

TEST(Events, ANewSenderIsHeardFromItsFirstAndWhatWasReadyIsNotLost) {
  EventRig rig(testing::LossyChannelParams{});
  for (std::uint32_t i = 0; i < 5; ++i) rig.sender.offer(numbered(i, rig.now));
  rig.step();
  rig.new_session();
  rig.sender = {};
  rig.receiver.peer_restarted();
  for (std::uint32_t i = 5; i < 8; ++i) rig.sender.offer(numbered(i, rig.now));
  rig.step();
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(number_of(*rig.receiver.next()), i);
  EXPECT_FALSE(rig.receiver.next());
}

TEST(Events, AConsumerThatPausesLosesNone) {
  EventRig rig(rough(0.2, 9));
  std::uint32_t offered = 0, seen = 0;
  for (int slot = 0; slot < 2'000; ++slot) {
    while (rig.sender.waiting() < 20) rig.sender.offer(numbered(offered++, rig.now));
    rig.step();
    if (slot % 400 != 399) continue;
    while (const auto event = rig.receiver.next()) ASSERT_EQ(number_of(*event), seen++);
  }
  EXPECT_GT(rig.receiver.counters().dropped, 0U);
  EXPECT_GE(seen, kEventsKept);
}

TEST(Events, AskForTheRoomThatTheyThenTake) {
  EventSender sender;
  EventReceiver receiver;
  const Instant now{1'000'000'000};
  EXPECT_EQ(sender.wanted(), 0U);
  EXPECT_EQ(receiver.wanted(), 0U);
  for (std::uint32_t i = 0; i < 3; ++i) sender.offer(numbered(i, now, 10 * i));
  const std::size_t wanted = sender.wanted();
  const Bytes packet = packet_of(now, kMaxBody, [&](BodyWriter& b) { sender.fill(b, now); });
  EXPECT_EQ(packet.size(), kBodyFixed + wanted);
  take_all(receiver, packet, now, now);
  const std::size_t ack = receiver.wanted();
  const Bytes answer = packet_of(now, kMaxBody, [&](BodyWriter& b) { receiver.fill(b, now); });
  EXPECT_EQ(answer.size(), kBodyFixed + ack);
  EXPECT_EQ(receiver.wanted(), 0U);
  // The oldest again in every packet, the others only after a while.
  EXPECT_LT(sender.wanted(), wanted);
  const Instant later = now + kEventRepeat;
  EXPECT_EQ(packet_of(later, kMaxBody, [&](BodyWriter& b) { sender.fill(b, later); }).size(),
            packet.size());
  // No room for an answer: it stays due.
  take_all(receiver, packet, now, now);
  packet_of(now, kBodyFixed + 1, [&](BodyWriter& b) { receiver.fill(b, now); });
  EXPECT_EQ(receiver.wanted(), ack);
}

TEST(Events, BadRecordsAreCountedAndChangeNothing) {
  EventReceiver receiver;
  const Bytes good{1, 0, 0, 0, 0, 7};
  const Bytes short_one(good.begin(), good.end() - 1);
  Bytes long_one = good, of_no_kind = good;
  long_one.resize(good.size() + kEventPayload + 1);
  of_no_kind.back() = kEventKinds;
  for (const Bytes& bytes : {short_one, long_one, of_no_kind, Bytes{}}) {
    EXPECT_FALSE(receiver.take({RecordType::kEvent, bytes}, {}));
  }
  EXPECT_EQ(receiver.counters().malformed, 4U);
  EXPECT_EQ(receiver.wanted(), 0U);
  EXPECT_FALSE(receiver.next());

  EventSender sender;
  for (std::uint32_t i = 0; i < 3; ++i) sender.offer(numbered(i, Instant{}));
  Bytes bytes;
  EXPECT_FALSE(sender.take({RecordType::kEventAck, Bytes{1}}, {}));
  EXPECT_FALSE(sender.take(event_ack(bytes, 4), {}));
  EXPECT_FALSE(sender.take(event_ack(bytes, 40'000), {}));
  EXPECT_EQ(sender.counters().malformed, 3U);
  EXPECT_EQ(sender.waiting(), 3U);
  EXPECT_TRUE(sender.take(event_ack(bytes, 2), {}));
  EXPECT_TRUE(sender.take(event_ack(bytes, 1), {}));  // overtaken
  EXPECT_EQ(sender.waiting(), 1U);
}

TEST(Events, AllocateNothing) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "not counted under AddressSanitizer";
  auto sender = std::make_unique<EventSender>();
  auto receiver = std::make_unique<EventReceiver>();
  const Event event = numbered(1, Instant{});
  Bytes buffer(kMaxBody);
  std::size_t seen = 0;
  const auto count = testing::allocations_of([&] {
    for (int i = 0; i < 50; ++i) sender->offer(event);
    BodyWriter writer(buffer, kMaxBody, Direction::kDown);
    writer.begin(Instant{}, 1);
    sender->fill(writer, Instant{});
    const auto body = parse_body(writer.bytes(), Direction::kDown);
    for (const Record& record : body->records) receiver->take(record, {});
    while (receiver->next()) ++seen;
    sender->peer_restarted();
    receiver->peer_restarted();
  });
  EXPECT_GT(seen, 40U);
  EXPECT_EQ(count, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
