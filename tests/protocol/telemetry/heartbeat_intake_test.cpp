// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/heartbeat_intake.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace pitwall::telemetry {
namespace {

constexpr std::uint32_t kCarRun = 500, kBaseRun = 77;
constexpr Instant at_ms(std::int64_t ms) { return {milliseconds(ms).ns}; }

// A base whose clock has nothing to do with the car's.
struct Base {
  BaseHeartbeat next{.run = kBaseRun, .heard_run = kCarRun};

  // Answers the packet that the car sent at `sent`, having held it for `held`.
  std::vector<std::uint8_t> answer(Instant sent, Duration held) {
    next.heard_sent = sent;
    next.held = held;
    ++next.heard_sequence;
    return again();
  }
  // A heartbeat about the same packet as the last one.
  std::vector<std::uint8_t> again() {
    ++next.sequence;
    HeartbeatBuffer buffer;
    const auto bytes = encode(next, buffer);
    return {bytes.begin(), bytes.end()};
  }
};

TEST(HeartbeatIntake, KnowsNothingBeforeTheFirst) {
  const HeartbeatIntake car{kCarRun};
  EXPECT_FALSE(car.alive_at());
  EXPECT_FALSE(car.round_trip());
}

TEST(HeartbeatIntake, TheBaseLivedWhenItSentAtLeast) {
  Base base;
  HeartbeatIntake car{kCarRun};
  car.feed(base.answer(at_ms(1'000), milliseconds(30)), at_ms(1'050));  // 20 ms on the way
  ASSERT_TRUE(car.alive_at() && car.round_trip());
  EXPECT_EQ(*car.alive_at(), at_ms(1'030));
  EXPECT_EQ(*car.round_trip(), milliseconds(20));
}

// A queue that holds everything for seconds keeps nothing alive, although heartbeats flow.
TEST(HeartbeatIntake, WhatWaitedInAQueueIsAsOldAsItIs) {
  Base base;
  HeartbeatIntake car{kCarRun};
  for (std::int64_t ms = 0; ms < 5'000; ms += 100) {
    const Instant received = at_ms(ms + 4'000);
    car.feed(base.answer(at_ms(ms), {}), received);
    EXPECT_EQ(received - *car.alive_at(), seconds(4));
    EXPECT_EQ(*car.round_trip(), seconds(4));
  }
}

// The car hears its base but is not heard: it knows that the base lives, and no round trip more.
TEST(HeartbeatIntake, ABaseThatNoLongerHearsTheCarIsStillAlive) {
  Base base;
  HeartbeatIntake car{kCarRun};
  car.feed(base.answer(at_ms(0), {}), at_ms(10));
  for (std::int64_t ms = 100; ms <= 3'000; ms += 100) {
    base.next.held = milliseconds(ms);
    car.feed(base.again(), at_ms(ms + 50));
    EXPECT_EQ(*car.alive_at(), at_ms(ms));
    EXPECT_EQ(*car.round_trip(), milliseconds(10)) << "of the packet that was answered last";
  }
  EXPECT_EQ(car.counters().accepted, 31U);
}

TEST(HeartbeatIntake, ReplaysAreOldAndKeepNothingAlive) {
  Base base;
  HeartbeatIntake car{kCarRun};
  std::vector<std::vector<std::uint8_t>> tape;
  for (int i = 0; i < 10; ++i) {
    tape.push_back(base.answer(at_ms(100 * i), {}));
    car.feed(tape.back(), at_ms(100 * i + 5));
  }
  const Instant alive = *car.alive_at();
  for (int i = 0; i < 10; ++i) car.feed(tape[static_cast<std::size_t>(i)], at_ms(1'500 + i));
  EXPECT_EQ(car.counters().old, 10U);
  EXPECT_EQ(*car.alive_at(), alive);
  // Long after, when silence lets any run begin: the run is the same, so they are old still.
  for (int i = 0; i < 10; ++i) car.feed(tape[static_cast<std::size_t>(i)], at_ms(60'000 + i));
  EXPECT_EQ(car.counters().old, 20U);
  EXPECT_EQ(*car.alive_at(), alive);
}

TEST(HeartbeatIntake, EveryOrderOfArrivalLetsTheNewestThroughOnce) {
  std::mt19937 random{3};
  for (int round = 0; round < 200; ++round) {
    Base base;
    HeartbeatIntake car{kCarRun};
    std::vector<std::vector<std::uint8_t>> tape;
    for (int i = 0; i < 12; ++i) tape.push_back(base.answer(at_ms(100 * i), {}));
    auto mixed = tape;
    mixed.insert(mixed.end(), tape.begin(), tape.end());
    for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[random() % i]);
    Instant last{};
    for (const auto& bytes : mixed) {
      car.feed(bytes, at_ms(2'000));
      EXPECT_GE(*car.alive_at(), last);
      last = *car.alive_at();
    }
    EXPECT_EQ(last, at_ms(1'100));
    EXPECT_EQ(car.counters().accepted + car.counters().old, 24U);
    EXPECT_LE(car.counters().accepted, 12U);
  }
}

TEST(HeartbeatIntake, ARestartedBaseIsHeardAtOnceAndTheOldOneNoMore) {
  Base before, after;
  after.next.run = kBaseRun + 3;
  HeartbeatIntake car{kCarRun};
  for (int i = 0; i < 5; ++i) car.feed(before.answer(at_ms(i), {}), at_ms(i));
  const auto late = before.answer(at_ms(5), {});
  car.feed(after.answer(at_ms(300), {}), at_ms(300));
  EXPECT_EQ(car.counters().runs, 2U);
  EXPECT_EQ(*car.alive_at(), at_ms(300));
  car.feed(late, at_ms(301));
  EXPECT_EQ(car.counters().other_run, 1U);
}

// A base whose calendar went back between two starts has a smaller number.
TEST(HeartbeatIntake, ASmallerRunIsHeardAfterSilence) {
  Base before, after;
  after.next.run = kBaseRun - 3;
  HeartbeatIntake car{kCarRun};
  car.feed(before.answer(at_ms(0), {}), at_ms(0));
  car.feed(after.answer(at_ms(1'999), {}), at_ms(1'999));
  EXPECT_EQ(car.counters().other_run, 1U);
  car.feed(after.answer(at_ms(2'000), {}), at_ms(2'000));
  EXPECT_EQ(*car.alive_at(), at_ms(2'000));
}

TEST(HeartbeatIntake, AnswersToOthersAndToTheFutureAreRefused) {
  Base base;
  HeartbeatIntake car{kCarRun};
  base.next.heard_run = kCarRun - 1;  // this car before it was started again
  car.feed(base.answer(at_ms(0), {}), at_ms(10));
  base.next.heard_run = kCarRun;
  car.feed(base.answer(at_ms(11), {}), at_ms(10));
  EXPECT_EQ(car.counters().other_car, 1U);
  EXPECT_EQ(car.counters().too_early, 1U);
  EXPECT_FALSE(car.alive_at());
  EXPECT_EQ(car.counters().refused_total(), 2U);
}

// held is what the base says: it cannot make the base live later than the heartbeat came.
TEST(HeartbeatIntake, NeverAliveAfterItWasHeard) {
  Base base;
  HeartbeatIntake car{kCarRun};
  car.feed(base.answer(at_ms(0), seconds(4'000)), at_ms(10));
  EXPECT_EQ(*car.alive_at(), at_ms(10));
  EXPECT_EQ(*car.round_trip(), Duration{});
}

TEST(HeartbeatIntake, DamageIsCountedByKind) {
  Base base;
  HeartbeatIntake car{kCarRun};
  auto bytes = base.answer(at_ms(0), {});
  bytes[20] ^= 1U;
  car.feed(bytes, at_ms(1));
  car.feed({}, at_ms(1));
  EXPECT_EQ(car.counters().refused[static_cast<std::size_t>(PacketError::kBadChecksum)], 1U);
  EXPECT_EQ(car.counters().refused[static_cast<std::size_t>(PacketError::kTooShort)], 1U);
  EXPECT_EQ(car.counters().received, 2U);
  EXPECT_EQ(car.counters().refused_total(), 2U);
  EXPECT_FALSE(car.alive_at());
}

}  // namespace
}  // namespace pitwall::telemetry
