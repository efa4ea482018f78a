// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/slots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

using Turn = Slots::Turn;

Instant at_us(std::int64_t us) { return Instant{} + microseconds(us); }

TEST(Slots, OneOnTheSlotAndOneBetween) {
  Slots slots;
  int on_slot = 0, between = 0;
  for (std::int64_t ms = 0; ms < 10'000; ++ms) {
    const Turn turn = slots.turn(at_ms(ms));
    if (turn == Turn::kOnSlot) ++on_slot;
    if (turn == Turn::kBetween) ++between;
    if (turn != Turn::kNone) slots.done(turn, true, at_ms(ms));
    ASSERT_NE(slots.turn(at_ms(ms)), turn == Turn::kNone ? Turn::kOnSlot : turn);
  }
  EXPECT_NEAR(on_slot, 500, 1);
  EXPECT_NEAR(between, 500, 1);
  EXPECT_NEAR(static_cast<double>(slots.count()), 500.0, 1.0);
  EXPECT_EQ(slots.skipped(), 0U);
}

// A loop of 10 ms that wakes up to 6 ms late: the grid stands still and no slot is lost.
TEST(Slots, LatePollsMoveNothing) {
  std::mt19937_64 random(1);
  Slots slots;
  int on_slot = 0;
  for (std::int64_t i = 0; i < 2'000; ++i) {
    const Instant now = at_us(10'000 * i + static_cast<std::int64_t>(random() % 6'000));
    const Turn turn = slots.turn(now);
    on_slot += turn == Turn::kOnSlot ? 1 : 0;
    if (turn != Turn::kNone) slots.done(turn, true, now);
  }
  EXPECT_NEAR(on_slot, 1'000, 1);
  EXPECT_EQ(slots.skipped(), 0U);
}

TEST(Slots, ASlotWithoutRoomIsAskedAgainThenSkipped) {
  Slots slots;
  int asked = 0;
  for (std::int64_t ms = 0; ms < 18; ++ms) {
    const Turn turn = slots.turn(at_ms(ms));
    if (turn == Turn::kOnSlot) ++asked;
    if (turn != Turn::kNone) slots.done(turn, false, at_ms(ms));
  }
  EXPECT_GE(asked, 9);
  EXPECT_LE(asked, 11);
  EXPECT_EQ(slots.skipped(), 1U);
  EXPECT_EQ(slots.turn(at_ms(20)), Turn::kOnSlot);  // the next is not delayed by it
}

TEST(Slots, WhatWasNotPolledIsSkipped) {
  Slots slots;
  slots.done(slots.turn(at_ms(0)), true, at_ms(0));
  EXPECT_EQ(slots.turn(at_ms(1'000)), Turn::kOnSlot);
  EXPECT_EQ(slots.count(), 51U);
  EXPECT_EQ(slots.skipped(), 49U);
}

// At any time of the slot, once; the grid and the packets on it stay where they are.
TEST(Slots, WhatCannotWaitGoesAtAnyTime) {
  for (std::int64_t pressed = 1; pressed < 18; ++pressed) {
    Slots slots;
    slots.done(slots.turn(at_ms(0)), true, at_ms(0));
    if (pressed > 10) slots.done(slots.turn(at_ms(10)), true, at_ms(10));
    for (int asked = 0; asked < 3; ++asked) {  // the budget has no room
      ASSERT_EQ(slots.turn(at_ms(pressed), true), Turn::kAtOnce) << pressed;
      slots.done(Turn::kAtOnce, false, at_ms(pressed));
      EXPECT_LE(slots.due(at_ms(pressed), true), at_ms(pressed + 1));
    }
    slots.done(Turn::kAtOnce, true, at_ms(pressed));
    EXPECT_EQ(slots.turn(at_ms(17)), Turn::kNone) << "in the place of the one between";
    EXPECT_EQ(slots.turn(at_ms(20), true), Turn::kOnSlot);
    EXPECT_EQ(slots.skipped(), 0U);
  }
}

TEST(Slots, NothingIsDueBeforeDue) {
  std::mt19937_64 random(2);
  Slots slots;
  Instant now{};
  for (int i = 0; i < 5'000; ++i) {
    const Turn turn = slots.turn(now);
    if (turn != Turn::kNone) slots.done(turn, random() % 3 != 0, now);
    const Instant due = slots.due(now);
    ASSERT_GE(due, now);
    for (Instant t = now + microseconds(100); t + kSlotEarly < due; t += microseconds(500)) {
      Slots copy = slots;
      ASSERT_EQ(copy.turn(t), Turn::kNone);
    }
    now = due + microseconds(static_cast<std::int64_t>(random() % 3'000));
  }
}

}  // namespace
}  // namespace pitwall::telemetry
