// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/restamp_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

// A bare counter in the upper nibble of byte 1.
RestampRules bare_counter() {
  return {.name = "m", .rules = {{.id = 5, .length = 2, .counter_start = 12, .counter_bits = 4}}};
}

can::Frame with_counter(const RestampRules& rules, std::uint32_t counter) {
  can::Frame frame{.id = 5, .length = 2, .data = {0xAB, 0x0C}};
  rules.rules[0].stamp(frame, counter);
  return frame;
}

CounterRange range_of(const std::vector<std::uint32_t>& values) {
  const RestampRules rules = bare_counter();
  CounterHistory history{rules};
  for (const std::uint32_t value : values) history.observe(with_counter(rules, value));
  return history.range_of(0);
}

TEST(RestampRules, ACounterIsWrittenAndNothingBesideIt) {
  const RestampRules rules = bare_counter();
  const can::Frame frame = with_counter(rules, 9);
  EXPECT_EQ(frame.data[0], 0xAB);
  EXPECT_EQ(frame.data[1], 0x9C);
  EXPECT_EQ(frame.data[2], 0);
  EXPECT_EQ(rules.rules[0].counter_of(frame), 9U);
}

TEST(RestampRules, AFrameIsFoundByIdentifierAndKind) {
  const RestampRules rules = bare_counter();
  EXPECT_EQ(rules.place_of({.id = 5}), 0U);
  EXPECT_EQ(rules.place_of({.id = 5, .extended = true}), RestampRules::kNone);
  EXPECT_EQ(rules.place_of({.id = 6}), RestampRules::kNone);
}

TEST(CounterHistory, AWrapThatIsSeenTwiceIsBelieved) {
  const auto expect = [](const CounterRange& range, std::uint32_t bottom, std::uint32_t top) {
    EXPECT_EQ(range.bottom, bottom);
    EXPECT_EQ(range.top, top);
  };
  expect(range_of({}), 0, 15);
  expect(range_of({5, 6, 7, 1, 2}), 0, 15);                   // once: a restart?
  expect(range_of({6, 7, 1, 2, 3, 4, 5, 6, 7, 1, 2}), 1, 7);  // a sender from 1 to 7
  expect(range_of({13, 14, 0, 1, 14, 0, 7, 8, 0, 1, 14, 0}), 0,
         14);                                      // a loss and a restart between
  expect(range_of({6, 7, 4, 7, 4, 7, 4}), 0, 15);  // no sender begins at 4
}

}  // namespace
}  // namespace pitwall::replay
