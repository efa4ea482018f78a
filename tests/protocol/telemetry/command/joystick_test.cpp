// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/joystick.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry {
namespace {

using testing::kCarAhead;
using testing::TwoEnds;

Received received(Instant at, std::optional<Instant> sent) {
  Received out;
  out.at = at;
  out.sent_earliest = sent;
  return out;
}

// A hand that moves the stick a hundred times a second; whether the car heeds it at the end.
bool applied_weight(TwoEnds& rig, Duration span) {
  for (const Instant end = rig.now + span; rig.now < end;) {
    if (rig.now.ns % milliseconds(10).ns == 0) rig.stick.sample({0.5, 0.25}, rig.now);
    rig.run(milliseconds(1));
  }
  return rig.joystick.sample(rig.car_now()).has_value();
}

TEST(Joystick, AHandIsHeededAsLongAsItsSamplesAreFresh) {
  TwoEnds rig({.seed = 1});
  ASSERT_TRUE(applied_weight(rig, seconds(1)));
  const auto sample = rig.joystick.sample(rig.car_now());
  EXPECT_DOUBLE_EQ(sample->throttle_cap, 0.5);
  EXPECT_DOUBLE_EQ(sample->brake, 0.25);
}

// The device is dead, the link is not: packets come fifty times a second.
TEST(Joystick, PacketsDoNotKeepADeadHandAlive) {
  TwoEnds rig({.seed = 2});
  ASSERT_TRUE(applied_weight(rig, seconds(1)));
  rig.run(kJoystickDead + milliseconds(1));
  EXPECT_FALSE(rig.joystick.sample(rig.car_now()));
  const auto taken = rig.joystick.counters().samples;
  rig.run(seconds(1));
  EXPECT_EQ(rig.joystick.counters().samples, taken);
}

TEST(Joystick, BufferbloatOf400MillisecondsTripsItAlthoughPacketsFlow) {
  const Duration queue = milliseconds(400);
  TwoEnds rig({.delay_min = queue, .delay_max = queue, .seed = 3});
  EXPECT_FALSE(applied_weight(rig, seconds(3)));
  EXPECT_EQ(rig.joystick.counters().samples, 0U);
  EXPECT_GT(rig.joystick.counters().too_old, 50U) << "they came, and were judged by their age";
}

TEST(Joystick, AQueueThatGrowsIsNoticedWithinTheDeadTime) {
  for (const int queue_ms : {200, 300, 400, 1'000, 5'000}) {
    TwoEnds rig({.seed = 4});
    ASSERT_TRUE(applied_weight(rig, seconds(1)));
    rig.up = testing::Way(
        {.delay_min = milliseconds(queue_ms), .delay_max = milliseconds(queue_ms), .seed = 4}, 99);
    EXPECT_FALSE(applied_weight(rig, kJoystickDead + milliseconds(21))) << queue_ms;
    EXPECT_FALSE(applied_weight(rig, seconds(6))) << queue_ms;
  }
}

// Ten thousand times something breaks at some moment: the device, the way up, the comparison of
// clocks, or a queue grows on the way. Whatever the car heeds, the hand did it no longer than the
// dead time ago; and a hand that is cut off is gone by then.
TEST(Joystick, WhateverBreaksNoSampleActsLongerThanItsDeadTime) {
  constexpr int kValues = 200;  // the throttle cap tells which sample it is
  std::mt19937_64 random(9);
  int heeded_after = 0;
  for (int run = 0; run < 10'000; ++run) {
    TwoEnds rig({.delay_min = milliseconds(5), .delay_max = milliseconds(35), .seed = 1});
    const auto broken_at = Instant{} + milliseconds(60 + static_cast<int>(random() % 60));
    const auto fault = random() % 4;
    const Duration queue = milliseconds(200 + static_cast<int>(random() % 4'800));
    for (int ms = 0; ms < 400; ++ms) {
      const bool broken = rig.now >= broken_at;
      if (ms % 10 == 0 && !(broken && fault == 0)) {
        rig.stick.sample({0.005 * (ms / 10 % kValues), 0.0}, rig.now);
      }
      if (rig.now == broken_at && fault == 1) rig.up.cut = true;
      if (rig.now == broken_at && fault == 2) rig.clock_known = false;
      if (rig.now == broken_at && fault == 3) {
        rig.up = testing::Way({.delay_min = queue, .delay_max = queue, .seed = 2}, 5);
      }
      rig.run(milliseconds(1));
      const auto sample = rig.joystick.sample(rig.car_now());
      if (!sample) continue;
      const auto which = static_cast<int>(sample->throttle_cap / 0.005 + 0.5);
      ASSERT_LE(rig.now - (Instant{} + milliseconds(10 * which)), kJoystickDead) << fault;
      heeded_after += rig.now > broken_at ? 1 : 0;
      ASSERT_LE(rig.now, broken_at + kJoystickDead + milliseconds(1)) << fault;
    }
  }
  EXPECT_GT(heeded_after, 100'000) << "else nothing was shown";
}

TEST(Joystick, WithoutComparedClocksNothingIsHeeded) {
  TwoEnds rig({.seed = 5});
  rig.clock_known = false;
  EXPECT_FALSE(applied_weight(rig, seconds(1)));
  EXPECT_GT(rig.joystick.counters().unknown_age, 0U);
}

// A peer took a joystick only if its stamp was newer than the last: one packet from the future, and
// the operator was locked out for good.
TEST(Joystick, OneFutureStampedPacketDoesNotLockTheOperatorOut) {
  JoystickReceiver receiver;
  Values values;
  JoystickSender far, hand;
  for (int i = 0; i < 30'000; ++i) far.sample({1.0, 0.0}, Instant{});
  far.put(values, Instant{});
  const Instant now{seconds(100).ns};
  receiver.receive(values, received(now, now + seconds(3'600)));
  ASSERT_TRUE(receiver.sample(now)) << "it counts as of now, at most";
  EXPECT_FALSE(receiver.sample(now + kJoystickDead + nanoseconds(1)));
  for (int ms = 0; ms <= 240; ms += 20) {
    const Instant at = now + milliseconds(ms);
    hand.sample({0.5, 0.0}, at);
    hand.put(values, at);
    receiver.receive(values, received(at, at));
  }
  const auto sample = receiver.sample(now + milliseconds(240));
  ASSERT_TRUE(sample);
  EXPECT_DOUBLE_EQ(sample->throttle_cap, 0.5);
}

TEST(Joystick, ReorderedAndRepeatedPacketsNeverGoBack) {
  JoystickReceiver receiver;
  JoystickSender hand;
  Values first, second;
  hand.sample({0.9, 0.0}, Instant{});
  hand.put(first, Instant{});
  hand.sample({0.2, 0.5}, Instant{} + milliseconds(10));
  hand.put(second, Instant{} + milliseconds(10));
  const Instant at{milliseconds(20).ns};
  receiver.receive(second, received(at, at));
  receiver.receive(first, received(at, at));
  receiver.receive(second, received(at, at));
  EXPECT_DOUBLE_EQ(receiver.sample(at)->throttle_cap, 0.2);
  EXPECT_EQ(receiver.counters().repeated, 2U);
}

TEST(Joystick, NumbersBeginAgainAfterTheLast) {
  JoystickReceiver receiver;
  JoystickSender hand;
  Values values;
  Instant now{};
  for (int i = 0; i < 70'000; ++i, now += milliseconds(5)) {
    hand.sample({0.5, 0.0}, now);
    hand.put(values, now);
    receiver.receive(values, received(now, now));
  }
  EXPECT_EQ(receiver.counters().samples, 70'000U);
}

TEST(Joystick, WhatIsNoNumberIsNoSampleAndMoreThanAllIsAll) {
  JoystickSender hand;
  Values values;
  hand.sample({kUnset, 0.0}, Instant{});
  hand.put(values, Instant{});
  EXPECT_EQ(values[field("joystick.active")], 0.0);
  hand.sample({7.0, -3.0}, Instant{});
  hand.put(values, Instant{});
  EXPECT_EQ(values[field("joystick.throttle_cap")], 1.0);
  EXPECT_EQ(values[field("joystick.brake")], 0.0);
}

// A peer's car made samples of its own, a hundred a second with a counter that rose, where it had
// no joystick: its watchdog was fed by nobody. Here the operator's end alone makes samples, and
// without a device it says nothing.
TEST(Joystick, NobodySpoofsAHandThatIsNotThere) {
  TwoEnds rig({.seed = 6});
  rig.run(seconds(2));
  EXPECT_FALSE(rig.joystick.sample(rig.car_now()));
  EXPECT_EQ(rig.joystick.counters().samples, 0U);
  EXPECT_EQ(rig.joystick.counters().repeated, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
